"""The test of a renderer with random numbers: could its noisy mean come from the truth?

Null hypothesis: at every pixel and channel the expectation lies in a given interval. Nothing is assumed about the
distribution of the samples but its range, so heavy tails and rare bright lobes raise no false alarm. Samples must be
independent, also between pixels. Three tests share the significance: pixels that are not random must lie in their
interval, pixels and blocks of pixels are tested on their mean, and lobe_bias.py looks for small biases of one lobe.

Why not a test on the variance: an estimate from a few batches misses rare lobes altogether, and a normal law for the
mean then alarms far too often; bounds that hold with an estimated variance (Maurer, Pontil 2009, theorem 4) need
more batches than one would render. The variance is reported, not tested.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from raytruth.comparisons.noise.lobe_bias import lobe_bias_p_value
from raytruth.comparisons.noise.pixel_blocks import block_sizes, block_sums, spread
from raytruth.comparisons.records.results import StochasticTest

if TYPE_CHECKING:
    from raytruth.comparisons.noise.lobes import Lobes

SIGNIFICANCE = 1e-3
"""A right renderer fails one cell in a thousand at most: with twenty noisy cells, less than one run in fifty."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class StochasticOutcome:
    """The outcome of a test of means: whether all are possible, and the probabilities that it comes from."""

    test: StochasticTest
    passes: bool
    p_values: Array
    """Shape (height, width, 3): the smallest of all tests that the pixel takes part in, after correction."""
    variance: Array
    """Shape (height, width, 3): of the mean over all samples, estimated from the batch means."""


def compare_means(
    low: ArrayLike,
    high: ArrayLike,
    batch_means: ArrayLike,
    samples: int,
    bound: float,
    lobes: Lobes,
    is_random: NDArray[np.bool_],
) -> StochasticOutcome:
    """Test the mean of all batches against the interval [low, high] of its expectation.

    `low` and `high` have shape (height, width, 3): the truth, widened by what the renderer's arithmetic may do.
    `batch_means` has shape (batches, height, width, 3), at least 2 batches of equally many samples; `samples` counts
    those of a pixel in all batches. `bound` is above every single sample that a right renderer can draw, in the same
    unit, rounding included, and not below `high`; samples are never negative. `lobes` are those of the scene, and
    `is_random`, of shape (height, width), says where a right renderer's samples may differ from one another.

    Random pixels, and blocks of them of 2x2, 4x4, … up to the whole image, are tested each on their mean, and
    Bonferroni's correction counts all these tests in all channels; the test for biased lobes counts as much as all of
    them together. A batch mean that is negative, above `bound` or not finite fails outright, and so does one outside
    [low, high] where nothing is random. Raises ValueError for arguments outside these ranges.
    """
    lowest, highest, means = (np.asarray(array, dtype=np.float64) for array in (low, high, batch_means))
    _check(lowest, highest, means, samples, bound)
    least = np.where(is_random[..., np.newaxis], 0.0, lowest)
    most = np.where(is_random[..., np.newaxis], bound, highest)
    is_possible = np.all((means >= least) & (means <= most), axis=0)  # False for NaN
    # An impossible mean has p = 0 at its own pixel; it must not make the means of its blocks undefined.
    possible_means = np.where(is_possible, means, lowest)
    of_blocks = _block_p_values(lowest, highest, possible_means.mean(axis=0), samples, bound, is_random)
    of_lobes = lobe_bias_p_value(lowest, highest, possible_means, samples / len(means), bound, lobes)
    # Every pixel that looks through a dielectric or at a mirror has its part in the latter.
    p_values = np.minimum(of_blocks, np.where(lobes.sees_directly(), 1.0, of_lobes)[..., np.newaxis])
    p_values = np.where(is_possible, np.minimum(2 * p_values, 1.0), 0.0)
    smallest = float(p_values.min())
    with np.errstate(invalid="ignore"):  # infinite means have no variance
        variance = means.var(axis=0, ddof=1) / len(means)
    test = StochasticTest(samples=samples, batches=len(means), significance=SIGNIFICANCE, smallest_p_value=smallest)
    return StochasticOutcome(test, smallest > SIGNIFICANCE, p_values, variance)


def _block_p_values(
    low: Array, high: Array, mean: Array, samples: int, bound: float, is_random: NDArray[np.bool_]
) -> Array:
    """The smallest p-value of all blocks that a pixel is in, times the number of tests; may exceed 1."""
    weight = np.where(is_random, 1.0, 0.0)[..., np.newaxis] + np.zeros_like(mean)
    p_values = np.ones_like(mean)
    tests = 0
    for size in block_sizes(*mean.shape[:2]):
        pixels = block_sums(weight, size)
        x, floor, ceiling = (
            block_sums(weight * image / bound, size) / np.maximum(pixels, 1) for image in (mean, low, high)
        )
        p_values = np.minimum(p_values, spread(mean_p_values(x, floor, ceiling, samples * pixels), size, mean.shape))
        tests += int(np.count_nonzero(pixels))
    return p_values * max(tests, 1)


def mean_p_values(mean: Array, low: Array, high: Array, count: Array) -> Array:
    """At most the probability of a mean this far outside [low, high]; all in units of the samples' bound.

    For the mean X of n independent variables in [0, 1] with expectation μ, P(X ≥ x) ≤ exp(−n·KL(x ‖ μ)) for x > μ, and
    likewise below (Hoeffding 1963, "Probability Inequalities for Sums of Bounded Random Variables", theorem 1,
    eq. 2.1). They need not have the same distribution, so that it holds for a block of pixels, too. It decreases away
    from μ: the nearer end of the interval is the worst case. The factor 2 pays for looking at both sides.
    """
    nearest = np.clip(mean, low, high)
    return np.minimum(1.0, 2.0 * np.exp(-count * relative_entropy(mean, nearest)))


def relative_entropy(x: Array, mu: Array) -> Array:
    """KL(x ‖ μ) = x·ln(x/μ) + (1−x)·ln((1−x)/(1−μ)) of two Bernoulli laws, x and μ in [0, 1]; infinite if x > μ = 0."""
    return np.maximum(_entropy_term(x, mu) + _entropy_term(1 - x, 1 - mu), 0.0)  # rounding may leave -1e-17


def _entropy_term(x: Array, mu: Array) -> Array:
    """x·ln(x/μ), which tends to 0 with x."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(x > 0, x * np.log(x / mu), 0.0)


def _check(low: Array, high: Array, batch_means: Array, samples: int, bound: float) -> None:
    shape = low.shape
    if low.ndim != 3 or high.shape != shape or batch_means.shape[1:] != shape or low.size == 0:
        raise ValueError(f"expected images of one shape (h, w, 3), got {shape}, {high.shape}, {batch_means.shape[1:]}")
    if len(batch_means) < 2 or samples < len(batch_means):
        raise ValueError(f"expected 2 batches or more of 1 sample or more, got {len(batch_means)} of {samples} in all")
    if not (np.all(low >= 0) and np.all(low <= high) and np.all(high <= bound) and 0 < bound < np.inf):
        raise ValueError("expected 0 <= low <= high <= bound, with a finite bound above 0")
