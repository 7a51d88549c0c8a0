"""Pixels that are as declared, not as due: a declared shortcut alone explains them, and one could see it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.measures.visibility import differs_visibly
from raytruth.comparisons.records.results import DeclaredPixels

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Beyond that many a picture tells more than a list.
MOST_LISTED = 1000


def as_declared(
    image: NDArray[np.float32], truth: NDArray[np.float64], by_shortcut: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Which pixels are as declared, not as due: only a shortcut explains them, and one sees it; (height, width)."""
    declared: NDArray[np.bool_] = by_shortcut & differs_visibly(image, truth).any(axis=2)
    return declared


def declared_pixels(
    image: NDArray[np.float32], truth: NDArray[np.float64], declared: NDArray[np.bool_]
) -> DeclaredPixels | None:
    """The count of pixels that are as declared, which they are, and how far they are from the truth; None for none."""
    if not declared.any():
        return None
    with np.errstate(invalid="ignore"):  # of two infinities
        differences = np.abs(np.asarray(image, np.float64) - truth).max(axis=2)[declared]
    places = np.argwhere(declared)[np.argsort(-differences, kind="stable")]
    pixels = tuple((int(x), int(y)) for y, x in places[:MOST_LISTED])
    return DeclaredPixels(count=len(places), largest_difference=float(differences.max()), pixels=pixels)
