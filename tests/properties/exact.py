"""Exact arithmetic on vectors of fractions, and bounds on rounding, written apart from the tracer.

Rounding: float64 arithmetic gives fl(a ∘ b) = (a ∘ b)(1 + δ) with |δ| <= u = 2^-53, square roots too (IEEE 754), as
long as nothing underflows, which the strategies see to. Then a product of n factors 1 + δ is 1 + θ with |θ| <= γ(n) =
n·u/(1 - n·u), and a dot product of two given vectors of three is off by at most γ(3)·Σ|a_i·b_i| (Higham, Accuracy and
Stability of Numerical Algorithms, 2nd ed., lemma 3.1 and eq. 3.5).
"""

from __future__ import annotations

from fractions import Fraction
from math import isqrt, log2
from typing import TypeAlias

UNIT_ROUNDOFF = Fraction(1, 2**53)

Exact: TypeAlias = tuple[Fraction, Fraction, Fraction]


def gamma(roundings: int) -> Fraction:
    """γ(n)."""
    return roundings * UNIT_ROUNDOFF / (1 - roundings * UNIT_ROUNDOFF)


def exact(vector: tuple[float, float, float]) -> Exact:
    x, y, z = vector
    return Fraction(x), Fraction(y), Fraction(z)


def dot(a: Exact, b: Exact) -> Fraction:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def size_of_dot(a: Exact, b: Exact) -> Fraction:
    """Σ|a_i·b_i|, to which the rounding of a dot product is proportional."""
    return abs(a[0] * b[0]) + abs(a[1] * b[1]) + abs(a[2] * b[2])


def minus(a: Exact, b: Exact) -> Exact:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def plus(a: Exact, b: Exact) -> Exact:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def times(a: Exact, factor: Fraction) -> Exact:
    return a[0] * factor, a[1] * factor, a[2] * factor


def cross(a: Exact, b: Exact) -> Exact:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def at(origin: Exact, direction: Exact, distance: Fraction) -> Exact:
    return plus(origin, times(direction, distance))


def root_above(x: Fraction) -> Fraction:
    """A rational number above the root of x, too large by less than 2^-100 of it for x that is 2^-900 or more."""
    scale = 1 << 1100
    return Fraction(isqrt(x.numerator * scale**2 // x.denominator) + 1, scale)


def length(a: Exact) -> Fraction:
    """An upper bound of |a|, tight as in root_above."""
    return root_above(dot(a, a))


def bits(error: Fraction, size: Fraction) -> float:
    """How many of 53 bits an error takes from a number of this size; 0 for an error of a unit roundoff or less."""
    return log2(max(Fraction(1), error / (size * UNIT_ROUNDOFF))) if size else 0.0
