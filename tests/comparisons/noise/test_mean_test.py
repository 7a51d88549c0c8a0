import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.noise import mean_test as stochastic
from raytruth.comparisons.noise.mean_test import SIGNIFICANCE, relative_entropy
from tests.comparisons.noise.lobe_images import directly_seen, draw_batch_means, interval_of, one_dielectric

pytestmark = pytest.mark.clause("VER-6")


def constant(value, height=4, width=5):
    return np.full((height, width, 3), float(value))


def compare_means(low, high, batch_means, samples, bound, lobes=None, is_random=True):
    """All pixels random, and no lobe to be biased, unless said otherwise."""
    shape = np.shape(low)[:2]
    return stochastic.compare_means(
        low, high, batch_means, samples, bound, lobes or directly_seen(low), np.broadcast_to(is_random, shape)
    )


def batches(*means):
    return np.stack(means).astype(np.float32)


def number_of_tests(height, width):
    """Blocks on all levels, counted one by one."""
    corners = 0
    size = 1
    while True:
        corners += len(range(0, height, size)) * len(range(0, width, size))
        if size >= max(height, width):
            return 3 * corners
        size *= 2


def test_a_mean_inside_its_interval_has_a_p_value_of_one():
    outcome = compare_means(constant(0.25), constant(0.5), batches(constant(0.25), constant(0.5)), 64, 1.0)
    assert outcome.passes
    assert outcome.test.model_dump() == {
        "samples": 64,
        "batches": 2,
        "significance": SIGNIFICANCE,
        "smallest_p_value": 1.0,
    }
    np.testing.assert_array_equal(outcome.p_values, 1.0)


@pytest.mark.parametrize(("value", "end"), [(0.75, 0.5), (0.125, 0.25)])
def test_outside_the_nearer_end_counts_with_the_stated_formula(value, end):
    outcome = compare_means([[[0.25] * 3]], [[[0.5] * 3]], np.full((2, 1, 1, 3), value), 100, 1.0)
    divergence = value * math.log(value / end) + (1 - value) * math.log((1 - value) / (1 - end))
    expected = 2 * 3 * 2 * math.exp(-100 * divergence)  # one pixel is one test a channel, of half the significance
    assert math.isclose(outcome.test.smallest_p_value, expected, rel_tol=1e-12)  # a few roundings, times 100·KL


@given(st.integers(1, 9), st.integers(1, 9), st.integers(0, 8), st.integers(0, 8))
def test_a_single_wrong_pixel_is_corrected_for_every_block_on_every_level(height, width, row, column):
    row, column = row % height, column % width
    truth = constant(0.5, height, width)
    mean = truth.copy()
    mean[row, column, 1] = 0.875
    outcome = compare_means(truth, truth, batches(mean, mean), 128, 1.0)
    alone = 2 * math.exp(-128 * (0.875 * math.log(0.875 / 0.5) + 0.125 * math.log(0.125 / 0.5)))
    assert math.isclose(outcome.p_values[row, column, 1], 2 * number_of_tests(height, width) * alone, rel_tol=1e-10)
    assert np.unravel_index(outcome.p_values.argmin(), truth.shape) == (row, column, 1)
    assert not outcome.passes


def test_a_bias_too_small_for_any_pixel_shows_in_the_mean_of_the_image():
    truth = constant(0.5, 33, 31)
    biased = truth + 0.02
    one = compare_means(truth[:1, :1], truth[:1, :1], batches(biased[:1, :1], biased[:1, :1]), 64, 1.0)
    assert one.passes
    whole = compare_means(truth, truth, batches(biased, biased), 64, 1.0)
    assert not whole.passes
    assert np.all(whole.p_values < SIGNIFICANCE)  # the block that failed is the whole image


@pytest.mark.parametrize("wrong", [-1e-6, 1.0001, np.nan, np.inf, -np.inf])
def test_an_impossible_mean_fails_outright_at_its_own_pixel(wrong):
    mean = constant(0.5)
    mean[2, 3, 1] = wrong
    outcome = compare_means(constant(0), constant(1), batches(mean, constant(0.5)), 16, 1.0)
    assert not outcome.passes
    assert outcome.test.smallest_p_value == 0
    assert np.argwhere(outcome.p_values < 1).tolist() == [[2, 3, 1]]


def test_opposite_infinities_fail_like_any_impossible_mean():
    outcome = compare_means(constant(0), constant(1), batches(constant(np.inf), constant(-np.inf)), 16, 1.0)
    assert outcome.test.smallest_p_value == 0


def test_where_the_truth_is_black_no_light_at_all_is_allowed():
    black = constant(0)
    assert compare_means(black, black, batches(black, black), 16, 1.0).passes
    glow = black.copy()
    glow[0, 0, 0] = 1e-6
    assert compare_means(black, black, batches(black, glow), 16, 1.0).test.smallest_p_value == 0


