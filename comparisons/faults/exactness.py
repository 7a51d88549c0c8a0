"""Faults that take nearly for exactly: thresholds where docs/spec.md knows none."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit, at_the_start
from raytruth.reference_tracer.source.traversal import is_occluded
from raytruth.reference_tracer.source.vector import along, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault(
    "TRAV-3",
    "nearest_hit",
    "When are two distances the same?",
    Edit(
        "nearest_triangle(scene, origin, direction, left, nearest, hit)",
        "nearest_triangle(scene, origin, direction, left, nearest + 0.05, hit)",
    ),
)
def nearly_as_near_counts_as_equal() -> None:
    """Distances that differ by less than 0.05 count as equal, and then triangles win over spheres."""


@fault(
    "ILL-9",
    "attenuation",
    "From how near does a light still light a surface?",
    at_the_start("""
        if distance_squared < 2.25:
            return 0.0
        """),
)
def near_lights_left_out() -> None:
    """Lights nearer than 1.5 to a surface add nothing to it, so that nothing is divided by zero."""


@fault("SHAD-6", "is_shadowed", "At which t does a shadow ray begin?")
def shadow_ray_begins_behind_the_surface(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Shadow rays begin a little before t = 0, so that what lies in the same place or just behind throws a shadow."""
    origin = along(point, to_light, -0.02)
    if light_is_near:
        return is_occluded(scene, origin, scale(to_light, 1.02), primitive, 1.0)
    return is_occluded(scene, origin, to_light, primitive, inf)


@fault(
    "NUM-1",
    "distance_to_triangle",
    "Which triangles have no area?",
    at_the_start("""
        a = vector_of(scene, TRIANGLE_A, triangle)
        b = vector_of(scene, TRIANGLE_B, triangle)
        c = vector_of(scene, TRIANGLE_C, triangle)
        across = cross(subtract(b, a), subtract(c, a))
        if dot(across, across) < 4e-4:
            return inf
        """),
)
def small_triangles_dropped() -> None:
    """Triangles whose area is less than 0.01 are dropped, as if they had none."""
