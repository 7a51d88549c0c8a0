"""Float images made visible: tone, signed difference, error in units of the tolerance, deviation."""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO
import PIL.Image
from numpy.typing import NDArray

from raytruth.comparisons.records.srgb import srgb_encoded

if TYPE_CHECKING:
    from collections.abc import Sequence

FloatImage = NDArray[np.float32]
"""Linear values, shape (height, width) or (height, width, 3), row 0 on top."""

Colours = NDArray[np.floating]
"""sRGB-encoded colours in 0..1, shape (height, width, 3)."""

MARK = (1.0, 0.0, 1.0)
"""Magenta, for failing pixels, and for what is not a number in an image: far from every colour of viridis and from the
hatch, for colour-blind eyes too (a test measures it)."""

DIFFERENCE_MARK = (0.0, 0.0, 0.0)
"""Black, for what is not a number in a difference: some colour-blind eyes see magenta like the scale's blue."""

HATCH = ((0.55, 0.55, 0.55), (0.85, 0.85, 0.85))
"""Two greys in diagonal stripes, for unjudged pixels: viridis has no grey, and a stripe needs no colour."""

DIVERGING = (
    (0.129, 0.400, 0.675),
    (0.573, 0.773, 0.871),
    (0.969, 0.969, 0.969),
    (0.957, 0.647, 0.510),
    (0.698, 0.094, 0.169),
)
"""Blue, white, red: ColorBrewer's RdBu (Harrower and Brewer 2003), which colour-blind readers can tell apart."""

LEVELS = 64
"""Steps of a scale: finer ones are not seen, and coarser noise makes a smaller file."""

BRIGHT_FRACTION = 0.99
"""The exposure fits this fraction of the pixels, so that a highlight or a visible lamp does not darken the rest."""


def exposure_stops(truth: FloatImage) -> int:
    """Whole stops (factors of two) that bring the truth's bright pixels into 1/2..1; 0 for a black image."""
    brightest = truth.max(axis=-1)
    finite = brightest[np.isfinite(brightest)]
    bright = float(np.quantile(finite, BRIGHT_FRACTION)) if finite.size else 0.0
    return -math.ceil(math.log2(bright)) if bright > 0 else 0


def tone_picture(image: FloatImage, stops: int = 0) -> bytes:
    """A PNG of linear Rec. 709 light, brightened by `stops`, clipped to 0..1, sRGB-encoded; not-a-number is magenta."""
    not_finite = np.asarray(~np.isfinite(image).all(axis=-1))
    wide = np.nan_to_num(image.astype(np.float64))  # float32 may overflow when brightened
    return _png(_marked(srgb_encoded(np.clip(wide * 2.0**stops, 0, 1)), not_finite))


def signed_difference(render: FloatImage, truth: FloatImage) -> FloatImage:
    """Render minus truth in the channel that differs most at each pixel, shape (height, width); keeps the sign."""
    with np.errstate(invalid="ignore", over="ignore"):  # what is infinite or overflows is marked in the picture
        difference = render - truth
    channel = np.abs(difference).argmax(axis=-1)  # a not-a-number counts as the largest
    return np.take_along_axis(difference, channel[..., None], axis=-1)[..., 0]


def largest_finite(values: FloatImage) -> float:
    """The largest finite magnitude of an array, which ends a colour scale; 0 where there is none."""
    finite = np.abs(values[np.isfinite(values)])
    return float(finite.max()) if finite.size else 0.0


def difference_picture(difference: FloatImage, scale: float) -> bytes:
    """A PNG of signed values, shape (height, width): blue at -scale, white at 0, red at scale; not-a-number black."""
    finite = np.isfinite(difference)
    relative = np.where(finite, difference, 0) / (scale or 1.0)
    return _png(_marked(_diverging((relative + 1) / 2), ~finite, DIFFERENCE_MARK))


