"""The transfer curve of sRGB."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


def srgb_encoded(linear: Array) -> Array:
    """The curve of sRGB: 12.92·x up to 0.0031308, then 1.055·x^(1/2.4) - 0.055 (IEC 61966-2-1:1999, section 5.2)."""
    steep = 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055
    return np.asarray(np.where(linear <= 0.0031308, 12.92 * linear, steep))


def srgb_decoded(encoded: Array) -> Array:
    """The inverse of `srgb_encoded`: x/12.92 up to 0.04045, then ((x + 0.055)/1.055)^2.4 (ibid., section 5.3)."""
    steep = ((np.maximum(encoded, 0.04045) + 0.055) / 1.055) ** 2.4
    return np.asarray(np.where(encoded <= 0.04045, encoded / 12.92, steep))
