"""Output models: how a renderer turns radiance into the numbers it writes, and what is read back from them.

Radiance is clipped, encoded by a transfer curve and rounded to a number format. Each step is monotone, so an interval
of radiance becomes an interval of codes, found from its two ends. Pixels are judged as linear values that were read
back from the codes; a code stands for everything up to halfway to its neighbours, so that it does not matter with how
many roundings the reader decodes it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from raytruth.comparisons.records.srgb import srgb_decoded, srgb_encoded

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

LARGEST_CODES = {"uint8": 255, "uint16": 65535}
"""The code of 1; 0 is the code of 0."""

# Darker colours are written as 0 (Ward's `setcolr`: `if (d <= 1e-32)`).
DARKEST_RGBE = 1e-32

# Renderers whose own numbers are wider may still go through float32 on their way to a file.
FLOAT32_ROUNDOFF = 2.0**-24
# To float32, times the largest code, plus a half.
LINEAR_ROUNDOFFS = 3
# To store a scale, to multiply with it, and to divide by it.
SCALE_ROUNDOFFS = 3
# The encoding 1.055·x^(1/2.4) - 0.055, in roundoffs for x from 0.0031308 to 1: x itself 1/2.4; the exponent |ln x|/2.4,
# up to 2.4; the power function 4 (two units in the last place); its factor and the product 2; the subtraction magnifies
# these by up to 2.4, and adds the constant's 1.4 and 1; the three of above. That is 27, rounded up to a power of two.
# Beyond 1 only the exponent's share grows, and nothing is magnified: it holds for all x up to 1e20. The decoding takes
# fewer: the sum 2, the quotient 2, magnified by 2.4; the exponent 2.4·|ln|, up to 5.8; the power function 4.
CURVE_ROUNDOFFS = 32


@dataclass(frozen=True)
class OutputModel:
    """The numbers that a renderer writes for a radiance. Raises ValueError for integers that are not clipped."""

    numbers: Literal["uint8", "uint16", "float16", "float32", "float64", "rgbe"] = "float32"
    """`rgbe`: three mantissas of 8 bits with one exponent (Ward, "Real Pixels", Graphics Gems II, 1991)."""
    transfer: Literal["linear", "sRGB"] = "linear"
    """Whether the curve of sRGB (IEC 61966-2-1:1999, section 5.2) is applied before rounding."""
    rounding: Literal["nearest", "truncation"] = "nearest"
    clipped: bool = False
    """To [0, 1]."""
    bracketed: bool = False
    """Whether the picture is written at the exposures 1, 1/2, 1/4, …, and each value read from the brightest one in
    which its code is not the largest. Only of linear integers."""
    scale: float = 1.0
    """What is written is so many times the radiance, as by an exposure, or by who writes 0 to 255 as floats; undone by
    who reads it."""
    color_error: float = 0.0
    """How far a colour may be off before all this, by arithmetic that is coarser than that of the rays: in units of
    the colour or, if it is under 1, of 1, from which it may be the difference."""

    def __post_init__(self) -> None:
        if self.numbers in LARGEST_CODES and not (self.clipped or self.bracketed):
            raise ValueError("integers hold nothing outside [0, 1], so their output is clipped or bracketed")
        if self.bracketed and (self.clipped or self.numbers not in LARGEST_CODES or self.transfer != "linear"):
            raise ValueError("only linear integers are bracketed, and then they are not clipped")
        if not 0.0 < self.scale < np.inf:
            raise ValueError("a scale of what is written is finite and above 0")
        if self.numbers == "rgbe" and self.transfer != "linear":
            raise ValueError("colours with one exponent are linear")

    def interval_read(self, low: ArrayLike, high: ArrayLike) -> tuple[Array, Array]:
        """The linear values that may be read where the radiance is in [low, high]; NaN stays NaN.

        Above what a format can hold the ends are infinite, as what is written there. The last axis is that of
        a colour's channels, which matters to `rgbe` only.
        """
        ends = np.asarray(low, np.float64), np.asarray(high, np.float64)
        if self.numbers == "rgbe":
            return self._shared_exponent(*ends)
        return self._end_read(ends[0], -1), self._end_read(ends[1], 1)

    def linear_values(self, written: ArrayLike) -> Array:
        """The radiances that a file's codes or numbers stand for; the largest code of integers is 1, over the scale."""
        values = np.asarray(written, np.float64) / LARGEST_CODES.get(self.numbers, 1)
        return (srgb_decoded(values) if self.transfer == "sRGB" else values) / self.scale

    def in_words(self) -> str:
        """The output as a clause for people, as in `raytruth renderers`."""
        clipping = "clipped to [0, 1]" if self.clipped else "not clipped"
        if self.bracketed:
            clipping = "at the brightest of the exposures 1, 1/2, 1/4, … that does not clip"
        rounding = "rounded to the nearest" if self.rounding == "nearest" else "truncated"
        colors = f", of colours computed within {self.color_error:.3g}" if self.color_error > 0.0 else ""
        scaled = f", of {self.scale:.4g} times the radiance" if self.scale != 1.0 else ""
        return f"{self.numbers}, {self.transfer}, {rounding}, {clipping}{scaled}{colors}"

    def _encoded(self, radiance: Array, side: int) -> Array:
        """The lowest or highest number that this radiance may become before it is rounded."""
        computed = (
            radiance + side * self.color_error * np.maximum(np.abs(radiance), 1.0) if self.color_error else radiance
        )
        scaled = computed * (self.scale * (1.0 + side * self._scale_slack() * np.sign(computed)))
        clipped = np.clip(scaled, 0.0, 1.0) if self.clipped else scaled
        return srgb_encoded(clipped) if self.transfer == "sRGB" else clipped

    def _shared_exponent(self, low: Array, high: Array) -> tuple[Array, Array]:
        """A code more to either side: encoders round or cut off, and decoders add half a code or none.

        A code is 2^(e - 8), where the brightest channel is below 2^e. What is darker than 1e-32 is written as 0.
        """
        low, high = self._encoded(low, -1) * (1 - self._slack()), self._encoded(high, 1) * (1 + self._slack())
        brightest = np.maximum(high.max(axis=-1, keepdims=True), DARKEST_RGBE)
        code = np.maximum(np.ldexp(1.0, np.frexp(brightest)[1] - 8), DARKEST_RGBE)
        return np.maximum(low - code, 0.0) / self.scale, (high + code) / self.scale

    def _end_read(self, radiance: Array, side: int) -> Array:
        """The lowest (side -1) or highest (side 1) value that may be read for this radiance."""
        encoded = self._encoded(radiance, side)
        exposure = self._exposure(encoded, side) if self.bracketed else 1.0
        encoded = encoded * exposure
        written = self._integers(encoded, side) if self.numbers in LARGEST_CODES else self._floats(encoded, side)
        read = self.linear_values(written) / exposure
        return read + side * CURVE_ROUNDOFFS * FLOAT32_ROUNDOFF * np.abs(read) if self.transfer == "sRGB" else read

    def _exposure(self, encoded: Array, side: int) -> Array:
        """The brightest exposure in which this value, moved by all that may move it, is not written as the largest."""
        largest = LARGEST_CODES[self.numbers]
        first_clipped = largest - (0.5 if self.rounding == "nearest" else 0.0)
        codes = encoded * largest + side * self._slack() * (encoded * largest + 0.5)
        _, exponents = np.frexp(np.maximum(codes, 0.0) / first_clipped)  # the least power of two above
        return np.ldexp(1.0, -np.maximum(exponents, 0))

    def _integers(self, encoded: Array, side: int) -> Array:
        """The farthest code that may be written, and half a code more."""
        largest = LARGEST_CODES[self.numbers]
        # The half that is added before the integer part is taken has a rounding, too.
        codes = encoded * largest + side * self._slack() * (encoded * largest + 0.5)
        codes = np.rint(codes) if self.rounding == "nearest" else np.floor(codes)
        return np.asarray(np.clip(codes, 0, largest) + 0.5 * side, np.float64)

    def _floats(self, encoded: Array, side: int) -> Array:
        """The farthest number that may be written, and half the way to the next; none is beyond the largest."""
        farthest = encoded + side * self._slack() * np.abs(encoded)
        with np.errstate(over="ignore"):  # what the format cannot hold is infinite in it
            written: NDArray[Any] = farthest.astype(self.numbers)
            if self.rounding == "truncation":
                toward_zero = np.nextafter(written, written.dtype.type(0))
                written = np.where(np.abs(written.astype(np.float64)) > np.abs(farthest), toward_zero, written)
            neighbour = np.nextafter(written, written.dtype.type(side * np.inf)).astype(np.float64)
        value = written.astype(np.float64)
        if self.numbers == "float64":
            return value  # nothing lies between two neighbours
        has_neighbour = np.isfinite(value) & np.isfinite(neighbour)
        halfway = 0.5 * np.where(has_neighbour, value, 0.0) + 0.5 * np.where(has_neighbour, neighbour, 0.0)
        return np.where(has_neighbour, halfway, value)

    def _scale_slack(self) -> float:
        """How far scale, product and quotient may be off: a rounding of float32 each, none for a power of two."""
        return 0.0 if np.frexp(self.scale)[0] == 0.5 else SCALE_ROUNDOFFS * FLOAT32_ROUNDOFF

    def _slack(self) -> float:
        """How far a renderer's own rounding may move a number before it is written, relatively."""
        if self.transfer == "sRGB":
            return CURVE_ROUNDOFFS * FLOAT32_ROUNDOFF
        return 0.0 if self.numbers in {"float32", "float64"} else LINEAR_ROUNDOFFS * FLOAT32_ROUNDOFF
