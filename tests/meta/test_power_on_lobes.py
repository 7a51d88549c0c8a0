"""A bias of one percent in one lobe is seen at the numbers of samples that the adapter draws, in every glass scene.

The renderers are simulated: a sample is one path of the pixel's ray tree, with that path's probability. That Mitsuba
draws from the same distribution is tested here, too.
"""

import numpy as np
import pytest
from scipy.stats import ks_2samp

from raytruth.comparisons.noise.mean_test import SIGNIFICANCE, compare_means
from raytruth.comparisons.records.renderings import Rays
from raytruth.comparisons.renderers.mitsuba.adapter import BATCH_SAMPLES, BATCHES, mitsuba_scalar
from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.library import open_scene
from tests.comparisons.noise.lobe_images import draw_batch_means, truth_of
from tests.meta.lobe_biases import BIASES, GLASS_SCENES, bound_of, lobes_of

pytestmark = pytest.mark.clause("VER-7")

# A float32 tracer of these scenes is some ten roundings of 2^-24 off, away from edges; 2^-18 has room for 64.
HALF_WIDTH = 2.0**-18


def smallest_p_value(name, lobes, variant, rng):
    """Of a renderer that draws from `lobes`, as many samples as the adapter draws with this variant."""
    right, bound, samples = lobes_of(name), bound_of(name), BATCH_SAMPLES[variant]
    low, high = (np.clip(truth_of(right) + side * HALF_WIDTH, 0.0, bound) for side in (-1, 1))
    means = draw_batch_means(lobes, rng, BATCHES, samples)
    outcome = compare_means(low, high, means, BATCHES * samples, bound, right, ~right.sees_directly())
    return outcome.test.smallest_p_value


@pytest.mark.parametrize("name", GLASS_SCENES)
@pytest.mark.parametrize("bias", [0.01, -0.01])
@pytest.mark.parametrize("lobe", ["reflections", "transmissions"])
def test_a_bias_of_one_percent_in_what_a_lobe_brings_is_seen_with_the_fewest_samples(name, bias, lobe):
    rng = np.random.default_rng(1)
    assert smallest_p_value(name, BIASES[lobe](lobes_of(name), bias), "scalar_rgb", rng) < SIGNIFICANCE


@pytest.mark.parametrize("name", GLASS_SCENES)
@pytest.mark.parametrize("bias", [0.01, -0.01])
def test_a_bias_of_one_percent_in_the_choice_of_the_lobe_is_seen_with_the_most_samples(name, bias):
    rng = np.random.default_rng(1)
    assert smallest_p_value(name, BIASES["choice"](lobes_of(name), bias), "llvm_ad_rgb", rng) < SIGNIFICANCE


@pytest.mark.parametrize("name", GLASS_SCENES)
@pytest.mark.parametrize("variant", BATCH_SAMPLES)
def test_a_right_renderer_passes(name, variant):
    assert smallest_p_value(name, lobes_of(name), variant, np.random.default_rng(1)) > SIGNIFICANCE


def test_mitsuba_draws_from_the_simulated_distribution(tmp_path):
    name = "glass-slab"
    scene, lobes = open_scene(name), lobes_of(name)
    rendering = mitsuba_scalar().render(scene, "path", scene.max_depth, Rays(*primary_rays(scene)), tmp_path)
    measured = rendering.batch_means.reshape(BATCHES, -1, 3)
    batch_samples = rendering.samples // BATCHES
    simulated = draw_batch_means(lobes, np.random.default_rng(1), BATCHES, batch_samples).reshape(BATCHES, -1, 3)
    mean = lobes.expectation(lobes.value)
    deviation = np.sqrt(np.maximum(lobes.expectation(lobes.value**2) - mean**2, 0.0) / batch_samples)
    random = deviation > 1e-3  # so that float32's roundings are small against the noise
    assert random.sum() > 2000
    # In units of each pixel's deviation, so that all of them make one sample of skewed distributions; values that a
    # rounding tells apart are made equal.
    sets = [np.round((means - mean)[:, random] / deviation[random], 2).ravel() for means in (measured, simulated)]
    assert abs(np.std(sets[0]) - 1) < 0.01
    assert ks_2samp(*sets).pvalue > 1e-3
