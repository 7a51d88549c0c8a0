from __future__ import annotations

from fractions import Fraction
from math import inf

import numpy as np
import pytest

from raytruth.reference_tracer.source.bounding_volume import box_is_missed, certainly_zero, farthest, rounding_allowance

pytestmark = pytest.mark.clause("TRAV-4")

LOW, HIGH = (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)
ALONG_X = (1.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("origin", "end", "missed"),
    [
        ((-3.0, 0.0, 0.0), inf, False),
        ((-3.0, 1.0, 1.0), inf, False),  # along an edge
        ((-3.0, 1.0 + 2.0**-52, 0.0), inf, True),
        ((-3.0, -1.25, 0.0), inf, True),  # beside it by less than 1
        ((-3.0, 0.0, 1.25), inf, True),
        ((0.0, 0.0, 0.0), inf, False),
        ((3.0, 0.0, 0.0), inf, True),
        ((1.0, 0.0, 0.0), inf, False),  # leaves at the start
        ((-3.0, 0.0, 0.0), 2.0, False),  # ends on the box
        ((-3.0, 0.0, 0.0), 1.9, True),
    ],
)
def test_a_box_is_missed_only_if_no_point_of_the_ray_is_in_it(
    origin: tuple[float, float, float], end: float, missed: bool
) -> None:
    assert box_is_missed(origin, ALONG_X, LOW, HIGH, end) == missed
    backward = (-origin[0], origin[1], origin[2])
    assert box_is_missed(backward, (-1.0, 0.0, 0.0), LOW, HIGH, end) == missed


def test_a_flat_box_is_touched() -> None:
    assert not box_is_missed((-3.0, 0.0, 0.0), ALONG_X, (0.0, -1.0, -1.0), (0.0, 1.0, 1.0), inf)


@pytest.mark.parametrize(("number", "is_zero"), [(0.0, True), (-0.0, True), (5e-324, False), (-5e-324, False)])
def test_only_zeros_of_both_signs_are_zero(number: float, is_zero: bool) -> None:
    assert certainly_zero(number) == is_zero


def test_the_allowance_covers_ten_roundings_of_float32() -> None:
    unit_roundoff = Fraction(1, 2**24)
    allowance = Fraction(float(np.float32(rounding_allowance())))
    assert 10 * unit_roundoff / (1 - 10 * unit_roundoff) <= allowance <= 11 * unit_roundoff


def test_the_farthest_coordinate_is_that_of_a_corner_in_front_or_behind() -> None:
    assert farthest((-3.0, -1.0, 0.5), (-2.0, 1.5, 2.0)) == 3.0
    assert farthest((-3.0, -1.0, 0.5), (-2.0, 4.5, 2.0)) == 4.5
    assert farthest((-3.0, -1.0, 0.5), (5.0, 4.5, 2.0)) == 5.0
    assert farthest((-3.0, -1.0, 0.5), (-2.0, 1.5, 6.0)) == 6.0
    assert farthest((1.0, 1.0, -7.0), (2.0, 4.5, -6.0)) == 7.0
