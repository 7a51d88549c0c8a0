"""Faults of absorption in media (docs/spec.md, REFR-7 and REFR-9)."""

from __future__ import annotations

from math import exp
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.scene_data import MATERIAL_OUTSIDE, integer_of

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("REFR-7", "medium_transmittance", "What makes thick green glass greener than thin?")
def nothing_absorbed(absorption: Vector, distance: Scalar) -> Vector:
    """Media do not absorb."""
    return (1.0, 1.0, 1.0)


@fault("REFR-7", "medium_transmittance", "How much is left after twice the distance?")
def linear_absorption(absorption: Vector, distance: Scalar) -> Vector:
    """Light decreases linearly with the distance, down to nothing."""
    return (
        max(1.0 - absorption[0] * distance, 0.0),
        max(1.0 - absorption[1] * distance, 0.0),
        max(1.0 - absorption[2] * distance, 0.0),
    )


@fault("REFR-7", "medium_transmittance", "Which base has the exponential?")
def absorption_to_the_base_two(absorption: Vector, distance: Scalar) -> Vector:
    """The power is taken of 2 instead of e."""
    return (0.5 ** (absorption[0] * distance), 0.5 ** (absorption[1] * distance), 0.5 ** (absorption[2] * distance))


@fault("REFR-7", "medium_transmittance", "Which colour has the light behind green glass?")
def absorption_in_one_channel(absorption: Vector, distance: Scalar) -> Vector:
    """The red absorption is used for all three channels."""
    left = exp(-absorption[0] * distance)
    return (left, left, left)


@fault("REFR-7", "medium_transmittance", "How long is the way that the light goes?")
def absorption_there_and_back(absorption: Vector, distance: Scalar) -> Vector:
    """The way in the medium is counted twice, there and back."""
    return (
        exp(-2.0 * absorption[0] * distance),
        exp(-2.0 * absorption[1] * distance),
        exp(-2.0 * absorption[2] * distance),
    )


@fault("REFR-9", "medium_beyond", "In which medium is a ray that has left the glass?")
def medium_never_left(scene: SceneData, material: int, entering: bool) -> int:
    """A ray that has entered a medium stays in it for ever."""
    return material


@fault("REFR-9", "medium_beyond", "On which side of its surface is the glass?")
def media_exchanged(scene: SceneData, material: int, entering: bool) -> int:
    """The media on both sides of a surface are exchanged."""
    return integer_of(scene, MATERIAL_OUTSIDE, material) if entering else material
