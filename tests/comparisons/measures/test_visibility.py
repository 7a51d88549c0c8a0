from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.measures.visibility import differs_visibly
from raytruth.comparisons.records.srgb import srgb_decoded

pytestmark = pytest.mark.clause("VER-14")

CODES = st.integers(0, 255)


def of_code(code: float) -> float:
    return float(srgb_decoded(np.array(code / 255)))


@given(CODES, CODES)
def test_codes_more_than_one_apart_are_seen(a: int, b: int) -> None:
    assert differs_visibly(of_code(a), of_code(b)) == (abs(a - b) > 1)


@given(st.floats(1.0, 1e30), st.floats(0.5, 1.0))
def test_above_white_the_share_counts(value: float, share: float) -> None:
    assert differs_visibly(value, share * value) == differs_visibly(1.0, share)
    assert differs_visibly(share * value, value) == differs_visibly(value, share * value)


def test_the_step_at_white_is_about_two_parts_in_a_hundred() -> None:
    assert not differs_visibly(1000.0, 1000.0 * of_code(254))
    assert differs_visibly(1000.0, 1000.0 * of_code(253))
    assert 0.97 < of_code(253) < 0.99


@given(st.floats(-1e30, 0.0), st.floats(0.0, 1.0))
def test_less_than_black_is_black(negative: float, value: float) -> None:
    assert differs_visibly(negative, value) == differs_visibly(0.0, value)


@pytest.mark.parametrize("strange", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_seen_unless_it_is_the_same(strange: float) -> None:
    assert differs_visibly(strange, 0.5)
    assert differs_visibly(0.5, strange)
    assert differs_visibly(strange, strange) == math.isnan(strange)


def test_arrays_broadcast() -> None:
    assert differs_visibly(np.zeros((2, 3)), np.array([0.0, 0.5, 0.0])).tolist() == [[False, True, False]] * 2
