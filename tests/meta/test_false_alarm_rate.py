"""The statistical test raises no more false alarms than it states, and is not so careful that it sees nothing."""

import numpy as np
import pytest
from hypothesis import settings
from scipy.stats import binomtest

from raytruth.comparisons.noise.light_path_means import compare_light_paths
from raytruth.comparisons.noise.mean_test import SIGNIFICANCE, compare_means
from tests.comparisons.noise.lobe_images import draw_batch_means, interval_of, one_dielectric
from tests.meta.lobe_biases import GLASS_SCENES, bound_of, lobes_of

pytestmark = pytest.mark.clause("VER-6")

# Of 16x16 pixels, which keep what the distributions are like and take 10 ms each: more than 2,000 in all, and 20,000 in
# the deep profile.
IMAGES_A_SCENE = 300 if settings().max_examples <= 100 else 3000
SIDE = 16


def outcome_of(lobes, means, samples, bound):
    """The test of batch means of an image of which `lobes` are the truth."""
    return compare_means(*interval_of(lobes), means, samples, bound, lobes, ~lobes.sees_directly())


def assert_no_more_alarms_than_stated(p_values):
    for significance in (SIGNIFICANCE, 0.01, 0.05, 0.5):
        alarms = int(np.count_nonzero(np.array(p_values) <= significance))
        # Clopper and Pearson's interval for the rate: below its lower end, more alarms than stated would be proved.
        assert binomtest(alarms, len(p_values)).proportion_ci(0.99, "exact").low <= significance


def skewed_image(rng, shape=(9, 7)):
    """Rare bright lobes beside dark ones, evenly mixed lobes, and pixels that hardly vary."""
    kind = rng.integers(3, size=shape)
    probability = np.choose(kind, [10 ** rng.uniform(-4, -1, shape), rng.uniform(0.1, 0.9, shape), 1 - 1e-3])
    dark = np.choose(kind, [np.zeros(shape), rng.uniform(0, 0.5, shape), np.zeros(shape)])
    return one_dielectric(probability, 1.0, dark)


@pytest.mark.parametrize("samples", [4, 256])
def test_right_renderers_of_made_up_images_fail_no_more_often_than_stated(samples):
    rng = np.random.default_rng(samples)
    p_values = []
    for _ in range(2000):
        lobes = skewed_image(rng)
        means = draw_batch_means(lobes, rng, 4, samples // 4)
        p_values.append(outcome_of(lobes, means, samples, 1 + 2.0**-23).test.smallest_p_value)
    assert_no_more_alarms_than_stated(p_values)


@pytest.mark.simulation
def test_right_renderers_of_the_glass_scenes_fail_no_more_often_than_stated():
    rng = np.random.default_rng(3)
    p_values = []
    for name in GLASS_SCENES:
        lobes, bound = lobes_of(name, SIDE), bound_of(name)
        for _ in range(IMAGES_A_SCENE):
            means = draw_batch_means(lobes, rng, 32, 8)
            p_values.append(outcome_of(lobes, means, 256, bound).test.smallest_p_value)
    assert len(p_values) >= 2000
    assert_no_more_alarms_than_stated(p_values)


def test_right_renderers_with_another_way_of_sampling_fail_no_more_often_than_stated():
    # Both lobes with probability 1/2, and weights 2R and 2(1 − R): the same expectation, but not the distribution from
    # which the stakes of the bets follow. Samples lie below twice the radiance then.
    rng = np.random.default_rng(4)
    p_values = []
    for _ in range(2000):
        reflectance = rng.uniform(0.02, 0.98, (9, 7))
        lobes = one_dielectric(reflectance, 1.0, 0.5)
        half = one_dielectric(np.full((9, 7), 0.5), 2 * reflectance, 1 - reflectance)
        p_values.append(outcome_of(lobes, draw_batch_means(half, rng, 32, 8), 256, 2.0).test.smallest_p_value)
    assert_no_more_alarms_than_stated(p_values)


def draw_light_paths(rng, chances, parts, most, paths):
    """An image to which each path adds a part of the pixel's largest splat; `chances` and `parts`: (kinds, h, w)."""
    left = 1 - chances.sum()
    counts = rng.multinomial(paths, np.append(chances.ravel(), left))[:-1].reshape(chances.shape)
    return (counts * parts).sum(axis=0) * most / paths


@pytest.mark.parametrize("paths", [2_000, 1_000_000])
def test_right_renderers_that_trace_light_forward_fail_no_more_often_than_stated(paths):
    # Splats of the largest size and rare ones of it beside small ones: from pixels that one path in 10^6 reaches to
    # pixels that one in 100 does.
    rng = np.random.default_rng(paths)
    p_values = []
    for _ in range(2000):
        shape = (9, 7)
        chances = np.stack([10 ** rng.uniform(-6, -2, shape), 10 ** rng.uniform(-4, -2.5, shape)])
        parts = np.stack([np.ones(shape), rng.uniform(0.01, 1, shape)])
        most = 10 ** rng.uniform(-2, 2, shape)
        truth = (chances * parts).sum(axis=0) * most
        halves = [draw_light_paths(rng, chances, parts, most, paths // 2) for _ in range(2)]
        images = [np.repeat(image[..., np.newaxis], 3, axis=2) for image in (truth, most, *halves)]
        outcome = compare_light_paths(images[0], images[0], np.stack(images[2:]), paths, images[1])
        p_values.append(outcome.test.smallest_p_value)
    assert_no_more_alarms_than_stated(p_values)


def test_the_bound_is_nearly_reached_where_everything_hangs_on_one_sample():
    # One pixel, one rare lobe of probability 1e-4 and two samples: an alarm needs a bright sample.
    rng = np.random.default_rng(5)
    lobes = one_dielectric([[1e-4]], 1.0, 0.0)
    runs = rng.binomial(2, 1e-4, 200_000)
    bright = np.full((2, 1, 1, 3), 0.5)
    p_value = outcome_of(lobes, bright, 2, 1.0).test.smallest_p_value / (2 * 3)  # without correction
    rate = np.count_nonzero(runs) / len(runs)
    assert rate <= p_value <= 10 * rate


@pytest.mark.clause("VER-7")
@pytest.mark.parametrize(("probability", "samples"), [(0.9, 1024), (0.5, 8192)])
def test_a_single_pixel_that_is_wrong_by_ten_percent_is_detected(probability, samples):
    # Fewer samples than these cannot show it: with probability 0.5 the noise of 256 samples is 6 % of the mean, and
    # one pixel among 16,384 tests has to stand out by more than five times that.
    rng = np.random.default_rng(2)
    right = np.full((64, 64), probability)
    wrong = right.copy()
    wrong[20, 40] *= 0.9
    truth = one_dielectric(right, 1.0, 0.0)
    for _ in range(10):
        means = draw_batch_means(one_dielectric(wrong, 1.0, 0.0), rng, 4, samples // 4)
        outcome = outcome_of(truth, means, samples, 1.0)
        assert not outcome.passes
        assert np.unravel_index(outcome.p_values.argmin(), (64, 64, 3))[:2] == (20, 40)
