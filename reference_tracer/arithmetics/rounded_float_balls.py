"""The arithmetic of compiled feasible sets: what the source's operations are in balls of two floats, to be compiled.

Each result of an operation is widened by the roundoff of the program's state, as `rounded_ball_arithmetic` does with
Arb (balls.py). A comparison that the balls leave open asks the decisions (scripted_decisions.py).
"""

from __future__ import annotations

import math

from raytruth.reference_tracer.arithmetics import float_ball_comparisons as comparisons
from raytruth.reference_tracer.arithmetics import float_ball_functions as functions
from raytruth.reference_tracer.arithmetics import float_balls as balls
from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
from raytruth.reference_tracer.arithmetics.float_balls import Ball
from raytruth.reference_tracer.arithmetics.scripted_decisions import next_answer
from raytruth.reference_tracer.compiler.questions import state


def exact_number(value: float) -> Ball:
    """The number itself."""
    return Ball(value, 0.0)


def rounded_sum(a: Ball, b: Ball) -> Ball:
    """The sum."""
    return balls.add(a, b, state().roundoff)


def rounded_difference(a: Ball, b: Ball) -> Ball:
    """The difference."""
    return balls.sub(a, b, state().roundoff)


def rounded_product(a: Ball, b: Ball) -> Ball:
    """The product."""
    return balls.mul(a, b, state().roundoff)


def rounded_quotient(a: Ball, b: Ball) -> Ball:
    """The quotient."""
    return balls.truediv(a, b, state().roundoff)


def rounded_root(a: Ball) -> Ball:
    """The root."""
    return balls.sqrt(a, state().roundoff)


def rounded_exponential(a: Ball) -> Ball:
    """The exponential."""
    return functions.exp(a, state().roundoff)


def rounded_power(base: Ball, exponent: Ball) -> Ball:
    """The power."""
    return functions.power(base, exponent, state().roundoff)


def answered(answer: int) -> bool:
    """The answer 1 or 0 of a comparison, as it is; of one that is undecided the next of the decisions."""
    if answer == comparisons.UNDECIDED:
        return next_answer()
    return answer == 1


def is_less(a: Ball, b: Ball) -> bool:
    """Whether a < b."""
    return answered(comparisons.less(a, b))


def is_less_or_equal(a: Ball, b: Ball) -> bool:
    """Whether a ≤ b."""
    return answered(comparisons.less_or_equal(a, b))


def is_equal(a: Ball, b: Ball) -> bool:
    """Whether a = b."""
    return answered(comparisons.equal(a, b))


def decided_floor(a: Ball) -> int:
    """The whole number below a; where that is not certain, one of two in a row (`decided_floor` in balls.py)."""
    below = comparisons.floor(a)
    if below.is_one:
        return below.lowest
    return below.lowest + 1 if next_answer() else below.lowest


ROUNDED_FLOAT_BALLS = Arithmetic(
    "rounded balls of float64",
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
