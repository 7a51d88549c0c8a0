"""Faults of mirrors (docs/spec.md, REFL)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit
from raytruth.reference_tracer.source.vector import along, dot, negate, normalize, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector


@fault("REFL-1", "mirror_direction", "Draw d, n and r: how often does the part along n have to be taken away?")
def reflection_without_the_two(direction: Vector, normal: Vector) -> Vector:
    """The part along the normal is taken away once instead of twice, so reflected rays run along the surface."""
    return along(direction, normal, -dot(direction, normal))


@fault("REFL-1", "mirror_direction", "Does your formula expect the direction to the surface or from it?")
def reflection_reversed(direction: Vector, normal: Vector) -> Vector:
    """The formula for a vector that points away from the surface is used for one that points to it."""
    return negate(along(direction, normal, -2.0 * dot(direction, normal)))


@fault("REFL-1", "mirror_direction", "Between which two directions does the halfway vector lie?")
def halfway_vector_for_the_reflection(direction: Vector, normal: Vector) -> Vector:
    """The direction halfway between the normal and the way back is taken for the mirror direction."""
    return normalize(subtract(normal, direction))


@fault(
    "REFL-2",
    "reflected_ray",
    "Which colour has the image in a golden mirror?",
    Edit("weight", "(weight[0], weight[0], weight[0])"),
)
def reflection_in_one_channel() -> None:
    """The red reflectance is used for all three channels."""


@fault("REFL-2", "reflected_ray", "How bright is the image in a perfect mirror?", Edit("weight", "scale(weight, 0.99)"))
def reflection_one_percent_too_dark() -> None:
    """One percent of the light is lost at every reflection."""
