"""Quotients of polynomials in one symbol: exact rational arithmetic, with one number of which nothing is known.

The symbol stands for a number that obeys no equation that matters here, as the tangent of half a field of view. What
is zero for every value of the symbol is zero for its own. Polynomials are FLINT's, so that their operations are quick.
"""

from __future__ import annotations

from typing import Any

from flint import fmpq_poly
from flint.utils.flint_exceptions import DomainError

ONE_POLYNOMIAL = fmpq_poly([1])


class Quotient:
    """Numerator over denominator in lowest terms; the denominator's leading coefficient is 1."""

    __slots__ = ("denominator", "numerator")

    def __init__(self, numerator: Any, denominator: Any = ONE_POLYNOMIAL) -> None:
        """Of polynomials already in lowest terms; `reduced` brings others to them."""
        self.numerator = numerator
        self.denominator = denominator

    def __add__(self, other: Quotient) -> Quotient:
        if self.denominator == other.denominator:
            return reduced(self.numerator + other.numerator, self.denominator)
        numerator = self.numerator * other.denominator + other.numerator * self.denominator
        return reduced(numerator, self.denominator * other.denominator)

    def __neg__(self) -> Quotient:
        return Quotient(-self.numerator, self.denominator)

    def __mul__(self, other: Quotient) -> Quotient:
        return reduced(self.numerator * other.numerator, self.denominator * other.denominator)

    def inverse(self) -> Quotient:
        """One over this quotient, which is not zero."""
        leading = self.numerator.leading_coefficient()
        return Quotient(self.denominator / leading, self.numerator / leading)

    def is_zero(self) -> bool:
        """Whether it is zero for every value of the symbol."""
        return bool(self.numerator.is_zero())

    def is_constant(self) -> bool:
        """Whether the symbol does not occur."""
        return bool(self.numerator.degree() <= 0 and self.denominator.degree() == 0)

    def square_root(self) -> Quotient | None:
        """A quotient whose square this is; None if there is none."""
        try:
            return Quotient(self.numerator.sqrt(), self.denominator.sqrt())
        except (DomainError, ValueError):  # of whole coefficients, and of others
            return None

    def size(self) -> int:
        """About how long an operation with it takes, in those of a short constant.

        Bringing it to lowest terms takes longest, for which each term of one polynomial meets each of the other, at a
        64th of what a constant takes that is as long: so it was measured, and holds within a factor of three or so.
        """
        meetings = int(self.numerator.degree() + 1) * int(self.denominator.degree() + 1)
        return (63 + meetings) * (1 + int(self.numerator.numer().height_bits()) // 128) // 64


def reduced(numerator: Any, denominator: Any) -> Quotient:
    """A quotient of any polynomials; the denominator is not zero, and its leading coefficient 1."""
    if denominator.degree() == 0:
        return Quotient(numerator)
    common = numerator.gcd(denominator)
    if common.degree() == 0:
        return Quotient(numerator, denominator)
    return Quotient(numerator // common, denominator // common)
