"""Faults of the arithmetic (docs/spec.md, NUM)."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.faults.fault import Array, fault, output_fault
from raytruth.reference_tracer.source.vector import along, dot, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


@fault("NUM-3", "normalize", "How many digits has a float of your language?", numbers="float32")
def single_precision_declared_as_double(a: Vector) -> Vector:
    """The program computes in float32, but says that it computes in float64."""
    return scale(a, 1.0 / sqrt(dot(a, a)))


@fault("NUM-3", "normalize", "How many digits has your inverse square root?")
def fast_inverse_square_root(a: Vector) -> Vector:
    """Vectors are normalised with a fast inverse square root that is right to five digits."""
    return scale(a, (1.0 + 1e-5) / sqrt(dot(a, a)))


@fault("NUM-2", "refracted_direction", "Under which of your roots can a number below 0 stand?")
def root_of_a_negative_number(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:
    """The cosine behind the surface is taken from 1 - sin², which may fall below 0, and its root is not a number."""
    sine_squared = (1.0 - cosine * cosine) * ratio * ratio
    return along(scale(direction, 1.0 / ratio), normal, cosine / ratio - sqrt(1.0 - sine_squared))


@output_fault("NUM-2", "Which of your divisions can have a divisor of 0?")
def one_pixel_not_a_number(image: Array) -> Array:
    """One pixel is not a number."""
    image[len(image) // 2, 0] = np.nan
    return image


@output_fault("NUM-2", "Can there be less light than none?")
def negative_light(image: Array) -> Array:
    """A small bias is taken away from all values, which makes dark ones negative."""
    return image - 1e-4
