"""Comparisons of balls of float64 numbers (float_balls.py), their maximum and minimum, and the whole numbers below one.

A comparison is 1 if it holds for all points of the balls, 0 if it holds for none, and -1 if that is undecided. What has
no value (NaN) leaves everything undecided.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from raytruth.reference_tracer.arithmetics.float_balls import OUTWARD, UNKNOWN, Ball, hull, lower, upper

UNDECIDED = -1

# From here on not all whole numbers are floats, so that a float's neighbours say nothing of the parity around it.
PARITY_KNOWN_BELOW = 2.0**52


class WholeNumbers(NamedTuple):
    """What the whole number below a ball may be."""

    lowest: int
    is_one: bool
    """Whether it is certain; else it may be `lowest` or the next one: only its parity is ever used."""


def less(a: Ball, b: Ball) -> int:
    """Whether a < b.

    It holds for all points if m_b - m_a > r_a + r_b, and for none if m_a - m_b ≥ r_a + r_b. The rounded difference d
    errs by u·|d| at most, and the sum of the radii by u times itself, so that comparing d with (1 + 16·u) times that
    sum is safe; without radii the middles are compared as they are. No infinity is less than itself.
    """
    reach = (a.radius + b.radius) * OUTWARD
    if reach == 0.0:
        return _known(a.middle < b.middle, a.middle >= b.middle)
    difference = b.middle - a.middle
    return _known(difference > reach, -difference >= reach)


def less_or_equal(a: Ball, b: Ball) -> int:
    """Whether a ≤ b, which is that not b < a."""
    reverse = less(b, a)
    return UNDECIDED if reverse == UNDECIDED else 1 - reverse


def equal(a: Ball, b: Ball) -> int:
    """Whether a = b: certain only of two exact numbers, impossible if the balls do not touch."""
    reach = (a.radius + b.radius) * OUTWARD
    difference = abs(b.middle - a.middle)
    if reach == 0.0:
        return _known(a.middle == b.middle, a.middle < b.middle or b.middle < a.middle)
    return _known(False, difference > reach)


def _known(holds: bool, fails: bool) -> int:
    if holds:
        return 1
    return 0 if fails else UNDECIDED


def certainly_less(a: Ball, b: Ball) -> bool:
    """Whether a < b for all points of the balls."""
    return less(a, b) == 1


def certainly_zero(a: Ball) -> bool:
    """Whether a is 0 and nothing else."""
    return a.middle == 0.0 and a.radius == 0.0


def maximum(a: Ball, b: Ball) -> Ball:
    """max(a, b): from the larger of the lower ends to the larger of the upper ends; never rounded."""
    if math.isnan(a.middle) or math.isnan(b.middle):
        return UNKNOWN
    if less(a, b) == 0:
        return a
    if less(b, a) == 0:
        return b
    return hull(max(lower(a), lower(b)), max(upper(a), upper(b)))


def minimum(a: Ball, b: Ball) -> Ball:
    """min(a, b): from the smaller of the lower ends to the smaller of the upper ends; never rounded."""
    if math.isnan(a.middle) or math.isnan(b.middle):
        return UNKNOWN
    if less(b, a) == 0:
        return a
    if less(a, b) == 0:
        return b
    return hull(min(lower(a), lower(b)), min(upper(a), upper(b)))


def floor(a: Ball) -> WholeNumbers:
    """The whole number below a; 0 or 1, where neither that nor the parity is known."""
    least, most = lower(a), upper(a)
    if not (abs(least) < PARITY_KNOWN_BELOW and abs(most) < PARITY_KNOWN_BELOW):
        return WholeNumbers(0, False)
    lowest = math.floor(least)
    return WholeNumbers(lowest, lowest == math.floor(most))
