from __future__ import annotations

from fractions import Fraction

import pytest

from raytruth.comparisons.court.sectors import is_counterclockwise, surrounds

pytestmark = pytest.mark.clause("CRT-1")

ONE, NONE = Fraction(1), Fraction(0)
EAST, NORTH, WEST, SOUTH = (ONE, NONE), (NONE, ONE), (-ONE, NONE), (NONE, -ONE)


def test_sectors_surround_a_point_if_they_leave_no_gap() -> None:
    quarters = [(EAST, NORTH), (NORTH, WEST), (WEST, SOUTH), (SOUTH, EAST)]
    assert surrounds(quarters)
    assert surrounds([(EAST, WEST), (WEST, EAST)])
    assert surrounds([*quarters, (EAST, WEST)])
    for index in range(4):
        assert not surrounds(quarters[:index] + quarters[index + 1 :])
    assert not surrounds([])
    assert not surrounds([(EAST, WEST), (EAST, WEST)])


def test_a_gap_however_small_is_one() -> None:
    little = (ONE, -Fraction(1, 10**40))
    assert not surrounds([(EAST, WEST), (WEST, little)])
    assert surrounds([(EAST, WEST), (WEST, little), (SOUTH, EAST)])


def test_corners_run_counterclockwise_or_not() -> None:
    assert is_counterclockwise([EAST, NORTH, WEST])
    assert not is_counterclockwise([WEST, NORTH, EAST])
