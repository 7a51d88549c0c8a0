"""Whether a person could see that two linear values differ, in a picture of 8 bits."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.records.srgb import srgb_encoded

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

LARGEST_CODE = 255
# Rounding alone may put two values that are as near as one likes into codes next to each other.
NOT_SEEN = 1


def differs_visibly(values: ArrayLike, others: ArrayLike) -> NDArray[np.bool_]:
    """Where two arrays of linear values, which broadcast together, have 8-bit sRGB codes more than one apart.

    Above white, which has the largest code, both are divided by the larger of the two: there it counts which share of
    the value they differ by. Negative values have the code 0. What is not a number, or infinite, differs visibly from
    all that is not the same.
    """
    first, second = np.broadcast_arrays(np.asarray(values, np.float64), np.asarray(others, np.float64))
    finite = np.isfinite(first) & np.isfinite(second)
    white = np.maximum(1.0, np.maximum(np.where(finite, first, 0.0), np.where(finite, second, 0.0)))
    codes = [
        np.rint(LARGEST_CODE * srgb_encoded(np.clip(np.where(finite, part, 0.0) / white, 0.0, 1.0)))
        for part in (first, second)
    ]
    apart: NDArray[np.bool_] = np.where(finite, np.abs(codes[0] - codes[1]) > NOT_SEEN, first != second)
    return apart
