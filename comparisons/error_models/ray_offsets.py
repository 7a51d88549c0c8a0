"""How a renderer with ray offsets leaves a surface, in place of the ideal way.

The ideal tracer starts on the surface and excludes the surface itself. Most renderers start beside it, or ignore what
is hit very near. Where that is done far above all rounding, the surface stays excluded; what changes is where the ray
starts, and how far the other side of a sphere is from there. Elsewhere the surface is tested as all others are, so
that rounding may let a ray meet the very point that it leaves, as it may in such a renderer.

The functions here are overrides: source of the tracer, in place of its own functions. So they run in every number type.
The constants are given by the kernel's arithmetic (`offset_constants`).
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.comparisons.error_models.bounded_offsets import departure_within_bound, is_shadowed_from_within_bound
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.scene_data import (
    SPHERE_CENTER,
    SPHERE_RADIUS,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
    number_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import departure
from raytruth.reference_tracer.source.sphere import distance_to_other_side, sphere_distance
from raytruth.reference_tracer.source.traversal import is_occluded
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import add, along, dot, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.comparisons.error_models.error_model import ErrorModel
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
either_sign: Scalar = 0.0
"""Between -1 and 1: a comparison with 0 goes both ways."""


def offset_overrides(error_model: ErrorModel) -> dict[str, Callable[..., Any]]:
    """The functions of the tracer's source that this renderer's offsets change."""
    offset = error_model.ray_offset
    overrides: dict[str, Callable[..., Any]] = {}
    if offset.is_bound:
        overrides["departure"] = departure_within_bound
        overrides["is_shadowed"] = is_shadowed_from_within_bound
    elif offset.moves_rays:
        overrides["departure"] = departure_along_normal if offset.along == "normal" else departure_along_ray
    if not offset.excludes_surface:
        overrides["distance_to_sphere"] = distance_to_any_sphere
        overrides["distance_to_triangle"] = distance_to_any_triangle
    elif offset.moves_rays and not offset.is_bound:
        overrides["distance_to_sphere"] = distance_to_sphere_from_offset
        overrides["distance_to_other_side"] = distance_to_other_side_from_offset
    if error_model.shadow_shortening > 0.0:
        overrides["shadow_ray_end"] = early_shadow_ray_end
    if error_model.shadow_tolerance > 0.0:
        overrides["is_shadowed"] = is_shadowed_within_tolerance
    return overrides


def offset_constants(error_model: ErrorModel) -> dict[str, Any]:
    """The constants of the overrides by name, as balls that hold what the renderer stores."""
    offset, bits = error_model.ray_offset, error_model.precision_bits
    return {
        "absolute_offset": stored_number(offset.absolute, bits),
        "relative_offset": stored_number(offset.relative, bits),
        "about_one": arb(1, offset.relative),
        "anywhere_x": arb(0, 1),
        "anywhere_y": arb(0, 1),
        "anywhere_z": arb(0, 1),
        "minimum_distance": stored_number(offset.minimum_distance, bits),
        "shadow_shortening": stored_number(error_model.shadow_shortening, bits),
        "shadow_tolerance": stored_number(error_model.shadow_tolerance, bits),
        "either_sign": arb(0, 1),
    }


def departure_along_normal(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:  # noqa: ARG001 - the signature of the function it stands for
    """Beside the surface, on the side that the ray goes to."""
    largest = max(max(abs(point[0]), abs(point[1])), abs(point[2]))  # noqa: PLW3301 - balls have a maximum of two
    return along(point, normal, absolute_offset + relative_offset * largest), primitive


def departure_along_ray(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:  # noqa: ARG001 - as above
    """A little way along the ray."""
    largest = max(max(abs(point[0]), abs(point[1])), abs(point[2]))  # noqa: PLW3301 - balls have a maximum of two
    offset = absolute_offset + relative_offset * largest
    return along(point, direction, offset / sqrt(dot(direction, direction))), primitive


def distance_to_sphere_from_offset(
    scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int
) -> Scalar:
    """Of the sphere that it has left, the other side; but as of any sphere for who comes back to it from outside.

    Who starts beside a sphere sees a near light in another direction than from its surface, and may see the sphere
    itself before it.
    """
    center = vector_of(scene, SPHERE_CENTER, sphere)
    radius = number_of(scene, SPHERE_RADIUS, sphere)
    if sphere == left:
        from_center = subtract(origin, center)
        outside = certainly_less(radius * radius, dot(from_center, from_center))
        if not (outside and certainly_less(dot(direction, from_center), 0.0)):
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
    largest = max(max(abs(origin[0]), abs(origin[1])), abs(origin[2]))  # noqa: PLW3301 - balls have a maximum of two
    offset = (absolute_offset + relative_offset * largest) / about_one
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
    distance = triangle_distance(
        along(origin, direction, skipped),
        direction,
        vector_of(scene, TRIANGLE_A, triangle),
        vector_of(scene, TRIANGLE_B, triangle),
        vector_of(scene, TRIANGLE_C, triangle),
    )
    if distance < inf:
        return skipped + distance
    return inf


def early_shadow_ray_end() -> Scalar:
    """Before the light."""
    return 1.0 - shadow_shortening


def is_shadowed_within_tolerance(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Either way where only something very near to the point or to the light may throw a shadow."""
    origin, left = departure(primitive, point, normal, to_light)
    skipped = (shadow_tolerance - minimum_distance) / sqrt(dot(to_light, to_light))
    later = along(origin, to_light, skipped)
    if light_is_near:
        direction = subtract(add(point, to_light), origin)
        longest = is_occluded(scene, origin, direction, left, 1.0)
        end = 1.0 - shadow_tolerance / sqrt(dot(to_light, to_light)) - skipped
        # From the later start the way is shorter, but the direction has the same length.
        shortest = is_occluded(scene, later, direction, left, end)
    else:
        longest = is_occluded(scene, origin, to_light, left, inf)
        shortest = is_occluded(scene, later, to_light, left, inf)
    if longest and not shortest:
        return either_sign > 0.0
    return longest
