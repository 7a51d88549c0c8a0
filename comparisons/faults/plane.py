"""Faults of infinite planes (docs/spec.md, PLANE)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit
from raytruth.reference_tracer.source.vector import negate, normalize

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector


@fault(
    "PLANE-1",
    "plane_distance",
    "What is seen above the horizon of a floor?",
    Edit("(height > 0.0 and approach > 0.0) or (height < 0.0 and approach < 0.0)", "approach != 0.0"),
    Edit("height / approach", "abs(height / approach)"),
)
def plane_behind_the_start() -> None:
    """The sign of t is not checked, so the floor shows above its horizon, too."""


@fault(
    "PLANE-1",
    "plane_distance",
    "Move the floor in the scene: does it move in the image?",
    Edit("subtract(point, origin)", "negate(origin)"),
)
def plane_through_the_origin() -> None:
    """The plane's point is left out, so every plane goes through the origin."""


@fault(
    "PLANE-1",
    "plane_distance",
    "What becomes of t if the normal is twice as long?",
    Edit("dot(direction, normal)", "dot(direction, normalize(normal))"),
)
def plane_normal_of_two_lengths() -> None:
    """One of the two products is taken with the unit normal and the other with the stated one."""


@fault(
    "PLANE-2",
    "plane_distance",
    "Below which angle do your planes vanish?",
    Edit(
        "dot(direction, normal)",
        "dot(direction, normal) if abs(dot(normalize(direction), normalize(normal))) > 0.05 else 0.0",
    ),
)
def nearly_parallel_rays_miss_planes() -> None:
    """Rays that are nearly parallel to a plane count as parallel and miss it: floors end before their horizon."""


@fault(
    "PLANE-3",
    "plane_distance",
    "From how many sides can a plane be seen?",
    Edit("(height > 0.0 and approach > 0.0) or (height < 0.0 and approach < 0.0)", "height < 0.0 and approach < 0.0"),
)
def planes_seen_from_the_front_only() -> None:
    """A plane is seen only from the side that its normal points to."""


@fault("PLANE-3", "distance_to_plane", "Which plane does your ray come from?", Edit("plane == left", "False"))
def planes_met_where_they_are_left() -> None:
    """Rays are tested against the plane that they leave, and rounding puts half of their starts beneath it."""


@fault("PLANE-4", "plane_normal", "How long is the normal that the scene states?")
def plane_normal_not_normalised(normal: Vector) -> Vector:
    """The stated normal is used for shading as long as it is."""
    return normal


@fault("PLANE-5", "plane_normal", "On which side of the surface is the water?")
def water_above_its_surface(normal: Vector) -> Vector:
    """The half space that the normal points to is taken for the inside."""
    return negate(normalize(normal))