def tolerance_picture(tolerances: FloatImage) -> bytes:
    """A PNG of errors in units of the tolerance, shape (height, width): viridis over 0..1, failing pixels magenta,
    unjudged ones (negative) hatched. What is not a number fails.
    """
    unjudged = tolerances < 0
    passing = (tolerances >= 0) & (tolerances <= 1)
    colours = _viridis(np.where(passing, tolerances, 0))
    rows, columns = np.indices(tolerances.shape)
    stripes = np.asarray(HATCH, dtype=np.float32)[(rows + columns) // 2 % 2]
    return _png(_marked(np.where(unjudged[..., None], stripes, colours), ~unjudged & ~passing))


def deviation_picture(variance: FloatImage) -> tuple[bytes, float]:
    """A PNG of the standard deviation in the channel that varies most, viridis up to its largest, and that largest."""
    largest = variance if variance.ndim == 2 else variance.max(axis=-1)
    deviation = np.sqrt(np.maximum(largest, 0))
    scale = largest_finite(deviation)
    finite = np.isfinite(deviation)
    return _png(_marked(_viridis(np.where(finite, deviation, 0) / (scale or 1.0)), ~finite)), scale


def difference_legend() -> bytes:
    """A PNG strip of the diverging scale, one pixel high, from -scale to scale."""
    return _png(_diverging(_ramp()))


def sequential_legend() -> bytes:
    """A PNG strip of the sequential scale, one pixel high, from 0 to 1."""
    return _png(_viridis(_ramp()))


def hatch_legend() -> bytes:
    """A PNG swatch of the pattern of unjudged pixels."""
    return tolerance_picture(np.full((8, 16), -1, dtype=np.float32))


def _ramp() -> FloatImage:
    return np.linspace(0, 1, 2 * LEVELS, dtype=np.float32)[None, :]


def _diverging(values: NDArray[np.floating]) -> Colours:
    """Colours of values in 0..1, white at 1/2; an even number of steps, so that 1/2 is one of them."""
    return _mapped(values, 2 * LEVELS, len(DIVERGING), np.ravel(DIVERGING).tolist())


def _viridis(values: NDArray[np.floating]) -> Colours:
    light = _mapped(values, LEVELS, "viridis")  # OpenImageIO gives its own scales as linear light
    return srgb_encoded(light.astype(np.float64))


def _mapped(values: NDArray[np.floating], levels: int, *scale: str | int | Sequence[float]) -> Colours:
    stepped = (np.round(values * levels) / levels).astype(np.float32)
    arguments = scale if len(scale) == 1 else (scale[0], 3, scale[1])
    return _pixels(OpenImageIO.ImageBufAlgo.color_map(OpenImageIO.ImageBuf(stepped[..., None].copy()), 0, *arguments))


def _pixels(buffer: OpenImageIO.ImageBuf) -> NDArray[np.float32]:
    if buffer.has_error:
        raise RuntimeError(f"OpenImageIO could not colour an image: {buffer.geterror()}")
    return np.asarray(buffer.get_pixels(OpenImageIO.FLOAT), dtype=np.float32)


def _marked(colours: Colours, where: NDArray[np.bool_], mark: tuple[float, float, float] = MARK) -> Colours:
    return np.where(where[..., None], np.asarray(mark, dtype=np.float32), colours)


def _png(colours: Colours) -> bytes:
    """The colours as an 8-bit PNG, with a palette where 256 colours suffice: noise on a scale is then 3 times smaller.

    OpenImageIO writes no palettes, so this is Pillow's.
    """
    rgb = np.round(colours * 255).astype(np.uint8)
    packed = rgb.astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], dtype=np.uint32)
    palette, first, index = np.unique(packed, return_index=True, return_inverse=True)
    if len(palette) <= 256:
        image = PIL.Image.fromarray(index.reshape(packed.shape).astype(np.uint8), mode="P")
        image.putpalette(rgb.reshape(-1, 3)[first].tobytes())
    else:
        image = PIL.Image.fromarray(rgb)
    file = io.BytesIO()
    image.save(file, format="PNG", optimize=True)
    return file.getvalue()
