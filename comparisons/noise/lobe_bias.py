"""A test for small biases of one lobe: is reflected or refracted light too strong, or drawn too often, by a little?

Such a bias is far below the noise of any pixel, and over an image its sign changes with what the lobes happen to show,
so that means over blocks cancel it. But the ray tree tells which way and how much each pixel would move: a test that
looks that way alone sees it.

It is a test by betting (Waudby-Smith, Ramdas 2024, "Estimating means of bounded random variables by betting", section
4): whoever bets against the null hypothesis, with stakes fixed beforehand, can expect no gain under it, whatever the
distribution of the samples. What the tree says about that distribution decides how much is staked, so that it matters
for the power of the test and not for its validity.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from raytruth.comparisons.noise.lobes import Lobes

    Array = NDArray[np.float64]

# The test aims at a bias of 1 % and looks at sizes around it. A bet on a size s against a true size t gains in
# proportion to 2st − s², so that between sizes in steps of 4 the best bet gains 64 % of the most possible, t², or more.
BIAS_SIZES = tuple(sign * 0.01 * 4.0**step for step in (-1, 0, 1, 2) for sign in (1, -1))

# What is staked of the capital at most on one batch of one pixel: all of it could be lost, and three quarters are the
# most that Waudby-Smith and Ramdas advise (section 4.3, their c).
LARGEST_STAKE = 0.75


def lobe_bias_p_value(
    low: Array, high: Array, batch_means: Array, batch_samples: float, bound: float, lobes: Lobes
) -> float:
    """At most the probability that right batch means look as much like a bias of one lobe as these do.

    `low`, `high`, `batch_means` and `bound` are those of `compare_means`, each mean that of `batch_samples` samples and
    from 0 to `bound`. The mean of e-values is an e-value (Vovk, Wang 2021, "E-values: Calibration, combination and
    applications", section 3), and by Markov's inequality its inverse bounds the probability.
    """
    ends = low.reshape(-1, 3), high.reshape(-1, 3)
    means = batch_means.reshape(len(batch_means), -1, 3)
    logarithms = [
        _log_capital(*ends, means, batch_samples, bound, lobes, alternative) for alternative in biased_images(lobes)
    ]
    log_e_value = np.logaddexp.reduce(logarithms) - np.log(len(logarithms))
    return float(np.exp(-max(log_e_value, 0.0)))


def biased_images(lobes: Lobes) -> Iterator[Array]:
    """What the pixels' expectations are, to first order, where a lobe has a bias; shape (pixels, 3).

    The biases: all light that dielectrics reflect is scaled, or all that they transmit, or Fresnel's R in the choice of
    the lobe.
    """
    truth = lobes.expectation(lobes.value)
    for derivative in (lobes.reflections, lobes.transmissions, lobes.split_score):
        change = lobes.expectation(lobes.value * derivative[:, np.newaxis])
        for size in BIAS_SIZES:
            yield truth + size * change


def _log_capital(
    low: Array, high: Array, means: Array, batch_samples: float, bound: float, lobes: Lobes, alternative: Array
) -> float:
    """The logarithm of an e-value: what 1 becomes that is staked on the alternative at every pixel and batch.

    The stakes are on Y = δ·X, with δ the way to the alternative from the nearest image that the null hypothesis allows,
    and X a batch mean. Under the null hypothesis E[Y] is at most y, its value at that nearest image; so no factor
    1 + λ(Y − y) with λ ≥ 0 has an expectation above 1, nor has the product of independent ones.
    """
    nearest = np.clip(alternative, low, high)
    way = alternative - nearest
    gain = (way**2).sum(axis=1)  # what Y − y is expected to be under the alternative
    along_way = (lobes.value * way[lobes.pixel]).sum(axis=1)
    variance = (lobes.expectation(along_way**2) - lobes.expectation(along_way) ** 2) / batch_samples
    # The most that y − Y can be: with black where δ is positive, with the bound where it is negative.
    loss = (way * np.where(way > 0, nearest, nearest - bound)).sum(axis=1)
    # The limit to a stake that can lose next to nothing may be infinite.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        # Kelly's rule to second order: this λ maximises the expectation of λ(Y − y) − λ²(Y − y)²/2. Rounding may leave
        # a variance just below 0.
        rate = np.minimum(gain / (np.maximum(variance, 0.0) + gain**2), LARGEST_STAKE / loss)
    gains = np.einsum("bpc,pc->bp", means, way) - (way * nearest).sum(axis=1)
    # Nothing on ways whose squares are subnormal: rounding could then lose more than the stake.
    return float(np.log1p(np.where(gain >= np.finfo(np.float64).tiny, rate, 0.0) * gains).sum())
