"""Blocks of pixels, of 1 x 1, 2 x 2, 4 x 4, … up to the whole image, each tested as a pixel is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def block_sizes(height: int, width: int) -> list[int]:
    """The sides of blocks in pixels: 1, 2, 4, … up to a block that holds the whole image."""
    return [2**level for level in range((max(height, width) - 1).bit_length() + 1)]


def block_sums(image: Array, size: int) -> Array:
    """The sums over blocks of size x size pixels; those at the right and lower border may be smaller."""
    by_rows = np.add.reduceat(image, np.arange(0, image.shape[0], size), axis=0)
    sums: Array = np.add.reduceat(by_rows, np.arange(0, image.shape[1], size), axis=1)
    return sums


def spread(blocks: Array, size: int, shape: tuple[int, ...]) -> Array:
    """For each pixel of an image of this shape the value of its block; `size` is the blocks' side in pixels."""
    return blocks.repeat(size, axis=0)[: shape[0]].repeat(size, axis=1)[:, : shape[1]]
