"""Reads what a program tells of its first hits: an OpenEXR file with the usual names of such channels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.records.image_files import ImageError, read_channels
from raytruth.comparisons.records.renderings import FirstHits

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

FIRST_HITS_FILE = "first_hits.exr"
CHANNELS = ("Z", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "id")
"""Distance along the unit ray, point, outward geometric normal, and the primitive's number, -1 where nothing is hit."""


def read_first_hits(path: Path, size: tuple[int, int]) -> FirstHits:
    """The first hits in a file of a size, (height, width). Raises ImageError for what is none.

    Channels besides CHANNELS do not matter.
    """
    pixels, names = read_channels(path, lambda names: set(CHANNELS) <= set(names), ", ".join(CHANNELS))
    if pixels.shape[:2] != size:
        raise ImageError(
            f"its {path.name} has {pixels.shape[1]}x{pixels.shape[0]} pixels, expected {size[1]}x{size[0]}"
        )
    channels = pixels[..., [names.index(name) for name in CHANNELS]].astype(np.float64)
    return FirstHits(channels[..., 0], channels[..., 1:4], channels[..., 4:7], _whole(path, channels[..., 7]))


def _whole(path: Path, numbers: NDArray[np.float64]) -> NDArray[np.int64]:
    # Beyond 2^24 float32 does not hold each whole number; no scene has as many primitives.
    if not (np.isfinite(numbers) & (np.abs(numbers) < 2**24) & (numbers == np.rint(numbers))).all():
        raise ImageError(f"expected whole numbers in the channel id of its {path.name}, found others")
    return numbers.astype(np.int64)
