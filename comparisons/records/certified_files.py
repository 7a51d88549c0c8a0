"""Certified images as OpenEXR files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.records.image_files import write_channels

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.reference_tracer.certified_image import CertifiedImage

LAYERS = ("", "residual.", "radius.")
CHANNEL_NAMES = (*(f"{layer}{channel}" for layer in LAYERS for channel in "RGB"), "precision_bits")


def write_certified_image(path: Path, image: CertifiedImage) -> None:
    """Write ten channels of float32: R, G and B, residual.*, radius.*, and precision_bits.

    The true value lies within the radius of the sum of value and residual, which has 48 bits. Raises ImageError if the
    file cannot be written; it appears whole or not at all.
    """
    bits = image.precision_bits[..., np.newaxis].astype(np.float32)
    write_channels(path, np.concatenate([*single_precision(image.middle, image.radius), bits], axis=2), CHANNEL_NAMES)


def single_precision(
    middle: NDArray[np.float64], radius: NDArray[np.float64]
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Value, residual and radius in float32; the radius is rounded up and holds what the other two lose.

    It is infinite where float32 cannot hold the value.
    """
    with np.errstate(over="ignore"):
        value = middle.astype(np.float32)
        held = np.isfinite(value)
        # Both differences are exact: no bit of a float64 is lost where its leading ones are taken away.
        rest = np.subtract(middle, value, out=np.zeros_like(middle), where=held)
        residual = rest.astype(np.float32)
        lost = np.where(held, np.abs(rest - residual), np.inf)
        # A sum is rounded by half of a unit in the last place at most, and so is a float32.
        wide = np.where(lost > 0.0, np.nextafter(radius + lost, np.inf), radius)
        rounded = wide.astype(np.float32)
        up = np.where(rounded < wide, np.nextafter(rounded, np.float32(np.inf)), rounded)
    return value, residual, up
