"""Balls of two float64 numbers, and what the four operations and the square root do to them.

A ball (middle, radius) stands for all x with |x - middle| ≤ radius. An infinite radius says that x may be any number;
a middle that is NaN, that there may be none. An infinite middle of radius 0 is that infinity.

These are plain functions over floats, which run as they stand and can be compiled. Each takes the balls and `roundoff`:
0 for the exact results at all points of the balls; 2^-p for all that an arithmetic may give whose operations err by
2^-p at most, relatively, as `rounded_ball_arithmetic` does with Arb (balls.py): what is exact, times 1 ± roundoff.

Throughout, u = 2^-53 is the unit roundoff of float64 to nearest and η = 2^-1074 its smallest number. What is computed
as s errs by at most u·|s|, if it is a sum or a difference, and by at most u·|s| + η/2, if it is a product or a quotient
(Higham, "Accuracy and Stability of Numerical Algorithms", 2002, equations 2.5 and 2.8). Radii are computed in the same
floats, and then made larger by more than all that their own computation may have lost. Nothing may be contracted,
reordered or flushed to zero.
"""

from __future__ import annotations

import math
from typing import NamedTuple

UNIT_ROUNDOFF = 2.0**-53
SMALLEST = 2.0**-1074
LARGEST = float.fromhex("0x1.fffffffffffffp+1023")

# No radius, and no root of an end, takes more than twelve roundings in a row, the multiplication by this among them;
# each makes it too small by a factor of 1 - u at most, and (1 - u)^-12 < 1 + 16·u.
OUTWARD = 1.0 + 16 * UNIT_ROUNDOFF
# A quotient's or a root's radius by the formula of narrow balls is then at most 1/32 larger than it need be.
WIDE_DIVISOR = 1 / 32
WIDE_RADICAND = 1 / 8
# Where products and quotients are subnormal each loses η/2 at most; a radius and its middle take fewer than sixteen.
# To a number as small as that it is added exactly.
UNDERFLOW = 8 * SMALLEST


class Ball(NamedTuple):
    """All numbers within a radius of a middle."""

    middle: float
    radius: float


ANYTHING = Ball(0.0, math.inf)
UNKNOWN = Ball(math.nan, math.inf)


def rounded(middle: float, radius: float, roundoff: float) -> Ball:
    """A finite ball times 1 ± roundoff, rounded outward: |x·(1 + δ) - m| ≤ r + roundoff·|m| + roundoff·r."""
    if roundoff == 0.0:  # the compiler may not leave out a product with 0, which may be NaN
        return Ball(middle, radius * OUTWARD + UNDERFLOW)
    return Ball(middle, (radius + roundoff * abs(middle) + roundoff * radius) * OUTWARD + UNDERFLOW)


def rounded_ball(a: Ball, roundoff: float) -> Ball:
    """A ball times 1 ± roundoff; what is not finite stays as it is, and so does what is exact."""
    is_exact = a.radius == 0.0 and (roundoff == 0.0 or a.middle == 0.0)
    if is_exact or not (a.radius <= LARGEST and abs(a.middle) <= LARGEST):
        return a
    return rounded(a.middle, a.radius, roundoff)


def add(a: Ball, b: Ball, roundoff: float) -> Ball:
    """The sum, with radius r_a + r_b + e, where e is what is lost of the sum of the middles: 0 where that is exact.

    e is a float, and TwoSum finds it whatever the order of the middles' sizes (Knuth, "The Art of Computer
    Programming", volume 2, section 4.2.2, theorem B; Muller et al., "Handbook of Floating-Point Arithmetic", 2018,
    algorithm 4.4). Where a step of it overflows it gives no number that is smaller than the bound u·|s|.
    """
    middle = a.middle + b.middle
    back = middle - a.middle
    found = abs((a.middle - (middle - back)) + (b.middle - back))
    bound = UNIT_ROUNDOFF * abs(middle)
    lost = found if found < bound else bound  # not so if it is NaN
    radius = a.radius + b.radius + lost
    if not (abs(middle) <= LARGEST and radius <= LARGEST):
        return _unbounded(a, b, middle, roundoff)
    if radius == 0.0 and (roundoff == 0.0 or middle == 0.0):
        return Ball(middle, 0.0)
    return rounded(middle, radius, roundoff)


