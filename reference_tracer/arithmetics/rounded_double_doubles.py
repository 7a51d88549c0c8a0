"""The arithmetic of rounded_float_balls.py in double-double balls, for error models of nearly a float's precision."""

from __future__ import annotations

import math

from raytruth.reference_tracer.arithmetics import double_double_balls as balls
from raytruth.reference_tracer.arithmetics import double_double_comparisons as comparisons
from raytruth.reference_tracer.arithmetics import double_double_powers as powers
from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
from raytruth.reference_tracer.arithmetics.double_double_balls import DoubleDoubleBall
from raytruth.reference_tracer.arithmetics.rounded_float_balls import answered
from raytruth.reference_tracer.arithmetics.scripted_decisions import next_answer
from raytruth.reference_tracer.compiler.questions import state


def exact_number(value: float) -> DoubleDoubleBall:
    """The number itself."""
    return DoubleDoubleBall(value, 0.0, 0.0)


def rounded_sum(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """The sum."""
    return balls.add(a, b, state().roundoff)


def rounded_difference(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """The difference."""
    return balls.sub(a, b, state().roundoff)


def rounded_product(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """The product."""
    return balls.mul(a, b, state().roundoff)


def rounded_quotient(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """The quotient."""
    return balls.truediv(a, b, state().roundoff)


def rounded_root(a: DoubleDoubleBall) -> DoubleDoubleBall:
    """The root."""
    return balls.sqrt(a, state().roundoff)


def rounded_exponential(a: DoubleDoubleBall) -> DoubleDoubleBall:
    """The exponential: the exact one, times 1 ± roundoff."""
    return balls.mul(powers.exp(a), DoubleDoubleBall(1.0, 0.0, state().roundoff), 0.0)


def rounded_power(base: DoubleDoubleBall, exponent: DoubleDoubleBall) -> DoubleDoubleBall:
    """The power: the exact one, times 1 ± roundoff."""
    return balls.mul(powers.power(base, exponent), DoubleDoubleBall(1.0, 0.0, state().roundoff), 0.0)


def is_less(a: DoubleDoubleBall, b: DoubleDoubleBall) -> bool:
    """Whether a < b."""
    return answered(comparisons.less(a, b))


def is_less_or_equal(a: DoubleDoubleBall, b: DoubleDoubleBall) -> bool:
    """Whether a ≤ b."""
    return answered(comparisons.less_or_equal(a, b))


def is_equal(a: DoubleDoubleBall, b: DoubleDoubleBall) -> bool:
    """Whether a = b."""
    return answered(comparisons.equal(a, b))


def decided_floor(a: DoubleDoubleBall) -> int:
    """The whole number below a; where that is not certain, one of two in a row (`decided_floor` in balls.py)."""
    below = comparisons.floor(a)
    if below.is_one:
        return below.lowest
    return below.lowest + 1 if next_answer() else below.lowest


ROUNDED_DOUBLE_DOUBLES = Arithmetic(
    "rounded double-double balls",
    exact_number,
    {
        "certainly_less": comparisons.certainly_less,
        "certainly_zero": comparisons.certainly_zero,
        "exp": rounded_exponential,
        "floor": decided_floor,
        "inf": exact_number(math.inf),
        "max": comparisons.maximum,
        "min": comparisons.minimum,
        "power": rounded_power,
        "sqrt": rounded_root,
    },
    compiled=True,
    decided_comparisons=True,
    rounded_operations=True,
    operations={
        "abs": balls.absolute,
        "add": rounded_sum,
        "eq": is_equal,
        "le": is_less_or_equal,
        "lt": is_less,
        "mul": rounded_product,
        "neg": balls.neg,
        "sub": rounded_difference,
        "truediv": rounded_quotient,
    },
)
