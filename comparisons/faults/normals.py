"""Faults in the orientation of normals (docs/spec.md, ILL-1 and REFR-1)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.traversal import surface_normal
from raytruth.reference_tracer.source.vector import along, dot, negate

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("ILL-1", "surface_at", "What does the inside of an open surface look like?")
def normal_not_turned_to_the_viewer(
    scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int
) -> tuple[Vector, Vector, bool]:
    """The normal stays as the shape has it, so n·l is taken with a normal that points away from the viewer."""
    point = along(origin, direction, distance)
    outward = surface_normal(scene, primitive, point)
    return point, outward, dot(direction, outward) < 0.0


@fault("ILL-1", "surface_at", "What decides on which side of a surface the viewer is?")
def normal_turned_upward(
    scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int
) -> tuple[Vector, Vector, bool]:
    """Normals are turned upward instead of to the viewer."""
    point = along(origin, direction, distance)
    outward = surface_normal(scene, primitive, point)
    entering = dot(direction, outward) < 0.0
    normal = outward
    if outward[1] < 0.0:
        normal = negate(outward)
    return point, normal, entering


@fault("REFR-1", "surface_at", "How can a ray tell that it is inside of the glass?")
def every_ray_enters(
    scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int
) -> tuple[Vector, Vector, bool]:
    """Rays that leave the glass are taken to enter it once more."""
    point = along(origin, direction, distance)
    outward = surface_normal(scene, primitive, point)
    normal = outward if dot(direction, outward) < 0.0 else negate(outward)
    return point, normal, True
