"""The statistical test raises no more false alarms than it states, and is not so careful that it sees nothing."""

import numpy as np
import pytest
from scipy.stats import binomtest

from comparisons.stochastic import SIGNIFICANCE, compare_means

BATCHES = 4


class TwoLobes:
    """An image whose samples are, pixel by pixel, `bright` with a probability and `dark` otherwise."""

    def __init__(self, shape, probability, bright, dark):
        probability, bright, dark = np.broadcast_arrays(probability, bright, dark)
        self.probability, self.bright, self.dark = (
            np.broadcast_to(lobe[..., None], (*shape, 3)) for lobe in (probability, bright, dark)
        )

    def mean(self):
        return self.dark + self.probability * (self.bright - self.dark)

    def batch_means(self, rng, samples):
        counts = rng.binomial(samples // BATCHES, self.probability, (BATCHES, *self.probability.shape))
        return (self.dark + counts / (samples // BATCHES) * (self.bright - self.dark)).astype(np.float32)

    def interval(self):
        """The expectation, widened by one rounding of the batch means to float32 and three of float64 on the way."""
        roundoff = 2.0**-24 + 3 * 2.0**-53
        return self.mean() * (1 - roundoff), self.mean() * (1 + roundoff)


def skewed_image(rng, shape=(9, 7)):
    """Rare bright lobes beside dark ones, evenly mixed lobes, and pixels that hardly vary."""
    kind = rng.integers(3, size=shape)
    probability = np.choose(kind, [10 ** rng.uniform(-4, -1, shape), rng.uniform(0.1, 0.9, shape), 1 - 1e-3])
    dark = np.choose(kind, [np.zeros(shape), rng.uniform(0, 0.5, shape), np.zeros(shape)])
    return TwoLobes(shape, probability, 1.0, dark)


@pytest.mark.parametrize("samples", [4, 256])
def test_right_renderers_fail_no_more_often_than_stated(samples):
    rng = np.random.default_rng(samples)
    smallest = []
    for _ in range(2000):
        image = skewed_image(rng)
        outcome = compare_means(*image.interval(), image.batch_means(rng, samples), samples, bound=1 + 2.0**-23)
        smallest.append(outcome.test.smallest_p_value)
    for significance in (SIGNIFICANCE, 0.05, 0.5):
        alarms = int(np.count_nonzero(np.array(smallest) <= significance))
        # Clopper and Pearson's interval for the rate: below its lower end, more alarms than stated would be proved.
        assert binomtest(alarms, len(smallest)).proportion_ci(0.99, "exact").low <= significance


def test_the_bound_is_nearly_reached_where_everything_hangs_on_one_sample():
    # One pixel, one rare lobe of probability 1e-4 and two samples: an alarm needs a bright sample.
    rng = np.random.default_rng(5)
    image = TwoLobes((1, 1), 1e-4, 1.0, 0.0)
    runs = rng.binomial(2, image.probability[0, 0, 0], 200_000)
    bright = np.full((2, 1, 1, 3), 0.5)
    p_value = compare_means(*image.interval(), bright, 2, bound=1.0).test.smallest_p_value / 3  # without correction
    rate = np.count_nonzero(runs) / len(runs)
    assert rate <= p_value <= 10 * rate


def test_a_bias_of_one_percent_in_one_lobe_is_detected():
    rng = np.random.default_rng(1)
    shape, samples = (64, 64), 256
    probability = rng.uniform(0.3, 0.7, shape)
    truth = TwoLobes(shape, probability, 1.0, 0.1)
    for biased in (TwoLobes(shape, 1.01 * probability, 1.0, 0.1), TwoLobes(shape, probability, 0.99, 0.1)):
        for _ in range(20):
            assert not compare_means(*truth.interval(), biased.batch_means(rng, samples), samples, 1.1).passes
    assert compare_means(*truth.interval(), truth.batch_means(rng, samples), samples, 1.1).passes


@pytest.mark.parametrize(("probability", "samples"), [(0.9, 1024), (0.5, 8192)])
def test_a_single_pixel_that_is_wrong_by_ten_percent_is_detected(probability, samples):
    # Fewer samples than these cannot show it: with probability 0.5 the noise of 256 samples is 6 % of the mean, and
    # one pixel among 16,384 tests has to stand out by more than five times that.
    rng = np.random.default_rng(2)
    shape = (64, 64)
    truth = TwoLobes(shape, probability, 1.0, 0.0)
    wrong = np.full(shape, probability)
    wrong[20, 40] *= 0.9
    for _ in range(10):
        means = TwoLobes(shape, wrong, 1.0, 0.0).batch_means(rng, samples)
        outcome = compare_means(*truth.interval(), means, samples, 1.0)
        assert not outcome.passes
        assert np.unravel_index(outcome.p_values.argmin(), (*shape, 3))[:2] == (20, 40)
