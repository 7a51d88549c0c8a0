"""Exponentials, powers and tangents of double-double balls: those of balls of one float, and as wide as these.

They hold all values. Whoever needs a highlight or an absorption to more than a float's digits asks Arb.
"""

from __future__ import annotations

from raytruth.reference_tracer.arithmetics import float_ball_functions
from raytruth.reference_tracer.arithmetics.double_double_balls import DoubleDoubleBall, from_float_ball, to_float_ball


def exp(x: DoubleDoubleBall, roundoff: float) -> DoubleDoubleBall:
    """The exponential."""
    return from_float_ball(float_ball_functions.exp(to_float_ball(x), roundoff))


def power(base: DoubleDoubleBall, exponent: DoubleDoubleBall, roundoff: float) -> DoubleDoubleBall:
    """The positive part of the base to the power of an exponent that is positive."""
    return from_float_ball(float_ball_functions.power(to_float_ball(base), to_float_ball(exponent), roundoff))


def tan(x: DoubleDoubleBall, roundoff: float) -> DoubleDoubleBall:
    """The tangent between -π/2 and π/2."""
    return from_float_ball(float_ball_functions.tan(to_float_ball(x), roundoff))
