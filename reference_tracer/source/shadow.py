"""Shadow rays (docs/spec.md, SHAD)."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.traversal import is_occluded
from raytruth.reference_tracer.source.vector import add, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


def departure(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:  # noqa: ARG001 - a ray offset needs them
    """Where a ray starts that leaves a surface to the side of `normal`, and the primitive that it has left.

    `direction` is the ray's, of any length.

    Ideal geometry: on the surface itself. A renderer with a ray offset starts beside it, as its error model says.
    """
    return point, primitive


def shadow_ray_end() -> Scalar:
    """At which fraction of the light's distance a shadow ray ends. A renderer may stop earlier."""
    return 1.0


def is_shadowed(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Whether anything stands between the point and the light; nothing behind a near light can."""
    origin, left = departure(primitive, point, normal, to_light)
    if light_is_near:
        # The unnormalised direction reaches the light at t = 1, with no square root and no rounding of the distance.
        return is_occluded(scene, origin, subtract(add(point, to_light), origin), left, shadow_ray_end())
    return is_occluded(scene, origin, to_light, left, inf)
