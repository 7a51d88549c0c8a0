"""The strategies for angles and indices reach the extremes that the properties are about."""

from __future__ import annotations

from fractions import Fraction
from math import isnan, sqrt
from typing import TYPE_CHECKING, Any

import pytest

from tests.meta.test_generators import reaches
from tests.properties.optical_strategies import (
    DISTANCES,
    EXPONENTS,
    EXTREME_COSINES,
    EXTREME_RATIOS,
    MOST_ULPS,
    NOT_NUMBERS,
    incidences,
    moved,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from hypothesis import strategies as st

pytestmark = pytest.mark.clause("PRJ-5")


@pytest.mark.parametrize("ulps", range(-MOST_ULPS, MOST_ULPS + 1))
def test_incidences_reach_every_ulp_around_the_critical_angle(ulps: int) -> None:
    def is_so_far(case: tuple[float, float]) -> bool:
        cosine, ratio = case
        return 0.1 < ratio < 1.0 and cosine == moved(sqrt((1.0 - ratio) * (1.0 + ratio)), ulps)

    reaches(incidences(), is_so_far)


@pytest.mark.parametrize("sign", [1, -1])
def test_incidences_reach_both_sides_of_the_critical_angle_within_rounding(sign: int) -> None:
    def is_close(case: tuple[float, float]) -> bool:
        cosine, ratio = map(Fraction, case)
        discriminant = sign * (ratio**2 - 1 + cosine**2)
        return ratio < 1 and 0 < discriminant < cosine**2 / 10**14

    reaches(incidences(), is_close)


def test_incidences_are_never_exactly_critical_but_grazing_at_equal_indices() -> None:
    # c² + η² = 1 in whole numbers is a² + b² = 4^k, which only a = 0 or b = 0 solve: modulo 4 both must be even.
    for ratio in (0.6, 0.8, 1 / 1.5, 1e-3, 1.0 - 2.0**-53):
        critical = sqrt((1.0 - ratio) * (1.0 + ratio))
        squares = [Fraction(moved(critical, ulps)) ** 2 for ulps in range(-MOST_ULPS, MOST_ULPS + 1)]
        assert 1 - Fraction(ratio) ** 2 not in squares


@pytest.mark.parametrize(
    ("strategy", "is_the_case"),
    [
        pytest.param(EXTREME_RATIOS, lambda r: 0 < r - 1 < 1e-6, id="barely denser"),
        pytest.param(EXTREME_RATIOS, lambda r: 0 < 1 - r < 1e-6, id="barely thinner"),
        pytest.param(EXTREME_RATIOS, lambda r: r == 1, id="equal"),
        pytest.param(EXTREME_RATIOS, lambda r: r == 1e3, id="a thousand times denser"),
        pytest.param(EXTREME_RATIOS, lambda r: r == 1e-3, id="a thousand times thinner"),
        pytest.param(EXTREME_RATIOS, lambda r: 1e-6 < abs(r - 1) < 1e-1, id="near 1"),
        pytest.param(EXTREME_COSINES, lambda c: c == 0 and str(c) == "-0.0", id="negative zero"),
        pytest.param(EXTREME_COSINES, lambda c: 0 < c < 2.0**-1022, id="subnormal"),
        pytest.param(EXTREME_COSINES, lambda c: c > 0 and c * c == 0, id="square underflows"),
        pytest.param(EXTREME_COSINES, lambda c: c > 1, id="beyond 1 by rounding"),
        pytest.param(EXTREME_COSINES, lambda c: 1 - 2.0**-52 < c < 1, id="all but head on"),
        pytest.param(EXTREME_COSINES, lambda c: 1e-20 < c < 1e-10, id="grazing"),
        pytest.param(DISTANCES, lambda d: 0 < d < 1e-9, id="tiny"),
        pytest.param(DISTANCES, lambda d: d > 1e9, id="huge"),
        pytest.param(DISTANCES, lambda d: d == 0, id="none"),
        pytest.param(EXPONENTS, lambda n: n == 1e6, id="mirror-like"),
        pytest.param(EXPONENTS, lambda n: n < 1, id="broad"),
        pytest.param(NOT_NUMBERS, isnan, id="NaN"),
        pytest.param(NOT_NUMBERS, lambda x: x < 0, id="negative infinity"),
    ],
)
def test_strategies_reach(strategy: st.SearchStrategy[Any], is_the_case: Callable[[Any], bool]) -> None:
    reaches(strategy, is_the_case)
