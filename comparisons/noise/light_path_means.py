"""The test of a renderer that traces light forward: could its noisy image come from the truth's area means?

A light path ends on one pixel or on none, and adds to it no more than the pixel's largest splat. So over any block of
pixels the sum of a path's splats, each in units of its pixel's largest, lies in [0, 1]; and these sums are independent
and of one distribution for all paths. Their mean is tested as in mean_test.py, on pixels and on blocks of them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from raytruth.comparisons.noise.mean_test import SIGNIFICANCE, StochasticOutcome, mean_p_values
from raytruth.comparisons.noise.pixel_blocks import block_sizes, block_sums, spread
from raytruth.comparisons.records.results import StochasticTest

Array = NDArray[np.float64]

# Splats are computed and added up in float32: n of them are off by n·2^-24 of their sum at most (Higham, "Accuracy and
# Stability of Numerical Algorithms", 2002, section 4.2). Up to 4,095 a batch and pixel, with one more for their own.
LARGEST_ROUNDING = 2.0**-12


def compare_light_paths(
    low: ArrayLike, high: ArrayLike, batch_means: ArrayLike, paths: int, largest_splats: ArrayLike
) -> StochasticOutcome:
    """Test the mean of all batches against the interval [low, high] of its expectation.

    `low`, `high` and `largest_splats`, what one path adds to the sum of a pixel at most, have shape (height, width, 3);
    `batch_means` has shape (batches, height, width, 3), at least 2 batches, and `paths` counts the light paths of all
    of them. Bonferroni's correction counts all tests in all channels. What is negative, not finite, or not 0 where no
    path can arrive, fails outright.
    """
    means = np.asarray(batch_means, dtype=np.float64)
    most = np.asarray(largest_splats, dtype=np.float64)
    can_arrive = most > 0
    scale = np.where(can_arrive, most, 1.0)
    is_possible = np.all(np.isfinite(means) & (means >= 0) & (can_arrive | (means == 0)), axis=0)
    mean = np.where(is_possible, means.mean(axis=0), low)
    # The least and the largest expectation in units of a path's splats.
    least, largest = np.asarray(low) * (1 - LARGEST_ROUNDING), np.asarray(high) * (1 + LARGEST_ROUNDING)
    floor, share, ceiling = (np.where(can_arrive, image / scale, 0.0) for image in (least, mean, largest))
    p_values = np.ones_like(mean)
    tests = 0
    for size in block_sizes(*mean.shape[:2]):
        least_sum, largest_sum = (np.minimum(block_sums(image, size), 1.0) for image in (floor, ceiling))
        of_blocks = mean_p_values(block_sums(share, size), least_sum, largest_sum, np.array(paths))
        p_values = np.minimum(p_values, spread(of_blocks, size, mean.shape))
        tests += of_blocks.size
    p_values = np.where(is_possible, np.minimum(tests * p_values, 1.0), 0.0)
    smallest = float(p_values.min())
    test = StochasticTest(samples=paths, batches=len(means), significance=SIGNIFICANCE, smallest_p_value=smallest)
    with np.errstate(invalid="ignore"):  # infinite means have no variance
        variance = means.var(axis=0, ddof=1) / len(means)
    return StochasticOutcome(test, smallest > SIGNIFICANCE, p_values, variance)