def sub(a: Ball, b: Ball, roundoff: float) -> Ball:
    """The difference, which is the sum of a and -b."""
    return add(a, neg(b), roundoff)


def mul(a: Ball, b: Ball, roundoff: float) -> Ball:
    """The product, with radius |m_a|·r_b + r_a·(|m_b| + r_b) + e (Rump, "Fast and Parallel Interval Arithmetic", 1999).

    For xy - m_a·m_b = m_a·(y - m_b) + (x - m_a)·y, and |y| ≤ |m_b| + r_b. The rounding of the middle e is at most
    u·|m| + η/2. Zero without a radius stays so.
    """
    if (_is_zero(a) and abs(b.middle) <= LARGEST) or (_is_zero(b) and abs(a.middle) <= LARGEST):
        return Ball(0.0, 0.0)
    middle = a.middle * b.middle
    lost = UNIT_ROUNDOFF * abs(middle)
    radius = abs(a.middle) * b.radius + a.radius * (abs(b.middle) + b.radius) + lost
    if not (abs(middle) <= LARGEST and radius <= LARGEST):
        return _unbounded(a, b, middle, roundoff)
    return rounded(middle, radius, roundoff)


def truediv(a: Ball, b: Ball, roundoff: float) -> Ball:
    """The quotient, with radius (r_a + |q|·r_b)/(|m_b| - r_b) + e, where q = m_a/m_b; unknown if b may be 0.

    For x/y - q = ((x - m_a) - q·(y - m_b))/y, and |y| ≥ |m_b| - r_b. The computed quotient errs by e ≤ u·|q| + η/2, so
    |q| is at most (1 + 2·u) times the computed one, plus η. Before the division a product of r_b may lose η/2, which
    the division makes large; where r_b is 0 it loses nothing.

    That radius is larger than half of what lies between the extreme quotients by a factor of 1 + r_b/|m_b| at most:
    where that is too much, the extremes themselves are taken.
    """
    if abs(b.middle) == math.inf and b.radius <= LARGEST and abs(a.middle) <= LARGEST and a.radius <= LARGEST:
        return Ball(0.0, 0.0)
    least = abs(b.middle) - b.radius
    least = least - 2.0 * UNIT_ROUNDOFF * least  # rounded down; a subnormal difference is exact, and stays as it is
    if not least > 0.0:
        return UNKNOWN
    if _is_zero(a):
        return Ball(0.0, 0.0)
    if b.radius > WIDE_DIVISOR * abs(b.middle):
        extremes = _extreme_quotients(a, b) if b.middle > 0.0 else _extreme_quotients(neg(a), neg(b))
        return rounded_ball(extremes, roundoff)
    middle = a.middle / b.middle
    spread = a.radius
    if b.radius > 0.0:
        spread = spread + (abs(middle) + SMALLEST) * b.radius + SMALLEST
    radius = spread / least + UNIT_ROUNDOFF * abs(middle)
    if not (abs(middle) <= LARGEST and radius <= LARGEST):
        return _unbounded(a, b, middle, roundoff)
    return rounded(middle, radius, roundoff)


def _extreme_quotients(a: Ball, b: Ball) -> Ball:
    """All x/y for y > 0: a lower end that is negative is least over the least y, one that is positive over the most."""
    least, most = lower(a), upper(a)
    least_quotient = least / (lower(b) if least < 0.0 else upper(b))
    most_quotient = most / (upper(b) if most < 0.0 else lower(b))
    return hull(below(least_quotient), -below(-most_quotient))


