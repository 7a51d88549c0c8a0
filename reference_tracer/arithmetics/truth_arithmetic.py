"""The arithmetic of the compiled truth: what the source's operations are in double-double balls, to be compiled.

Results are exact but for the balls' radii: no renderer's rounding is in them. A comparison that the balls leave open
marks the call (compiler/questions.py).
"""

from __future__ import annotations

import math
from typing import Any

from flint import arb, ctx

from raytruth.reference_tracer.arithmetics import double_double_balls as balls
from raytruth.reference_tracer.arithmetics import double_double_comparisons as comparisons
from raytruth.reference_tracer.arithmetics import double_double_powers as powers
from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
from raytruth.reference_tracer.arithmetics.double_double_balls import DoubleDoubleBall
from raytruth.reference_tracer.arithmetics.double_double_powers import EXACT
from raytruth.reference_tracer.arithmetics.float_ball_comparisons import UNDECIDED
from raytruth.reference_tracer.arithmetics.float_ball_conversions import from_arb
from raytruth.reference_tracer.compiler.questions import undecided


def exact_number(value: float) -> DoubleDoubleBall:
    """The number itself."""
    return DoubleDoubleBall(value, 0.0, 0.0)


def exact_integer(value: int) -> DoubleDoubleBall:
    """The number itself: whole numbers in kernels count pixels and samples, and are floats."""
    return DoubleDoubleBall(float(value), 0.0, 0.0)


def double_double_of(ball: Any) -> DoubleDoubleBall:
    """A double-double ball that holds all of Arb's; what Arb's precision holds beyond 106 bits is in the radius."""
    with ctx.workprec(4 * 53):
        high = from_arb(ball).middle
        rest = from_arb(ball - arb(high)) if math.isfinite(high) else balls.to_float_ball(exact_number(0.0))
    return DoubleDoubleBall(high, rest.middle, rest.radius)


def exact_sum(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """The sum."""
    return balls.add(a, b, EXACT)


def exact_difference(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """The difference."""
    return balls.sub(a, b, EXACT)


def exact_product(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """The product."""
    return balls.mul(a, b, EXACT)


def exact_quotient(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """The quotient."""
    return balls.truediv(a, b, EXACT)


def exact_root(a: DoubleDoubleBall) -> DoubleDoubleBall:
    """The root."""
    return balls.sqrt(a, EXACT)


def decided(answer: int) -> bool:
    """The answer 1 or 0 of a comparison, as it is; else any, with a mark."""
    if answer == UNDECIDED:
        return undecided()
    return answer == 1


def is_less(a: DoubleDoubleBall, b: DoubleDoubleBall) -> bool:
    """Whether a < b."""
    return decided(comparisons.less(a, b))


def is_less_or_equal(a: DoubleDoubleBall, b: DoubleDoubleBall) -> bool:
    """Whether a ≤ b."""
    return decided(comparisons.less_or_equal(a, b))


def is_equal(a: DoubleDoubleBall, b: DoubleDoubleBall) -> bool:
    """Whether a = b."""
    return decided(comparisons.equal(a, b))


def decided_floor(a: DoubleDoubleBall) -> int:
    """The whole number below a; with a mark, where that is not certain."""
    below = comparisons.floor(a)
    if below.is_one:
        return below.lowest
    return below.lowest if undecided() else below.lowest + 1


with ctx.workprec(4 * 53):
    PI = double_double_of(arb.pi())

TRUTH_ARITHMETIC = Arithmetic(
    "double-double balls",
    exact_number,
    {
        "certainly_less": comparisons.certainly_less,
        "certainly_zero": comparisons.certainly_zero,
        "exp": powers.exp,
        "float": exact_integer,
        "floor": decided_floor,
        "inf": exact_number(math.inf),
        "max": comparisons.maximum,
        "min": comparisons.minimum,
        "pi": PI,
        "sqrt": exact_root,
    },
    compiled=True,
    decided_comparisons=True,
    operations={
        "abs": balls.absolute,
        "add": exact_sum,
        "eq": is_equal,
        "le": is_less_or_equal,
        "lt": is_less,
        "mul": exact_product,
        "neg": balls.neg,
        "pow": powers.power,
        "sub": exact_difference,
        "truediv": exact_quotient,
    },
)
