"""Faults on the way from radiance to the file (docs/spec.md, IMG and OUT)."""

from __future__ import annotations

import numpy as np

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.faults.fault import Array, output_fault
from raytruth.comparisons.records.srgb import srgb_decoded, srgb_encoded

BYTES = OutputModel("uint8", "sRGB", clipped=True)


def _bytes_of(values: Array, scale: float = 255.0) -> Array:
    """Codes from 0 to 255 of values in [0, 1]."""
    return np.floor(np.clip(values, 0.0, 1.0) * scale + 0.5)


@output_fault("IMG-1", "Which rows does your loop visit?")
def last_row_left_out(image: Array) -> Array:
    """The loop over the rows ends one too early, and the last row stays black."""
    image[-1] = 0.0
    return image


@output_fault("IMG-1", "What is in a new array before you write to it?")
def pixels_left_uninitialised(image: Array) -> Array:
    """One pixel in every 16 by 16 is never written and holds what was in memory."""
    image[7::16, 5::16] = 3.7e-5
    return image


@output_fault("IMG-1", "What does each thread write to, and who else does?")
def rows_race(image: Array) -> Array:
    """Two threads write to the same buffer, so that now and then a row holds the one above it."""
    late = np.random.default_rng().permutation(np.arange(1, len(image)))[: max(1, len(image) // 4)]
    image[late] = image[late - 1]
    return image


@output_fault("IMG-3", "Which is the largest value in your file, and which one should it be?")
def clamped_to_one(image: Array) -> Array:
    """Values are clamped to 1, although the file can hold more."""
    return np.clip(image, 0.0, 1.0)


@output_fault("IMG-3", "What does your program do to a value between the lighting equation and the file?")
def tone_mapped(image: Array) -> Array:
    """Values are mapped by x/(1 + x) to make highlights look better."""
    return image / (1.0 + image)


@output_fault("IMG-3", "Is anything multiplied into your values after the lighting equation?")
def one_percent_too_bright(image: Array) -> Array:
    """The exposure is one percent too high."""
    return image * 1.01


@output_fault("OUT-1", "In which order are the channels stored?")
def channels_exchanged(image: Array) -> Array:
    """Red and blue are exchanged."""
    return image[..., ::-1]


@output_fault("OUT-1", "What does a viewer of linear images expect in the file?")
def gamma_in_a_linear_file(image: Array) -> Array:
    """The curve of sRGB is applied before a linear file is written."""
    return srgb_encoded(np.maximum(image, 0.0))


@output_fault("OUT-1", "How many different values has your image?")
def eight_bits_in_a_float_file(image: Array) -> Array:
    """Values are rounded to 256 steps before a float file is written."""
    return _bytes_of(image) / 255.0


@output_fault("OUT-1", "How many digits has a value of your file?")
def half_floats_declared_as_single(image: Array) -> Array:
    """Values are stored as half floats, although single floats are declared."""
    return image.astype(np.float16).astype(np.float64)


@output_fault("OUT-2", "What does the file hold when your program is stopped halfway?")
def file_cut_short(image: Array) -> Array:
    """The file is written as rows are finished, and is there before it is whole."""
    image[len(image) // 2 :] = 0.0
    return image


@output_fault("OUT-3", "How often is the curve applied on the way to the screen?", BYTES)
def gamma_twice(image: Array) -> Array:
    """The curve of sRGB is applied twice, once by the program and once by its image library."""
    once = srgb_encoded(np.clip(image, 0.0, 1.0))
    return srgb_decoded(_bytes_of(srgb_encoded(once)) / 255.0)


@output_fault("OUT-3", "What does an image viewer do to the values of a PNG file?", BYTES)
def gamma_forgotten(image: Array) -> Array:
    """Linear values are written to a file that is read as sRGB."""
    return srgb_decoded(_bytes_of(image) / 255.0)


@output_fault("OUT-3", "Which code has the value 0.002 by the curve of sRGB, and which one do you write?", BYTES)
def plain_power_for_the_curve(image: Array) -> Array:
    """The power 1/2.2 is used in place of the curve of sRGB."""
    return srgb_decoded(_bytes_of(np.clip(image, 0.0, 1.0) ** (1.0 / 2.2)) / 255.0)


@output_fault("OUT-3", "Which code has the value 1?", BYTES)
def scaled_by_254(image: Array) -> Array:
    """Values are multiplied by 254 instead of 255."""
    return srgb_decoded(_bytes_of(srgb_encoded(np.clip(image, 0.0, 1.0)), 254.0) / 255.0)


@output_fault("OUT-3", "What does your language do when it makes an integer of 0.99?", BYTES)
def truncated_codes(image: Array) -> Array:
    """Codes are truncated instead of rounded."""
    return srgb_decoded(np.floor(srgb_encoded(np.clip(image, 0.0, 1.0)) * 255.0) / 255.0)


@output_fault("OUT-3", "What happens to 256 in a byte?", BYTES)
def codes_wrap_around(image: Array) -> Array:
    """Values above 1 are not clipped, and wrap around in a byte."""
    return srgb_decoded(np.floor(srgb_encoded(np.maximum(image, 0.0)) * 255.0 + 0.5) % 256.0 / 255.0)
