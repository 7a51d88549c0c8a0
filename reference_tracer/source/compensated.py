"""Sums and products that come with their own rounding error, and what they make exact: |o-c|² - r².

The error of a rounded sum or product is itself a number of the same type (Dekker, "A Floating-Point Technique for
Extending the Available Precision", 1971), which plain operations find, as long as nothing overflows or vanishes and
the compiler neither contracts nor reorders them. In exact arithmetic all these errors are 0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def two_sum(a: Scalar, b: Scalar) -> tuple[Scalar, Scalar]:
    """The rounded sum and its error (Knuth, The Art of Computer Programming, vol. 2, 4.2.2, theorem B)."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def square(a: Scalar) -> tuple[Scalar, Scalar]:
    """The rounded square and its error (Dekker 1971, eq. 5.12 for equal factors), by halves whose products are exact.

    The halves come from Veltkamp's splitting (ibid., eq. 5.6).
    """
    product = a * a
    shifted = splitting_factor() * a
    high = shifted - (shifted - a)
    low = a - high
    return product, low * low - ((product - high * high) - 2.0 * high * low)


def splitting_factor() -> Scalar:
    """2^s + 1 for a number of p = 24 or 53 bits, where s = p/2 rounded up; exact arithmetic splits as it likes."""
    if 1.0 + 9.094947017729282e-13 == 1.0:  # 2^-40, which is lost beside 1 in float32 but not in float64
        return 4097.0
    return 134217729.0


def sphere_constant(origin: Vector, center: Vector, radius: Scalar) -> Scalar:
    """|o-c|² - r², as if computed with twice the bits: its error is about u times the result plus u² times r².

    The sum is Ogita's, Rump's and Oishi's ("Accurate Sum and Dot Product", 2005, algorithm 5.3, Dot2), to which the
    rounding of o-c is added: (m+e)² - m² = e·(2m+e). Valid where no square overflows or loses its error to underflow.
    """
    x, x_error = two_sum(origin[0], -center[0])
    y, y_error = two_sum(origin[1], -center[1])
    z, z_error = two_sum(origin[2], -center[2])
    x_squared, x_rest = square(x)
    y_squared, y_rest = square(y)
    z_squared, z_rest = square(z)
    radius_squared, radius_rest = square(radius)
    two_squares, first_rest = two_sum(x_squared, y_squared)
    three_squares, second_rest = two_sum(two_squares, z_squared)
    difference, third_rest = two_sum(three_squares, -radius_squared)
    of_squares = x_rest + y_rest + z_rest - radius_rest
    of_sums = first_rest + second_rest + third_rest
    of_differences = x_error * (2.0 * x + x_error) + y_error * (2.0 * y + y_error) + z_error * (2.0 * z + z_error)
    return difference + (of_squares + of_sums + of_differences)
