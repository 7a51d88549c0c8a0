import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.noise import lobe_bias
from raytruth.comparisons.noise.lobe_bias import BIAS_SIZES, LARGEST_STAKE, biased_images, lobe_bias_p_value
from tests.comparisons.noise.lobe_images import directly_seen, draw_batch_means, interval_of, one_dielectric, truth_of

pytestmark = pytest.mark.clause("VER-6")

BATCHES, SAMPLES = 32, 16


def p_value(lobes, means, bound=1.0, interval=None):
    low, high = interval or interval_of(lobes)
    return lobe_bias_p_value(low, high, np.asarray(means, dtype=np.float64), SAMPLES, bound, lobes)


def test_biased_images_are_the_derivatives_of_the_expectation():
    reflectance, reflected, transmitted = 0.25, 0.5, 0.75
    truth = 0.25 * 0.5 + 0.75 * 0.75
    changes = [reflectance * reflected, (1 - reflectance) * transmitted, reflectance * (reflected - transmitted)]
    expected = [truth + size * change for change in changes for size in BIAS_SIZES]
    found = list(biased_images(one_dielectric([[reflectance]], reflected, transmitted)))
    np.testing.assert_allclose(np.array(found)[:, 0], np.repeat(expected, 3).reshape(-1, 3), rtol=1e-14)


def test_sizes_lie_around_one_percent_on_both_sides():
    assert {0.01, -0.01} <= set(BIAS_SIZES)
    assert sorted(BIAS_SIZES) == sorted(-size for size in BIAS_SIZES)


def test_where_no_lobe_can_be_biased_there_is_nothing_to_win():
    image = np.full((3, 4, 3), 0.5)
    assert p_value(directly_seen(image), np.zeros((BATCHES, 3, 4, 3))) == pytest.approx(1.0)


def test_an_interval_that_holds_all_biases_leaves_nothing_to_win():
    lobes = one_dielectric(np.full((3, 4), 0.5), 0.75, 0.25)
    everything = np.zeros((3, 4, 3)), np.ones((3, 4, 3))
    assert p_value(lobes, np.ones((BATCHES, 3, 4, 3)), interval=everything) == pytest.approx(1.0)


def e_value(lobes, means, interval):
    """The mean over all bets, not cut off at 1 as the p-value is."""
    ends = interval[0].reshape(-1, 3), interval[1].reshape(-1, 3)
    logarithms = [
        lobe_bias._log_capital(*ends, means.reshape(len(means), -1, 3), SAMPLES, 1.0, lobes, image)
        for image in biased_images(lobes)
    ]
    return float(np.mean(np.exp(logarithms)))


@given(st.floats(0.01, 0.99), st.floats(0, 1), st.floats(0, 1), st.floats(0, 0.01), *[st.floats(0, 1)] * 3)
def test_no_bet_can_expect_to_gain(reflectance, reflected, transmitted, slack, where, below, above):
    """Whatever two colours a batch may have, if only their mean lies in the interval."""
    lobes = one_dielectric([[reflectance]], reflected, transmitted)
    truth = truth_of(lobes)
    interval = np.maximum(truth - slack, 0.0), np.minimum(truth + slack, 1.0)
    low, high = interval[0][0, 0, 0], interval[1][0, 0, 0]
    mean = low + where * (high - low)
    dark, bright = below * mean, mean + above * (1 - mean)
    chance = (mean - dark) / (bright - dark) if bright > dark else 0.5
    values = [e_value(lobes, np.full((1, 1, 1, 3), color), interval) for color in (dark, bright)]
    # Rounding of the colours, some 2^-52, is multiplied by λ·δ, which is below 1 over the mean's distance from 0.
    assert (1 - chance) * values[0] + chance * values[1] <= 1 + 1e-9


def test_no_batch_however_bad_takes_more_than_the_largest_stake():
    lobes = one_dielectric(np.full((1, 1), 0.5), 1.0, 0.0)
    for worst in (0.0, 1.0):
        value = e_value(lobes, np.full((1, 1, 1, 3), worst), interval_of(lobes))
        assert 1 - LARGEST_STAKE <= value < math.inf


@pytest.mark.clause("VER-7")
@pytest.mark.parametrize("bias", [0.02, -0.02])
def test_a_bias_in_lobes_of_alternating_contrast_is_seen(bias):
    rng = np.random.default_rng(11)
    checks = 0.5 + 0.375 * (-1.0) ** np.add.outer(np.arange(32), np.arange(32))
    right = one_dielectric(np.full((32, 32), 0.3), checks, 0.5)
    wrong = one_dielectric(np.full((32, 32), 0.3 * (1 + bias)), checks, 0.5)
    assert p_value(right, draw_batch_means(wrong, rng, BATCHES, SAMPLES)) < 1e-4
    assert p_value(right, draw_batch_means(right, rng, BATCHES, SAMPLES)) > 1e-4


def test_the_unit_of_radiance_does_not_matter():
    p_values = []
    for unit in (1.0, 1024.0):
        rng = np.random.default_rng(12)
        lobes = one_dielectric(np.full((8, 8), 0.3), 0.875 * unit, 0.25 * unit)
        wrong = one_dielectric(np.full((8, 8), 0.33), 0.875 * unit, 0.25 * unit)
        p_values.append(p_value(lobes, draw_batch_means(wrong, rng, BATCHES, SAMPLES), bound=unit))
    assert p_values[0] < 0.5
    assert math.isclose(*p_values, rel_tol=1e-9)
