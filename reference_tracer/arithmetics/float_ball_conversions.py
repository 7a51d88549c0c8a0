"""Balls of float64 numbers made of Arb's balls, and back: for constants, scenes' numbers, and what Arb is asked for."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, UNKNOWN, Ball, hull

if TYPE_CHECKING:
    from fractions import Fraction


def from_arb(ball: Any) -> Ball:
    """A ball that holds all numbers of Arb's ball, from the float below it to the float above it.

    An infinity stays what it is. Where Arb's ball is a float, it has no radius.
    """
    if not ball.is_finite():
        return Ball(float(ball.mid()), 0.0) if ball.is_exact() and not ball.is_nan() else UNKNOWN
    middle = float(ball.mid())
    if ball.is_exact() and arb(middle) == ball:
        return Ball(middle, 0.0)
    if not abs(middle) <= LARGEST:
        return hull(-math.inf, math.inf)
    return Ball(middle, _above(abs(ball - middle).upper()))


def to_arb(ball: Ball) -> Any:
    """Arb's ball of the same middle and radius; Arb's radius may be larger by a factor of 1 + 2^-29."""
    return arb(ball.middle, ball.radius) if ball.radius <= LARGEST else arb(ball.middle, math.inf)


def from_interval(least: Fraction, most: Fraction) -> Ball:
    """A ball that holds all numbers from one exact number to another."""
    middle = float((least + most) / 2)
    radius = max(most - type(most)(middle), type(least)(middle) - least)
    return Ball(middle, _above(arb(radius.numerator) / radius.denominator)) if radius else Ball(middle, 0.0)


def stored(value: float, precision_bits: int) -> Ball:
    """A scene's number as a renderer stores it: exact if it fits, else within a unit roundoff (`stored_number`)."""
    return from_arb(stored_number(value, precision_bits))


def _above(value: Any) -> float:
    """A float above all of Arb's ball: Arb's own float is the nearest to its middle, or next to it."""
    upper = value.upper()
    above = float(upper.mid())
    while above < math.inf and not arb(above) >= upper:
        above = math.nextafter(above, math.inf)
    return above