def below(computed: float) -> float:
    """A float that is at most what was computed to nearest as this: x ≥ s - u·|s| - η/2."""
    return computed - 2.0 * UNIT_ROUNDOFF * abs(computed) - SMALLEST


def _is_zero(a: Ball) -> bool:
    return a.middle == 0.0 and a.radius == 0.0


def _unbounded(a: Ball, b: Ball, middle: float, roundoff: float) -> Ball:
    """A result beyond the floats, or of operands that are.

    An infinity of exact operands is exact, unless it is finite floats that overflowed: then the result is a number.
    """
    if math.isnan(a.middle) or math.isnan(b.middle):
        return UNKNOWN
    if abs(a.middle) <= LARGEST and abs(b.middle) <= LARGEST:
        return ANYTHING
    if a.radius == 0.0 and b.radius == 0.0 and roundoff == 0.0:
        return Ball(middle, 0.0) if not math.isnan(middle) else UNKNOWN
    return UNKNOWN


def neg(a: Ball) -> Ball:
    """-a, which is exact, and in no arithmetic rounded."""
    return Ball(-a.middle, a.radius)


def absolute(a: Ball) -> Ball:
    """|a|: of a ball around 0 the ball from 0 to its farther end. In no arithmetic is it rounded."""
    if abs(a.middle) >= a.radius or not abs(a.middle) <= LARGEST:
        return Ball(abs(a.middle), a.radius)
    return from_zero_to(upper(Ball(abs(a.middle), a.radius)))


def sqrt(a: Ball, roundoff: float) -> Ball:
    """The root of the part of a that is not negative; unknown if there is none.

    The source takes roots only of what it decided not to be negative. If all of a is not negative, the radius is
    r/(√m + √(m - r)) + e: |√x - √m| = |x - m|/(√x + √m), which is largest at x = m - r. The rounding e is at most
    u·√m; no root is subnormal. That is larger than half of what lies between the roots of both ends by a factor of
    1 + r/(4·m) + …: where that is too much, those roots are taken, and 0 for that of a negative end.
    """
    least, most = lower(a), upper(a)
    if _is_zero(a) or math.isnan(most) or not most >= 0.0:
        return a if _is_zero(a) else UNKNOWN
    if most == math.inf:
        return Ball(math.inf, 0.0) if a.radius == 0.0 and roundoff == 0.0 else UNKNOWN
    if a.radius > WIDE_RADICAND * a.middle:
        least_root = below(math.sqrt(least)) if least > 0.0 else 0.0
        return rounded_ball(hull(least_root, math.sqrt(most) * OUTWARD), roundoff)
    middle = math.sqrt(a.middle)
    return rounded(middle, a.radius / (middle + math.sqrt(least)) + UNIT_ROUNDOFF * middle, roundoff)


def lower(a: Ball) -> float:
    """A float that is at most m - r; m itself if r is 0. The rounded difference errs by at most u times itself."""
    difference = a.middle - a.radius
    if a.radius == 0.0 or not abs(difference) <= LARGEST:
        return a.middle if a.radius == 0.0 else (math.nan if math.isnan(difference) else difference)
    return difference - 2.0 * UNIT_ROUNDOFF * abs(difference)


def upper(a: Ball) -> float:
    """A float that is at least m + r; m itself if r is 0."""
    return -lower(neg(a))


def from_zero_to(most: float) -> Ball:
    """The ball of all numbers from 0 to a float."""
    return hull(0.0, most)


def hull(least: float, most: float) -> Ball:
    """A ball that holds all numbers from one float to another; anything, if one is infinite."""
    if math.isnan(least) or math.isnan(most):
        return UNKNOWN
    if least == most:
        return Ball(least, 0.0)
    middle = 0.5 * least + 0.5 * most
    farther = max(most - middle, middle - least)
    if not farther <= LARGEST:
        return ANYTHING
    return Ball(middle, farther * OUTWARD + UNDERFLOW)
