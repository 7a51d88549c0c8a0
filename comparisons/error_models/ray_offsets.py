"""How a renderer with ray offsets leaves a surface, in place of the ideal way.

The ideal tracer starts on the surface and excludes the surface itself. Most renderers start beside it, or ignore what
is hit very near. Where that is done far above all rounding, the surface stays excluded; what changes is where the ray
starts, and how far the other side of a sphere is from there. Elsewhere the surface is tested as all others are, so
that rounding may let a ray meet the very point that it leaves, as it may in such a renderer.

The functions here are source of the tracer, in place of its own functions. So they run in every number type. What is
declared beside them for their sake are constants, whose values are given by `offset_behaviour`.
"""

from __future__ import annotations

import sys
from math import inf, isfinite, sqrt
from typing import TYPE_CHECKING

from flint import arb

from raytruth.comparisons.error_models.helpers import corners_of, largest_magnitude
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.features import PLANES, SPHERES, TRIANGLES
from raytruth.reference_tracer.source.plane import plane_distance
from raytruth.reference_tracer.source.scene_data import (
    PLANE_NORMAL,
    PLANE_POINT,
    SPHERE_CENTER,
    SPHERE_RADIUS,
    number_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import departure
from raytruth.reference_tracer.source.sphere import distance_to_other_side, sphere_distance
from raytruth.reference_tracer.source.traversal import (
    NOTHING,
    is_occluded,
    nearest_plane,
    nearest_sphere,
    nearest_triangle,
)
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import add, along, dot, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

absolute_offset: Scalar = 0.0
relative_offset: Scalar = 0.0
"""Times max|p|."""
about_one: Scalar = 1.0
"""Between 1 - ε and 1 + ε, where ε is the relative offset."""
minimum_distance: Scalar = 0.0
shadow_shortening: Scalar = 0.0
"""The fraction of the light's distance that a shadow ray ends before the light."""
shadow_tolerance: Scalar = 0.0
"""What is nearer than this to a shadow ray's start or end may be ignored, or not."""
farthest_met: Scalar = 0.0
"""What is farther than this from where a ray starts may be met or not, in a scene with infinite planes."""
either_sign: Scalar = 0.0
"""Between -1 and 1: a comparison with 0 goes both ways."""


def offset_behaviour(error_model: ErrorModel) -> Behaviour:
    """What this renderer's offsets change, but for one that is a bound (bounded_offsets.py); to be merged with HELPERS.

    The constants are balls that hold what the renderer stores.
    """
    offset, bits = error_model.ray_offset, error_model.precision_bits
    functions = {} if error_model.needs_policies else _starts_and_tests(error_model)  # else ray_policies.py has them
    if error_model.shadow_shortening > 0.0:
        functions["shadow_ray_end"] = early_shadow_ray_end
    if isfinite(error_model.farthest):
        functions["nearest_hit"] = nearest_hit_within_reach
    if error_model.shadow_tolerance > 0.0:
        functions["is_shadowed"] = is_shadowed_within_tolerance
    constants = {
        "absolute_offset": stored_number(offset.absolute, bits),
        "relative_offset": stored_number(offset.relative, bits),
        "about_one": arb(1, offset.relative),
        "minimum_distance": stored_number(offset.minimum_distance, bits),
        "shadow_shortening": stored_number(error_model.shadow_shortening, bits),
        "shadow_tolerance": stored_number(error_model.shadow_tolerance, bits),
        "either_sign": arb(0, 1),
    }
    if "nearest_hit" in functions or "is_shadowed" in functions:
        constants["farthest_met"] = arb(min(error_model.farthest, sys.float_info.max))  # not infinite: it is divided
    return Behaviour(functions, (offset_length, comes_back), constants, "ray offsets")


def _starts_and_tests(error_model: ErrorModel) -> dict[str, Function]:
    """Where rays start, and what that makes of the tests of what they have left."""
    offset = error_model.ray_offset
    functions: dict[str, Function] = {}
    if offset.moves_rays and not offset.is_bound:
        functions["departure"] = departure_along_normal if offset.along == "normal" else departure_along_ray
    if not offset.excludes_surface:
        functions["distance_to_sphere"] = distance_to_any_sphere
        functions["distance_to_triangle"] = distance_to_any_triangle
        functions["distance_to_plane"] = distance_to_any_plane
    elif offset.moves_rays and not offset.is_bound:
        functions["distance_to_other_side"] = distance_to_other_side_from_offset
        if error_model.sphere_test == "accurate":  # others say themselves when they test a sphere again
            functions["distance_to_sphere"] = distance_to_sphere_from_offset
    return functions


def offset_length(point: Vector) -> Scalar:
    """How far beside a point of a surface a ray starts."""
    return absolute_offset + relative_offset * largest_magnitude(point[0], point[1], point[2])


def comes_back(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> bool:
    """Whether a ray surely starts outside a sphere and goes nearer to its centre."""
    from_center = subtract(origin, center)
    outside = certainly_less(radius * radius, dot(from_center, from_center))
    return outside and certainly_less(dot(direction, from_center), 0.0)


def departure_along_normal(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:  # noqa: ARG001 - the signature of the function it stands for
    """Beside the surface, on the side that the ray goes to."""
    return along(point, normal, offset_length(point)), primitive


def departure_along_ray(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:  # noqa: ARG001 - as above
    """A little way along the ray."""
    return along(point, direction, offset_length(point) / sqrt(dot(direction, direction))), primitive


def distance_to_sphere_from_offset(
    scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int
) -> Scalar:
    """Of the sphere that it has left, the other side; but as of any sphere for who comes back to it from outside.

    Who starts beside a sphere sees a near light in another direction than from its surface, and may see the sphere
    itself before it.
    """
    center = vector_of(scene, SPHERE_CENTER, sphere)
    radius = number_of(scene, SPHERE_RADIUS, sphere)
    if sphere == left and not comes_back(origin, direction, center, radius):
        return distance_to_other_side(origin, direction, center)
    return sphere_distance(origin, direction, center, radius)


def distance_to_other_side_from_offset(origin: Vector, direction: Vector, center: Vector) -> Scalar:
    """From a point that lies an offset δ inside the sphere, |o-c| = r - δ: the positive root of the quadratic.

    Its constant term |o-c|² - r² = -2|o-c|δ - δ² is taken from δ: as a difference it would be lost to rounding.
    δ is computed at the moved origin, whose coordinates differ from the point's by up to δ, so that what is found
    there is between 1 - ε and 1 + ε times δ, where ε is the relative offset.
    """
    from_center = subtract(origin, center)
    half_linear = dot(direction, from_center)
    if half_linear >= 0.0:
        return inf
    offset = offset_length(origin) / about_one
    direction_squared = dot(direction, direction)
    product = (2.0 * sqrt(dot(from_center, from_center)) + offset) * offset
    return (sqrt(half_linear * half_linear + direction_squared * product) - half_linear) / direction_squared


def distance_to_any_sphere(scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int) -> Scalar:  # noqa: ARG001 - as above
    """To the nearest of both roots that is not too near, also of the sphere that the ray starts on."""
    skipped = minimum_distance / sqrt(dot(direction, direction))
    start = along(origin, direction, skipped)
    center = vector_of(scene, SPHERE_CENTER, sphere)
    distance = sphere_distance(start, direction, center, number_of(scene, SPHERE_RADIUS, sphere))
    if distance < inf:
        return skipped + distance
    return inf


def distance_to_any_triangle(scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int) -> Scalar:  # noqa: ARG001 - as above
    """To the triangle if it is not too near, also if the ray starts on it."""
    skipped = minimum_distance / sqrt(dot(direction, direction))
    a, b, c = corners_of(scene, triangle)
    distance = triangle_distance(along(origin, direction, skipped), direction, a, b, c)
    if distance < inf:
        return skipped + distance
    return inf


def distance_to_any_plane(scene: SceneData, origin: Vector, direction: Vector, left: int, plane: int) -> Scalar:  # noqa: ARG001 - as above
    """To the plane if it is not too near, also if the ray starts on it."""
    skipped = minimum_distance / sqrt(dot(direction, direction))
    point, normal = vector_of(scene, PLANE_POINT, plane), vector_of(scene, PLANE_NORMAL, plane)
    distance = plane_distance(along(origin, direction, skipped), direction, point, normal)
    if distance < inf:
        return skipped + distance
    return inf


def nearest_hit_within_reach(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """The nearest primitive; where there are planes, it or nothing if that is too far away."""
    nearest = inf
    hit = NOTHING
    if SPHERES:
        nearest, hit = nearest_sphere(scene, origin, direction, left)
    if TRIANGLES:
        nearest, hit = nearest_triangle(scene, origin, direction, left, nearest, hit)
    if PLANES:
        nearest, hit = nearest_plane(scene, origin, direction, left, nearest, hit)
        if hit != NOTHING and nearest * sqrt(dot(direction, direction)) > farthest_met and either_sign > 0.0:
            return inf, NOTHING
    return nearest, hit


def early_shadow_ray_end() -> Scalar:
    """Before the light."""
    return 1.0 - shadow_shortening


def is_shadowed_within_tolerance(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Either way where only something very near to the point or to the light, or very far, may throw a shadow."""
    origin, left = departure(primitive, point, normal, to_light)
    skipped = (shadow_tolerance - minimum_distance) / sqrt(dot(to_light, to_light))
    later = along(origin, to_light, skipped)
    reach = inf
    if PLANES:
        reach = farthest_met / sqrt(dot(to_light, to_light))
    if light_is_near:
        direction = subtract(add(point, to_light), origin)
        longest = is_occluded(scene, origin, direction, left, 1.0)
        end = 1.0 - shadow_tolerance / sqrt(dot(to_light, to_light)) - skipped
        # From the later start the way is shorter, but the direction has the same length.
        if PLANES:
            end = min(end, reach)
        shortest = is_occluded(scene, later, direction, left, end)
    else:
        longest = is_occluded(scene, origin, to_light, left, inf)
        shortest = is_occluded(scene, later, to_light, left, reach)
    if longest and not shortest:
        return either_sign > 0.0
    return longest
