"""Images of which every pixel's paths are given, and what a renderer draws from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.noise.lobes import Lobes

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]


def directly_seen(values: ArrayLike) -> Lobes:
    """One path a pixel, without a surface on the way; `values` has shape (height, width, 3)."""
    image = np.asarray(values, dtype=np.float64)
    pixels = image.shape[0] * image.shape[1]
    none = np.zeros(pixels, dtype=np.int64)
    return Lobes(
        (image.shape[0], image.shape[1]),
        np.arange(pixels),
        np.ones(pixels),
        image.reshape(pixels, 3),
        none,
        none,
        none,
        np.zeros(pixels),
    )


def one_dielectric(reflectance: ArrayLike, reflected: ArrayLike, transmitted: ArrayLike) -> Lobes:
    """A dielectric at every pixel; `reflectance` has shape (height, width), the grey values broadcast with it."""
    chance, bright, dark = (np.asarray(a, float) for a in np.broadcast_arrays(reflectance, reflected, transmitted))
    pixels = chance.size
    of_reflection, of_transmission = np.tile([1, 0], pixels), np.tile([0, 1], pixels)
    values = np.stack([bright.ravel(), dark.ravel()], axis=1).reshape(-1, 1)
    return Lobes(
        (chance.shape[0], chance.shape[1]),
        np.repeat(np.arange(pixels), 2),
        np.stack([chance.ravel(), 1 - chance.ravel()], axis=1).ravel(),
        np.repeat(values, 3, axis=1),
        np.zeros(2 * pixels, dtype=np.int64),
        of_reflection,
        of_transmission,
        np.stack([np.ones(pixels), -(chance / (1 - chance)).ravel()], axis=1).ravel(),
    )


def truth_of(lobes: Lobes) -> Array:
    """The expectation; shape (height, width, 3)."""
    return lobes.expectation(lobes.value).reshape(*lobes.shape, 3)


def interval_of(lobes: Lobes) -> tuple[Array, Array]:
    """The expectation, widened by one rounding of the batch means to float32 and some of float64 on the way."""
    roundoff = 2.0**-24 + 16 * 2.0**-53
    truth = truth_of(lobes)
    return truth * (1 - roundoff), truth * (1 + roundoff)


def draw_batch_means(lobes: Lobes, rng: np.random.Generator, batches: int, samples: int) -> NDArray[np.float32]:
    """Means of batches of so many samples each, every sample one of the pixel's paths; (batches, height, width, 3)."""
    pixels = lobes.shape[0] * lobes.shape[1]
    first = np.searchsorted(lobes.pixel, np.arange(pixels))
    place = np.arange(len(lobes.pixel)) - first[lobes.pixel]
    probabilities = np.zeros((pixels, place.max() + 1))
    probabilities[lobes.pixel, place] = lobes.probability
    probabilities /= probabilities.sum(axis=1, keepdims=True)
    means = np.empty((batches, pixels, 3))
    several = np.bincount(lobes.pixel, minlength=pixels) > 1
    means[:, ~several] = lobes.value[first[~several]]
    counts = rng.multinomial(samples, probabilities[several], size=(batches, np.count_nonzero(several)))
    values = np.zeros((*probabilities.shape, 3))
    values[lobes.pixel, place] = lobes.value
    means[:, several] = np.einsum("bpk,pkc->bpc", counts, values[several]) / samples
    return means.reshape(batches, *lobes.shape, 3).astype(np.float32)
