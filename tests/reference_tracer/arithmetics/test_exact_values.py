from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from flint import arb, fmpq

from raytruth.reference_tracer.arithmetics.exact_values import INFINITE, NOT_A_NUMBER, Beyond, ExactValues, Value
from raytruth.reference_tracer.arithmetics.root_tower import NotExactError, constant

pytestmark = pytest.mark.clause("ARI-3")

NUMBERS = (0.0, 2.0, -3.0, math.inf, math.nan)


def exact(number: float) -> Value:
    if math.isnan(number):
        return NOT_A_NUMBER
    return INFINITE if math.isinf(number) else constant(fmpq(int(number)))


def agrees(value: Value, number: float) -> bool:
    if isinstance(value, Beyond):
        return value is exact(number)
    nearby = arb(number, abs(number) * 2.0**-53)  # float64 has rounded it
    return math.isfinite(number) and bool(ExactValues(9).tower.ball(value).overlaps(nearby))


@pytest.mark.parametrize("name", ["add", "subtract", "multiply", "divide"])
@pytest.mark.parametrize(("a", "b"), list(itertools.product(NUMBERS, repeat=2)))
def test_what_is_no_real_number_is_as_ieee_754_has_it_or_not_known(name: str, a: float, b: float) -> None:
    operation = getattr(np, name)
    with np.errstate(all="ignore"):
        expected = float(operation(a, b))
    try:
        value = getattr(ExactValues(1000), name)(exact(a), exact(b))
    except NotExactError:
        assert math.isinf(a) or math.isinf(b)  # whose sign is not kept
    else:
        assert agrees(value, expected)


@pytest.mark.parametrize(("a", "b"), [(2.0, -3.0), (-3.0, 2.0), (2.0, 2.0), (0.0, 2.0)])
def test_extremes_and_absolute_values_are_chosen_by_the_sign(a: float, b: float) -> None:
    values = ExactValues(1000)
    assert agrees(values.smaller(exact(a), exact(b)), min(a, b))
    assert agrees(values.larger(exact(a), exact(b)), max(a, b))
    assert agrees(values.absolute(exact(a)), abs(a))
    assert values.sign(exact(a)) == (a > 0) - (a < 0)


def test_the_root_of_what_is_no_number_is_none_and_nothing_infinite_has_a_sign() -> None:
    values = ExactValues(1000)
    assert values.square_root(NOT_A_NUMBER) is NOT_A_NUMBER
    assert values.square_root(INFINITE) is INFINITE
    for beyond in Beyond:
        with pytest.raises(NotExactError):
            values.sign(beyond)
