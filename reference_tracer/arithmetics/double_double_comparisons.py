"""Comparisons of double-double balls (double_double_balls.py), their extremes, and the whole numbers below one.

Answers are those of float_ball_comparisons.py. A comparison looks at the difference, which is exact where it is 0.
"""

from __future__ import annotations

import math

from raytruth.reference_tracer.arithmetics import float_ball_comparisons
from raytruth.reference_tracer.arithmetics.double_double_balls import (
    DoubleDoubleBall,
    from_float_ball,
    sub,
    to_float_ball,
)
from raytruth.reference_tracer.arithmetics.float_ball_comparisons import PARITY_KNOWN_BELOW, UNDECIDED, WholeNumbers
from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, OUTWARD, Ball

ZERO = Ball(0.0, 0.0)


def are_apart(a: DoubleDoubleBall, b: DoubleDoubleBall) -> bool:
    """Whether a and b are finite, and so far from each other that the order of their upper parts is that of all points.

    The rounded difference of the upper parts errs by at most u times itself, and the rest of both numbers is at most
    the sum of four terms, made larger by more than it loses.
    """
    difference = abs(a.high - b.high)
    rest = (abs(a.low) + abs(b.low) + a.radius + b.radius) * OUTWARD
    return rest < difference <= LARGEST  # not so if one of them is NaN


def less(a: DoubleDoubleBall, b: DoubleDoubleBall) -> int:
    """Whether a < b: whether the difference a - b is below 0.

    The upper parts decide that most of the time, and quickly; infinities are balls of one float.
    """
    if are_apart(a, b):
        return 1 if a.high < b.high else 0
    roughly = float_ball_comparisons.less(to_float_ball(a), to_float_ball(b))
    if roughly != UNDECIDED:
        return roughly
    return float_ball_comparisons.less(to_float_ball(sub(a, b, 0.0)), ZERO)


def less_or_equal(a: DoubleDoubleBall, b: DoubleDoubleBall) -> int:
    """Whether a ≤ b, which is that not b < a."""
    reverse = less(b, a)
    return UNDECIDED if reverse == UNDECIDED else 1 - reverse


def equal(a: DoubleDoubleBall, b: DoubleDoubleBall) -> int:
    """Whether a = b: certain only of exact numbers."""
    if are_apart(a, b):
        return 0
    if not (abs(a.high) <= LARGEST and abs(b.high) <= LARGEST):
        return float_ball_comparisons.equal(to_float_ball(a), to_float_ball(b))
    return float_ball_comparisons.equal(to_float_ball(sub(a, b, 0.0)), ZERO)


def certainly_less(a: DoubleDoubleBall, b: DoubleDoubleBall) -> bool:
    """Whether a < b for all points of the balls."""
    return less(a, b) == 1


def certainly_zero(a: DoubleDoubleBall) -> bool:
    """Whether a is 0 and nothing else."""
    return a.high == 0.0 and a.radius == 0.0


def maximum(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """max(a, b): one of the two, or, where that is undecided, a ball of one float."""
    if less(a, b) == 0:
        return a
    if less(b, a) == 0:
        return b
    return from_float_ball(float_ball_comparisons.maximum(to_float_ball(a), to_float_ball(b)))


def minimum(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """min(a, b): one of the two, or, where that is undecided, a ball of one float."""
    if less(b, a) == 0:
        return a
    if less(a, b) == 0:
        return b
    return from_float_ball(float_ball_comparisons.minimum(to_float_ball(a), to_float_ball(b)))


def floor(a: DoubleDoubleBall) -> WholeNumbers:
    """The whole number below a: by how far a is from the nearest one, since `high` may have been rounded up to it."""
    if not (abs(a.high) < PARITY_KNOWN_BELOW and a.radius < 0.25):
        return float_ball_comparisons.floor(to_float_ball(a))
    nearest = math.floor(a.high + 0.5)
    beyond = to_float_ball(sub(a, DoubleDoubleBall(float(nearest), 0.0, 0.0), 0.0))
    is_below = float_ball_comparisons.less(beyond, ZERO)
    if is_below == UNDECIDED:
        return WholeNumbers(nearest - 1, False)
    return WholeNumbers(nearest - is_below, True)
