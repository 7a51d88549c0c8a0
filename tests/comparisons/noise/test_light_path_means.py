from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.noise.light_path_means import LARGEST_ROUNDING, compare_light_paths
from raytruth.comparisons.noise.mean_test import SIGNIFICANCE

if TYPE_CHECKING:
    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("VER-6")

PATHS = 10_000
TESTS = 3  # one pixel, three channels


def pixel(value: float) -> NDArray[np.float64]:
    return np.full((1, 1, 3), value)


def p_value_of(mean: float, low: float, high: float, most: float) -> float:
    means = np.stack([pixel(mean)] * 2)
    return compare_light_paths(pixel(low), pixel(high), means, PATHS, pixel(most)).test.smallest_p_value


def test_a_mean_within_its_interval_has_a_p_value_of_one() -> None:
    outcome = compare_light_paths(pixel(0.2), pixel(0.4), np.stack([pixel(0.1), pixel(0.5)]), PATHS, pixel(9.0))
    assert outcome.passes
    assert (outcome.p_values == 1).all()
    assert outcome.test.model_dump() == {
        "samples": PATHS,
        "batches": 2,
        "significance": SIGNIFICANCE,
        "smallest_p_value": 1.0,
    }
    # 2·0.2²/(2 - 1)/2, by fewer than 16 operations of float64.
    np.testing.assert_allclose(outcome.variance, 0.04, rtol=16 * 2.0**-53)


@pytest.mark.parametrize(("mean", "end"), [(0.6, 0.5 * (1 + LARGEST_ROUNDING)), (0.3, 0.4 * (1 - LARGEST_ROUNDING))])
def test_outside_the_nearer_end_counts_with_hoeffdings_formula_in_units_of_the_largest_splat(
    mean: float, end: float
) -> None:
    most = 50.0
    x, mu = mean / most, end / most
    divergence = x * math.log(x / mu) + (1 - x) * math.log((1 - x) / (1 - mu))
    expected = TESTS * 2 * math.exp(-PATHS * divergence)
    assert expected < 1
    assert math.isclose(p_value_of(mean, 0.4, 0.5, most), expected, rel_tol=1e-9)  # 10^4·KL of numbers of 1e-16


def test_rounding_is_allowed_for() -> None:
    many = 10**15
    for factor, passes in ((1 + LARGEST_ROUNDING / 2, True), (1 + 2 * LARGEST_ROUNDING, False)):
        means = np.stack([pixel(0.5 * factor)] * 2)
        assert compare_light_paths(pixel(0.5), pixel(0.5), means, many, pixel(1.0)).passes == passes


@pytest.mark.parametrize("impossible", [-1e-6, math.inf, math.nan])
def test_what_no_sum_of_splats_can_be_fails_at_its_pixel_alone(impossible: float) -> None:
    right = np.full((2, 4, 4, 3), 0.5)
    right[1, 2, 1, 0] = impossible
    truth = np.full((4, 4, 3), 0.5)
    outcome = compare_light_paths(truth, truth, right, PATHS, 99 * truth)
    assert np.argwhere(outcome.p_values == 0).tolist() == [[2, 1, 0]]
    assert (outcome.p_values[outcome.p_values > 0] == 1).all()
    assert not outcome.passes


def test_light_where_no_path_can_arrive_fails_and_darkness_there_passes() -> None:
    assert p_value_of(0.0, 0.0, 0.0, 0.0) == 1
    assert p_value_of(1e-9, 0.0, 0.0, 0.0) == 0


def test_more_than_every_path_could_bring_fails() -> None:
    assert p_value_of(1.5, 0.5, 0.5, 1.0) < SIGNIFICANCE


def test_a_small_fault_everywhere_shows_in_the_blocks() -> None:
    # 4 paths in 10,000 reach a pixel: 2 % more are far within its own noise, but not within that of the image.
    rng = np.random.default_rng(1)
    truth, most, paths = np.full((64, 64, 3), 1e-4), np.full((64, 64, 3), 1.0), 10**6
    counts = rng.multinomial(paths, [1e-4] * 4096 + [1 - 0.4096])[:-1].reshape(64, 64, 1)
    means = np.stack([counts / paths * np.ones(3)] * 2)
    assert compare_light_paths(truth, truth, means, paths, most).passes
    assert not compare_light_paths(truth, truth, 1.02 * means, paths, most).passes
