"""Faults that take nearly for exactly: thresholds where docs/spec.md knows none."""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.features import INVERSE_SQUARE_FALLOFF, POLYNOMIAL_FALLOFF, SPHERES, TRIANGLES
from raytruth.reference_tracer.source.illumination import INVERSE_SQUARE, POLYNOMIAL
from raytruth.reference_tracer.source.scene_data import (
    LIGHT_FALLOFF,
    LIGHT_FALLOFF_COEFFICIENTS,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
    integer_of,
    vector_of,
)
from raytruth.reference_tracer.source.traversal import NOTHING, is_occluded, nearest_sphere, nearest_triangle
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import along, cross, dot, scale, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("TRAV-3", "nearest_hit", "When are two distances the same?")
def nearly_as_near_counts_as_equal(
    scene: SceneData, origin: Vector, direction: Vector, left: int
) -> tuple[Scalar, int]:
    """Distances that differ by less than 0.05 count as equal, and then triangles win over spheres."""
    nearest = inf
    hit = NOTHING
    if SPHERES:
        nearest, hit = nearest_sphere(scene, origin, direction, left)
    if TRIANGLES:
        nearest, hit = nearest_triangle(scene, origin, direction, left, nearest + 0.05, hit)
    return nearest, hit


@fault("ILL-9", "attenuation", "At which distance has a light no direction?")
def near_lights_left_out(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """Lights nearer than 1.5 to a surface add nothing to it, so that nothing is divided by zero."""
    if distance_squared < 2.25:
        return 0.0
    if INVERSE_SQUARE_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == INVERSE_SQUARE:
            return 1.0 / distance_squared
    if POLYNOMIAL_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == POLYNOMIAL:
            constant, linear, quadratic = vector_of(scene, LIGHT_FALLOFF_COEFFICIENTS, light)
            divisor = constant + linear * sqrt(distance_squared) + quadratic * distance_squared
            if divisor > 1.0:
                return 1.0 / divisor
    return 1.0


@fault("SHAD-6", "is_shadowed", "At which t does a shadow ray begin?")
def shadow_ray_begins_behind_the_surface(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Shadow rays begin a little before t = 0, so that what lies in the same place or just behind throws a shadow."""
    origin = along(point, to_light, -0.02)
    if light_is_near:
        return is_occluded(scene, origin, scale(to_light, 1.02), primitive, 1.0)
    return is_occluded(scene, origin, to_light, primitive, inf)


@fault("NUM-1", "distance_to_triangle", "Which triangles have no area?")
def small_triangles_dropped(scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int) -> Scalar:
    """Triangles whose area is less than 0.01 are dropped, as if they had none."""
    if triangle == left:
        return inf
    a, b, c = (
        vector_of(scene, TRIANGLE_A, triangle),
        vector_of(scene, TRIANGLE_B, triangle),
        vector_of(scene, TRIANGLE_C, triangle),
    )
    across = cross(subtract(b, a), subtract(c, a))
    if dot(across, across) < 4e-4:
        return inf
    return triangle_distance(origin, direction, a, b, c)
