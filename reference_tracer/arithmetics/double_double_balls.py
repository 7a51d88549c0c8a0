"""Balls whose middle is the unevaluated sum of two float64 numbers, some 106 bits; the radius is one float64.

The middle is a double word: `low` is at most half a unit in the last place of `high`. The algorithms and the bounds of
their errors are those of Joldes, Muller, Popescu, "Tight and Rigorous Error Bounds for Basic Building Blocks of
Double-Word Arithmetic", 2017, and hold where nothing underflows or overflows. So they are used for numbers of common
size alone, and for narrow balls; all else is left to balls of one float (float_balls.py), which hold the same numbers,
and are as tight where a ball is wide. What is subnormal on the way is then below the slack of each bound.

Functions take their arguments as those of float_balls.py do.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from raytruth.reference_tracer.arithmetics import float_balls
from raytruth.reference_tracer.arithmetics.float_balls import (
    LARGEST,
    OUTWARD,
    UNDERFLOW,
    UNIT_ROUNDOFF,
    WIDE_DIVISOR,
    WIDE_RADICAND,
    Ball,
)
from raytruth.reference_tracer.compiler.exact_errors import product_error

U_SQUARED = UNIT_ROUNDOFF * UNIT_ROUNDOFF
# The published bounds in u², rounded up to leave some u² for u³ and for what underflows: 3 (theorem 3.1), 7 (theorem
# 5.1), 15 (theorem 6.2), and 25/8 of the root (Lefèvre et al., "Accurate Calculation of Euclidean Norms Using
# Double-Word Arithmetic", 2023, algorithm 8).
LOST_OF_SUM = 4 * U_SQUARED
LOST_OF_PRODUCT = 8 * U_SQUARED
LOST_OF_QUOTIENT = 16 * U_SQUARED
LOST_OF_ROOT = 4 * U_SQUARED

# Between these, squares and quotients and the errors of their roundings, 2^-106 as large, are normal numbers.
LEAST, MOST = 2.0**-400, 2.0**400


class DoubleDoubleBall(NamedTuple):
    """All numbers within a radius of high + low."""

    high: float
    low: float
    radius: float


class DoubleWord(NamedTuple):
    """The sum of two floats."""

    high: float
    low: float


def to_float_ball(a: DoubleDoubleBall) -> Ball:
    """A ball around `high` that holds the ball."""
    if a.low == 0.0:
        return Ball(a.high, a.radius)
    return Ball(a.high, (a.radius + abs(a.low)) * OUTWARD)


def from_float_ball(a: Ball) -> DoubleDoubleBall:
    """The same ball."""
    return DoubleDoubleBall(a.middle, 0.0, a.radius)


def add(a: DoubleDoubleBall, b: DoubleDoubleBall, roundoff: float) -> DoubleDoubleBall:
    """The sum, with radius r_a + r_b + e, where e ≤ 4·u²·|s| (AccurateDWPlusDW, algorithm 6).

    e = 0 for two floats, and where one number is 0: those sums are exact.
    """
    if not (abs(a.high) <= MOST and abs(b.high) <= MOST):
        return from_float_ball(float_balls.add(to_float_ball(a), to_float_ball(b), roundoff))
    high, low = two_sum(a.high, b.high), two_sum(a.low, b.low)
    partial = fast_two_sum(high.high, high.low + low.high)
    middle = fast_two_sum(partial.high, low.low + partial.low)
    is_exact = (a.low == 0.0 and b.low == 0.0) or a.high == 0.0 or b.high == 0.0
    lost = 0.0 if is_exact else LOST_OF_SUM * abs(middle.high)
    radius = a.radius + b.radius + lost
    if lost == 0.0 and not is_exact and middle.high != 0.0:
        radius = radius + UNDERFLOW
    return _rounded(middle, radius, roundoff)


def sub(a: DoubleDoubleBall, b: DoubleDoubleBall, roundoff: float) -> DoubleDoubleBall:
    """The difference, which is the sum of a and -b."""
    return add(a, neg(b), roundoff)


def mul(a: DoubleDoubleBall, b: DoubleDoubleBall, roundoff: float) -> DoubleDoubleBall:
    """The product, with the radius of `float_balls.mul`, where e ≤ 8·u²·|p| (DWTimesDW1, algorithm 10).

    e = 0 for two floats. |high + low| ≤ |high|·(1 + u), which is a rounding more.
    """
    if not (_is_common(a.high) and _is_common(b.high)):
        return from_float_ball(float_balls.mul(to_float_ball(a), to_float_ball(b), roundoff))
    product = two_product(a.high, b.high)
    middle = fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high))
    lost = 0.0 if a.low == 0.0 and b.low == 0.0 else LOST_OF_PRODUCT * abs(middle.high)
    spread = abs(a.high) * b.radius + a.radius * (abs(b.high) + b.radius)
    if a.radius > 0.0 or b.radius > 0.0:
        spread = spread + UNDERFLOW
    return _rounded(middle, spread * OUTWARD + lost, roundoff)


def truediv(a: DoubleDoubleBall, b: DoubleDoubleBall, roundoff: float) -> DoubleDoubleBall:
    """The quotient, with the radius of `float_balls.truediv`, where e ≤ 16·u²·|q| (DWDivDW2, algorithm 17)."""
    if not (_is_common(a.high) and _is_common(b.high) and b.radius <= WIDE_DIVISOR * abs(b.high)):
        return from_float_ball(float_balls.truediv(to_float_ball(a), to_float_ball(b), roundoff))
    quotient = a.high / b.high
    product = two_product(b.high, quotient)  # b·quotient is DWTimesFP1, algorithm 7
    upper = fast_two_sum(product.high, b.low * quotient)
    back = fast_two_sum(upper.high, upper.low + product.low)
    rest = (a.high - back.high) + (a.low - back.low)
    middle = fast_two_sum(quotient, rest / b.high)
    spread = (a.radius + abs(middle.high) * b.radius) / (abs(b.high) - b.radius)
    if a.radius > 0.0 or b.radius > 0.0:
        spread = spread + UNDERFLOW / LEAST  # a product of b's radius may lose η/2, divided by LEAST/2 at least
    return _rounded(middle, spread * OUTWARD + LOST_OF_QUOTIENT * abs(middle.high), roundoff)


def sqrt(a: DoubleDoubleBall, roundoff: float) -> DoubleDoubleBall:
    """The root, with the radius of `float_balls.sqrt`, where e ≤ 4·u²·√m (SQRTDWtoDW; x - s² is exact)."""
    if not (_is_common(a.high) and a.high > 0.0 and a.radius <= WIDE_RADICAND * a.high):
        return from_float_ball(float_balls.sqrt(to_float_ball(a), roundoff))
    root = math.sqrt(a.high)
    square = two_product(root, root)
    rest = (a.high - square.high) - square.low
    middle = fast_two_sum(root, (rest + a.low) / (2.0 * root))
    spread = a.radius / (root + math.sqrt(a.high - a.radius))
    if a.radius > 0.0:
        spread = spread + UNDERFLOW
    return _rounded(middle, spread * OUTWARD + LOST_OF_ROOT * root, roundoff)


def neg(a: DoubleDoubleBall) -> DoubleDoubleBall:
    """-a, which is exact."""
    return DoubleDoubleBall(-a.high, -a.low, a.radius)


def absolute(a: DoubleDoubleBall) -> DoubleDoubleBall:
    """|a|, which is a or -a where its sign is certain."""
    plain = to_float_ball(a)
    if abs(plain.middle) >= plain.radius:
        return neg(a) if a.high < 0.0 else a
    return from_float_ball(float_balls.absolute(plain))


def _is_common(number: float) -> bool:
    return LEAST <= abs(number) <= MOST


def _rounded(middle: DoubleWord, radius: float, roundoff: float) -> DoubleDoubleBall:
    """A ball times 1 ± roundoff, rounded outward; |high + low| ≤ |high|·(1 + u), which is a rounding more."""
    if radius == 0.0 and (roundoff == 0.0 or middle.high == 0.0):
        return DoubleDoubleBall(middle.high, middle.low, 0.0)
    if not radius <= LARGEST:  # it may be NaN, of 0 times infinity
        return DoubleDoubleBall(middle.high, middle.low, math.inf)
    wider = float_balls.rounded(middle.high, radius, roundoff)
    return DoubleDoubleBall(middle.high, middle.low, wider.radius)


def fast_two_sum(a: float, b: float) -> DoubleWord:
    """The sum, exactly, if |a| ≥ |b| or a = 0 (Dekker, "A Floating-Point Technique", 1971)."""
    total = a + b
    return DoubleWord(total, b - (total - a))


def two_sum(a: float, b: float) -> DoubleWord:
    """The sum, exactly (Knuth, "The Art of Computer Programming", volume 2, section 4.2.2, theorem B)."""
    total = a + b
    back = total - a
    return DoubleWord(total, (a - (total - back)) + (b - back))


def two_product(a: float, b: float) -> DoubleWord:
    """The product, exactly, if nothing overflows and its last bit is a float (Dekker 1971, after Veltkamp)."""
    return DoubleWord(a * b, product_error(a, b))