def test_where_the_truth_is_the_bound_no_darker_sample_is_allowed():
    white = constant(2)
    assert compare_means(white, white, batches(white, white), 16, 2.0).passes
    assert compare_means(white, white, batches(white, white - 1e-3), 16, 2.0).test.smallest_p_value == 0


def test_the_unit_of_radiance_does_not_matter():
    rng = np.random.default_rng(3)
    truth, means = rng.random((7, 6, 3)), rng.random((4, 7, 6, 3))
    outcomes = [compare_means(unit * truth, unit * truth, unit * means, 8, unit) for unit in (1.0, 1024.0)]
    np.testing.assert_array_equal(outcomes[0].p_values, outcomes[1].p_values)


def test_the_variance_is_that_of_the_mean_of_the_batches():
    outcome = compare_means(constant(0), constant(1), batches(constant(0.25), constant(0.75), constant(0.5)), 12, 1.0)
    np.testing.assert_array_equal(outcome.variance, 0.0625 / 3)  # sample variance 1/16 of three batches


def test_where_nothing_is_random_every_batch_lies_in_the_interval_however_small_the_error():
    low, high = constant(0.25), constant(0.25 + 2**-20)
    is_random = np.ones((4, 5), dtype=bool)
    is_random[1, 2] = False
    assert compare_means(low, high, batches(low, high), 16, 1.0, is_random=is_random).passes
    for error in (-(2**-20), 2**-19):
        wrong = constant(0.25)
        wrong[1, 2, 0] += error
        assert compare_means(low, high, batches(low, wrong), 16, 1.0).passes
        outcome = compare_means(low, high, batches(low, wrong), 16, 1.0, is_random=is_random)
        assert np.argwhere(outcome.p_values == 0).tolist() == [[1, 2, 0]]


def test_pixels_that_are_not_random_do_not_dilute_the_blocks_of_those_that_are():
    truth = constant(0.5, 8, 8)
    biased = truth.copy()
    biased[:, 0] += 0.0625
    is_random = np.zeros((8, 8), dtype=bool)
    is_random[:, 0] = True
    outcome = compare_means(truth, truth, batches(biased, biased), 256, 1.0, is_random=is_random)
    alone = compare_means(truth[:, :1], truth[:, :1], batches(biased[:, :1], biased[:, :1]), 256, 1.0)
    # Both hold 8, 4, 2 and 1 blocks with random pixels in a channel.
    np.testing.assert_allclose(outcome.p_values[:, :1], alone.p_values, rtol=1e-9)
    assert not outcome.passes


def test_an_image_without_a_random_pixel_passes_if_it_is_exact():
    truth = constant(0.5)
    assert compare_means(truth, truth, batches(truth, truth), 16, 1.0, is_random=False).passes


def test_a_bias_of_one_lobe_fails_all_pixels_that_have_lobes_and_no_others():
    rng = np.random.default_rng(7)
    reflectance = np.full((16, 16), 0.5)
    reflected = 0.75 + 0.25 * (-1.0) ** np.add.outer(np.arange(16), np.arange(16))  # no block sees the bias
    lobes = one_dielectric(reflectance, reflected, 0.75)
    wrong = one_dielectric(1.05 * reflectance, reflected, 0.75)
    means = draw_batch_means(wrong, rng, 32, 64)
    outcome = compare_means(*interval_of(lobes), means, 32 * 64, 1.0, lobes)
    assert np.all(outcome.p_values < SIGNIFICANCE)
    unaware = compare_means(*interval_of(lobes), means, 32 * 64, 1.0)
    assert unaware.passes


@given(st.fractions(0, 1), st.fractions(0, 1))
def test_relative_entropy_obeys_pinsker_and_vanishes_only_at_equality(x, mu):
    divergence = relative_entropy(np.array([float(x)]), np.array([float(mu)]))[0]
    rounding = 8 * np.finfo(float).eps
    assert divergence + rounding >= 2 * float(abs(Fraction(x) - Fraction(mu))) ** 2
    assert relative_entropy(np.array([float(x)]), np.array([float(x)]))[0] <= rounding


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"low": constant(0.5, 3, 3)}, "one shape"),
        ({"batch_means": np.zeros((1, 4, 5, 3))}, "2 batches"),
        ({"samples": 1}, "2 batches"),
        ({"low": constant(0.75)}, "low <= high"),
        ({"low": constant(-0.5)}, "0 <= low"),
        ({"bound": 0.25}, "high <= bound"),
        ({"bound": np.inf}, "finite bound"),
        ({"high": constant(np.nan)}, "low <= high"),
    ],
)
def test_arguments_that_make_no_test_are_refused(change, message):
    valid = {
        "low": constant(0.25),
        "high": constant(0.5),
        "batch_means": np.zeros((2, 4, 5, 3)),
        "samples": 2,
        "bound": 1.0,
    }
    with pytest.raises(ValueError, match=message):
        compare_means(**{**valid, **change})
