from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq, fmpq_poly
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.quotients import Quotient, reduced
from tests.reproduction import note_case

pytestmark = pytest.mark.clause("ARI-3")

COEFFICIENTS = st.lists(st.integers(-9, 9), min_size=1, max_size=4)


def quotient(numerator: list[int], denominator: list[int]) -> Quotient:
    """Of any two polynomials whose second is not zero."""
    polynomial = fmpq_poly(denominator)
    leading = polynomial.leading_coefficient()
    return reduced(fmpq_poly(numerator) / leading, polynomial / leading)


def value(x: Quotient, symbol: int) -> Fraction | None:
    """The quotient where the symbol is this number; None where that divides by zero."""
    below = _fraction(x.denominator(symbol))
    return _fraction(x.numerator(symbol)) / below if below else None


def _fraction(number: Any) -> Fraction:
    number = fmpq(number)
    return Fraction(int(number.p), int(number.q))


@given(COEFFICIENTS, COEFFICIENTS.filter(any), COEFFICIENTS, COEFFICIENTS.filter(any), st.integers(-9, 9))
def test_quotients_are_added_and_multiplied_as_their_values_are(
    a: list[int], b: list[int], c: list[int], d: list[int], symbol: int
) -> None:
    note_case(a=a, b=b, c=c, d=d, symbol=symbol)
    x, y = quotient(a, b), quotient(c, d)
    of_x, of_y = value(x, symbol), value(y, symbol)
    if of_x is None or of_y is None:
        return
    assert value(x + y, symbol) == of_x + of_y
    assert value(x * y, symbol) == of_x * of_y
    assert value(-x, symbol) == -of_x
    if of_x:
        assert value(x.inverse(), symbol) == 1 / of_x
    assert (x + -x).is_zero()
    assert (x * y).denominator.leading_coefficient() == 1


@given(COEFFICIENTS, COEFFICIENTS.filter(any))
def test_a_square_has_a_root_and_twice_a_square_has_none(a: list[int], b: list[int]) -> None:
    note_case(a=a, b=b)
    x = quotient(a, b)
    root = (x * x).square_root()
    assert root is not None
    assert (root * root + -(x * x)).is_zero()
    if not x.is_zero():
        assert (x * x * Quotient(fmpq_poly([2]))).square_root() is None
        assert (x * x * Quotient(fmpq_poly([fmpq(1, 2)]))).square_root() is None
        assert (x * x * Quotient(fmpq_poly([0, 1]))).square_root() is None


def test_a_constant_has_no_symbol_and_a_larger_quotient_is_more_work() -> None:
    assert quotient([3], [7]).is_constant()
    assert quotient([0, 3], [0, 7]).is_constant()
    assert not quotient([3], [0, 1]).is_constant()
    assert not quotient([0, 1], [3]).is_constant()
    short, long = quotient([3], [1]), quotient([3**999], [1])
    many, more = (
        quotient([3] + [0] * 19 + [1], [5] + [0] * 19 + [1]),
        quotient([3] + [0] * 39 + [1], [5] + [0] * 39 + [1]),
    )
    assert short.size() == 1
    assert 1 < long.size() < quotient([3**9999], [1]).size()
    assert 1 < many.size() < more.size()
