"""Exponentials, logarithms, tangents and powers of balls of float64 numbers (float_balls.py).

Each is a short computation in balls, so that the roundings on the way bound themselves; beside them only the rest of a
series is to be bounded. No function of a C library is used: nobody proves what its error is.

All of these functions are monotone, so that over a ball they lie between their values at both ends. That of a narrow
ball is taken at its middle, and made wider by how steep it is, which is quicker and spares the rounding of the ends.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from raytruth.reference_tracer.arithmetics.float_balls import (
    LARGEST,
    OUTWARD,
    SMALLEST,
    UNDERFLOW,
    UNKNOWN,
    Ball,
    add,
    hull,
    lower,
    mul,
    neg,
    rounded_ball,
    sub,
    truediv,
    upper,
)

# log 2 to 32 bits, so that its product with a whole number below 2^21 is exact; and the rest, which errs by half a unit
# in its last place.
LOG_TWO_HIGH = float.fromhex("0x1.62e42feep-1")
LOG_TWO_LOW = Ball(float.fromhex("0x1.a39ef35793c76p-33"), float.fromhex("0x1p-86"))
# π/2 to 53 bits, and the rest.
HALF_PI = float.fromhex("0x1.921fb54442d18p+0")
HALF_PI_LOW = Ball(float.fromhex("0x1.1a62633145c07p-54"), float.fromhex("0x1p-107"))
# So wide a ball may be whose radius is computed by a bound on the slope: it is at most 1/32 larger than it need be.
NARROW = 1 / 32
# Any number near π/4 will do.
QUARTER_PI = 0.785

ONE = Ball(1.0, 0.0)
# exp of these and of what is beyond is no float, or less than the smallest one: their logarithms are 709.8 and -744.4.
EXPONENT_OVERFLOWS = 710.0
EXPONENT_UNDERFLOWS = -745.2
# What is left of a series by so many terms is far below a roundoff of its sum: the functions' docstrings bound it.
EXPONENTIAL_TERMS, EXPONENTIAL_REST = 14, 2.0**-61
LOGARITHM_TERMS, LOGARITHM_REST = 11, 2.0**-60
TRIGONOMETRIC_TERMS, TRIGONOMETRIC_REST = 10, 2.0**-67


def exp(x: Ball, roundoff: float) -> Ball:
    """The exponential, which rises: between those of the ends.

    If r ≤ 1/32, |e^x - e^m| ≤ e^m·(e^r - 1) ≤ e^m·(r + r²): half of what lies between the ends, or 1/32 more.
    """
    if not abs(x.middle) <= LARGEST:
        return UNKNOWN
    if x.radius <= NARROW:
        growth = Ball(1.0, (x.radius + x.radius * x.radius) * OUTWARD)
        at_middle = _exp_at(x.middle)
        return rounded_ball(at_middle if x.radius == 0.0 else mul(at_middle, growth, 0.0), roundoff)
    return rounded_ball(_between(_exp_at(lower(x)), _exp_at(upper(x))), roundoff)


def power(base: Ball, exponent: Ball, roundoff: float) -> Ball:
    """The positive part of the base to the power of an exponent that is positive (`power` in balls.py).

    x^y = exp(y·log x), where |log x - log m| ≤ r/(m - r). The logarithm errs by some roundings of itself, and so does
    the power by y·|log x| times as many: that is much only where the power is too small to be seen.
    What is wide lies between powers at corners: x^y rises with x, and with y where x > 1; where x < 1 it falls.
    """
    if math.isnan(base.middle) or not (exponent.middle <= LARGEST and lower(exponent) >= 0.0):
        return UNKNOWN
    least, most = lower(base), upper(base)
    if not most > 0.0:
        return Ball(0.0, 0.0)
    if not most <= LARGEST:
        return UNKNOWN
    if least > 0.0 and base.radius * max(upper(exponent), 1.0) <= NARROW * base.middle:
        logarithm = _log_at(base.middle)
        spread = base.radius / least * OUTWARD + UNDERFLOW if base.radius > 0.0 else 0.0
        return exp(mul(exponent, add(logarithm, Ball(0.0, spread), 0.0), 0.0), roundoff)
    shortest, longest = lower(exponent), upper(exponent)
    of_most = _power_at(most, longest if most >= 1.0 else shortest)
    of_least = _power_at(least, shortest if least >= 1.0 else longest) if least > 0.0 else Ball(0.0, 0.0)
    return rounded_ball(_between(of_least, of_most), roundoff)


def tan(x: Ball, roundoff: float) -> Ball:
    """The tangent, which rises between -π/2 and π/2: between those of the ends; unknown beyond, as for no camera."""
    least, most = lower(x), upper(x)
    if not (abs(x.middle) <= LARGEST and least > -HALF_PI and most < HALF_PI):
        return UNKNOWN
    if x.radius == 0.0:
        return rounded_ball(_tan_at(x.middle), roundoff)
    return rounded_ball(_between(_tan_at(least), _tan_at(most)), roundoff)


def _between(of_least: Ball, of_most: Ball) -> Ball:
    """What lies between the values at the ends of a ball."""
    return hull(lower(of_least), upper(of_most))


def _exp_at(x: float) -> Ball:
    """The exponential of a float: 2^k·exp(r), where r = x - k·log 2 is 0.35 at most.

    exp(r) = 1 + r·(1 + r/2·(1 + r/3·(…))) to the 14th power of r. The rest of the series is at most twice its first
    term, 0.35^15/15! < 2^-62 (Taylor, Lagrange's remainder).
    """
    if x >= EXPONENT_OVERFLOWS:
        return Ball(0.0, math.inf)
    if x <= EXPONENT_UNDERFLOWS:
        return Ball(0.0, SMALLEST)
    if x == 0.0:
        return ONE
    doublings = math.floor(x / LOG_TWO_HIGH + 0.5)
    r = sub(Ball(x, 0.0), Ball(float(doublings) * LOG_TWO_HIGH, 0.0), 0.0)
    r = sub(r, mul(Ball(float(doublings), 0.0), LOG_TWO_LOW, 0.0), 0.0)
    total = ONE
    for term in range(EXPONENTIAL_TERMS):
        total = add(ONE, mul(truediv(r, Ball(float(EXPONENTIAL_TERMS - term), 0.0), 0.0), total, 0.0), 0.0)
    return _scaled(add(total, Ball(0.0, EXPONENTIAL_REST), 0.0), doublings)


def _scaled(a: Ball, doublings: int) -> Ball:
    """2^doublings·a, in two steps, since 2^1024 is no float and 2^-1075 neither."""
    half = doublings // 2
    return mul(mul(a, Ball(_power_of_two(half), 0.0), 0.0), Ball(_power_of_two(doublings - half), 0.0), 0.0)


def _power_of_two(exponent: int) -> float:
    """2^exponent, exactly, by squaring: for exponents between -1022 and 1023."""
    left = exponent if exponent >= 0 else -exponent
    square = 2.0 if exponent >= 0 else 0.5
    result = 1.0
    while left > 0:
        if left % 2 == 1:
            result = result * square
        square = square * square
        left = left // 2
    return result


def _log_at(x: float) -> Ball:
    """The logarithm of a positive float: k·log 2 + log z, where x = 2^k·z, and z is between 0.7071 and 1.4143.

    log z = 2·(t + t³/3 + t⁵/5 + …) with t = (z - 1)/(z + 1), which is 0.1717 at most. By eleven terms the rest is
    2·t^23/23/(1 - t²) < 2·t·2^-60 at most (Abramowitz, Stegun, 1964, equation 4.1.27; its terms fall faster than those
    of a geometric series).
    """
    z, doublings = _significand(x)
    t = truediv(sub(Ball(z, 0.0), ONE, 0.0), add(Ball(z, 0.0), ONE, 0.0), 0.0)
    square = mul(t, t, 0.0)
    total = Ball(0.0, 0.0)
    for term in range(LOGARITHM_TERMS):
        order = Ball(float(2 * (LOGARITHM_TERMS - term) - 1), 0.0)
        total = add(truediv(ONE, order, 0.0), mul(square, total, 0.0), 0.0)
    total = add(total, Ball(0.0, LOGARITHM_REST), 0.0)
    log_z = mul(Ball(2.0, 0.0), mul(t, total, 0.0), 0.0)
    high = Ball(float(doublings) * LOG_TWO_HIGH, 0.0)
    low = mul(Ball(float(doublings), 0.0), LOG_TWO_LOW, 0.0)
    return add(high, add(low, log_z, 0.0), 0.0)


class _Significand(NamedTuple):
    z: float
    doublings: int


def _significand(x: float) -> _Significand:
    """Such z and k that x = 2^k·z, exactly, and 0.7071 ≤ z < 1.4143; for positive floats.

    Steps of 2^512, 2^256, …, 2 bring z down to between 1 and 2, or up to between 1/2 and 1.
    """
    is_tiny = x < 2.0**-1000  # down to 2^-1074, which is farther than all steps together
    z = x * 2.0**64 if is_tiny else x
    doublings = -64 if is_tiny else 0
    factor, step = 2.0**512, 512
    while step > 0:
        if z >= factor:
            z = z / factor
            doublings = doublings + step
        elif z * factor <= 1.0:
            z = z * factor
            doublings = doublings - step
        factor = math.sqrt(factor)
        step = step // 2
    if z > 1.4142:
        return _Significand(0.5 * z, doublings + 1)
    if z < 0.7071:
        return _Significand(2.0 * z, doublings - 1)
    return _Significand(z, doublings)


def _power_at(base: float, exponent: float) -> Ball:
    """Base^exponent at a positive float."""
    return exp(mul(Ball(exponent, 0.0), _log_at(base), 0.0), 0.0)


def _tan_at(x: float) -> Ball:
    """The tangent of a float between -π/2 and π/2: of large ones 1/tan(π/2 - x), so that no cosine is small."""
    if x < 0.0:
        return neg(_tan_of_positive(-x))
    return _tan_of_positive(x)


def _tan_of_positive(x: float) -> Ball:
    if x == 0.0:
        return Ball(0.0, 0.0)
    if x <= QUARTER_PI:
        return truediv(_sine(Ball(x, 0.0)), _cosine(Ball(x, 0.0)), 0.0)
    rest = add(sub(Ball(HALF_PI, 0.0), Ball(x, 0.0), 0.0), HALF_PI_LOW, 0.0)
    return truediv(_cosine(rest), _sine(rest), 0.0)


def _sine(x: Ball) -> Ball:
    """x·(1 - x²/(2·3)·(1 - x²/(4·5)·(…))), for |x| < 0.79: the rest is below x·0.79^20/21! < x·2^-67 (Leibniz)."""
    return mul(x, _alternating(mul(x, x, 0.0), 1), 0.0)


def _cosine(x: Ball) -> Ball:
    """1 - x²/(1·2)·(1 - x²/(3·4)·(…)), for |x| < 0.79: the rest is below 0.79^20/20! < 2^-67 (Leibniz)."""
    return _alternating(mul(x, x, 0.0), 0)


def _alternating(square: Ball, odd: int) -> Ball:
    """The sum of (-1)^n·x^(2·n)/(2·n + odd)! over ten terms, and what is left of it."""
    total = ONE
    for term in range(TRIGONOMETRIC_TERMS - 1):
        order = 2 * (TRIGONOMETRIC_TERMS - 1 - term) + odd
        divisor = Ball(float(order * (order - 1)), 0.0)
        total = sub(ONE, mul(truediv(square, divisor, 0.0), total, 0.0), 0.0)
    return add(total, Ball(0.0, TRIGONOMETRIC_REST), 0.0)
