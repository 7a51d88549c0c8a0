"""Exponentials and whole powers of double-double balls (double_double_balls.py), to all their digits.

Both are short computations in balls, so that what the operations lose bounds itself; beside them only the rest of a
series is to be bounded. What else there is has the digits of one float (double_double_functions.py).
"""

from __future__ import annotations

import math

from raytruth.reference_tracer.arithmetics import double_double_functions
from raytruth.reference_tracer.arithmetics.double_double_balls import DoubleDoubleBall, add, mul, sub, truediv
from raytruth.reference_tracer.arithmetics.float_balls import OUTWARD

ONE = DoubleDoubleBall(1.0, 0.0, 0.0)
EXACT = 0.0
"""The roundoff of an arithmetic that rounds nothing."""
# log 2 as two floats; the rest is 5.7e-34.
LOG_TWO = DoubleDoubleBall(float.fromhex("0x1.62e42fefa39efp-1"), float.fromhex("0x1.abc9e3b39803fp-56"), 2.0**-110)
# e^x is the series of x/2^8 up to this degree, squared 8 times.
HALVINGS, DEGREE = 8, 12
# The series' rest is at most |x|^13/13!·1/(1 - |x|) for |x| < 1 (each term is at most |x| times the one before):
# for |x| ≤ 2^-8 that is below 2^-136.
REST = DoubleDoubleBall(0.0, 0.0, 2.0**-136)
# e^±256 is of common size (double_double_balls.py).
LARGEST_EXPONENT = 256.0
# So large a power takes 12 squarings.
LARGEST_POWER = 4096.0


def power(base: DoubleDoubleBall, exponent: DoubleDoubleBall) -> DoubleDoubleBall:
    """The power, for exponents that are not negative; to all digits where they are whole numbers for certain."""
    whole = 0
    if 0.0 <= exponent.high <= LARGEST_POWER:
        whole = math.floor(exponent.high)
    if exponent.low != 0.0 or exponent.radius != 0.0 or float(whole) != exponent.high:
        return double_double_functions.power(base, exponent, EXACT)
    return whole_power(base, whole)


def whole_power(base: DoubleDoubleBall, exponent: int) -> DoubleDoubleBall:
    """The base times itself, by squaring; `exponent` is not negative."""
    product, square, left = ONE, base, exponent
    while left > 0:
        if left % 2 == 1:
            product = mul(product, square, EXACT)
        square = mul(square, square, EXACT)
        left = left // 2
    return product


def exp(a: DoubleDoubleBall) -> DoubleDoubleBall:
    """e^a = (e^x)^256·2^k, for x = (a - k·log 2)/256 and the whole number k next to a/log 2."""
    if not abs(a.high) <= LARGEST_EXPONENT:
        return double_double_functions.exp(a, EXACT)
    twos = math.floor(a.high / LOG_TWO.high + 0.5)
    reduced = sub(a, mul(DoubleDoubleBall(float(twos), 0.0, 0.0), LOG_TWO, EXACT), EXACT)
    x = mul(reduced, DoubleDoubleBall(2.0**-HALVINGS, 0.0, 0.0), EXACT)
    if not (abs(x.high) + abs(x.low) + x.radius) * OUTWARD <= 2.0**-HALVINGS:
        return double_double_functions.exp(a, EXACT)  # of a wide ball
    total, term = ONE, ONE
    for degree in range(1, DEGREE + 1):
        term = truediv(mul(term, x, EXACT), DoubleDoubleBall(float(degree), 0.0, 0.0), EXACT)
        total = add(total, term, EXACT)
    total = add(total, REST, EXACT)
    for _ in range(HALVINGS):
        total = mul(total, total, EXACT)
    half_or_two = DoubleDoubleBall(2.0 if twos > 0 else 0.5, 0.0, 0.0)
    return mul(total, whole_power(half_or_two, max(twos, -twos)), EXACT)
