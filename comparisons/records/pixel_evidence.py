"""What each pixel of a cell is held to, kept as an OpenEXR file so that a report can show it.

A file holds the channels `nearest` (the place of the outcome that the value lies in or nearest to), `merged` (1 where
there were too many outcomes to tell apart, so that one box holds several), `declared` (1 where the value is as
declared, not as due), and for each outcome, from 0, its ends in each colour: `outcome0.low.R`, …, `outcome0.high.B`.
Unused outcomes are not numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.records.image_files import read_channels, write_channels

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

FIRST_NAMES = ("nearest", "merged", "declared")
END_NAMES = tuple(f"{end}.{color}" for end in ("low", "high") for color in "RGB")


@dataclass(frozen=True)
class PixelEvidence:
    """Boxes of the colours that a right renderer may give, one an outcome, at most K a pixel."""

    low: NDArray[np.float32]
    """The least float32 in each box, shape (height, width, K, 3); NaN in unused places."""
    high: NDArray[np.float32]
    """The largest float32 in each box."""
    nearest: NDArray[np.int64]
    """Shape (height, width): the place of the outcome that the value lies in or nearest to."""
    merged: NDArray[np.bool_]
    """Shape (height, width): whether one box holds several outcomes."""
    declared: NDArray[np.bool_]
    """Shape (height, width): whether only a declared shortcut explains the value, and one could see it."""


def pixel_evidence(
    low: NDArray[np.float64],
    high: NDArray[np.float64],
    nearest: NDArray[np.int64],
    merged: NDArray[np.bool_],
    declared: NDArray[np.bool_],
) -> PixelEvidence:
    """The evidence in float32: of images in float32 exactly the same values lie in these boxes.

    So a box that holds no float32 has its ends the wrong way round.
    """
    least, largest = _to_float32(low), _to_float32(high)
    return PixelEvidence(
        np.where(least < low, np.nextafter(least, np.float32(np.inf)), least),
        np.where(largest > high, np.nextafter(largest, np.float32(-np.inf)), largest),
        nearest,
        merged,
        declared,
    )


def write_pixel_evidence(path: Path, evidence: PixelEvidence) -> None:
    """Write the file whole or not at all. Raises ImageError if it cannot be written."""
    height, width, outcomes, _ = evidence.low.shape
    ends = np.concatenate([evidence.low, evidence.high], axis=3).reshape(height, width, -1)
    first = np.stack([evidence.nearest, evidence.merged, evidence.declared], axis=2).astype(np.float32)
    write_channels(path, np.concatenate([first, ends], axis=2), _names(outcomes))


def read_pixel_evidence(path: Path) -> PixelEvidence:
    """The pixel evidence in a file. Raises ImageError where it is missing, damaged or of another kind."""
    pixels, found = read_channels(path, _are_right, f"the channels {', '.join(_names(1))} and so on")
    outcomes = _count(found)
    names = _names(outcomes)
    ordered = pixels[..., [found.index(name) for name in names]]
    nearest, merged, declared = np.nan_to_num(ordered[..., 0]), ordered[..., 1], ordered[..., 2]
    ends = ordered[..., len(FIRST_NAMES) :].reshape(*pixels.shape[:2], outcomes, 2, 3)
    return PixelEvidence(
        low=ends[..., 0, :],
        high=ends[..., 1, :],
        nearest=np.clip(nearest, 0, outcomes - 1).astype(np.int64),
        merged=merged > 0,
        declared=declared > 0,
    )


def _to_float32(values: NDArray[np.float64]) -> NDArray[np.float32]:
    with np.errstate(over="ignore"):  # what float32 cannot hold is infinite in it
        return values.astype(np.float32)


def _count(names: tuple[str, ...]) -> int:
    return (len(names) - len(FIRST_NAMES)) // len(END_NAMES)


def _are_right(names: tuple[str, ...]) -> bool:
    """Whether these are the channels of at least one outcome, in any order."""
    return _count(names) > 0 and sorted(names) == sorted(_names(_count(names)))


def _names(outcomes: int) -> tuple[str, ...]:
    """The channels' names in the order of the arrays; a file may have another order."""
    return (*FIRST_NAMES, *(f"outcome{place}.{end}" for place in range(outcomes) for end in END_NAMES))
