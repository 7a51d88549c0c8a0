"""What rays meet whose renderer has policies of its own: source of the tracer."""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.helpers import corners_of, largest_magnitude
from raytruth.comparisons.error_models.policy_starts import bound_of, moves_along_ray, relative_length_of_offset
from raytruth.comparisons.error_models.ray_offsets import comes_back
from raytruth.comparisons.error_models.sphere_formulas import either_way, quadratic_roots, squared_length
from raytruth.comparisons.error_models.triangle_formulas import plain_root
from raytruth.reference_tracer.source.plane import plane_distance
from raytruth.reference_tracer.source.scene_data import (
    PLANE_NORMAL,
    PLANE_POINT,
    SPHERE_CENTER,
    SPHERE_MATERIAL,
    SPHERE_RADIUS,
    first_plane,
    number_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.vector import dot, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

sphere_roots: Callable[[Vector, Vector, Vector, Scalar], tuple[Scalar, Scalar]] = quadratic_roots
"""The formula of sphere_formulas.py that is declared."""
triangle_root: Callable[[Vector, Vector, Vector, Vector, Vector], Scalar] = plain_root
"""The formula of triangle_formulas.py."""

leaves_surface_out: list[Scalar] = []
"""1 where the primitive that a ray leaves is known by its number, 0 where it is tested as all others are."""
least_of_hits: list[Scalar] = []
relative_least_of_hits: list[Scalar] = []
"""Times max|o|, o being where the ray starts."""
least_is_a_length: Scalar = 1.0
"""1 where least distances are lengths, 0 where they are compared with t in units of the direction's own length."""


def least_distance(kind: int, origin: Vector, direction: Vector) -> Scalar:
    """Hits at this t and nearer are none for a ray of this kind."""
    farthest = largest_magnitude(origin[0], origin[1], origin[2])
    least = least_of_hits[kind] + relative_least_of_hits[kind] * farthest
    if least_is_a_length > 0.5:
        return least / sqrt(squared_length(direction))
    return least


def distance_to_sphere_by_policy(scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int) -> Scalar:
    """To the nearer root that is beyond the least distance; of a sphere that is left out, to its other side."""
    kind = left % 4
    center = vector_of(scene, SPHERE_CENTER, sphere)
    radius = number_of(scene, SPHERE_RADIUS, sphere)
    least = least_distance(kind, origin, direction)
    if left // 4 == sphere and leaves_surface_out[kind] > 0.5:
        distance = other_side(kind, sphere, origin, direction, center, radius)
        return distance if distance > least else inf
    nearer, farther = sphere_roots(origin, direction, center, radius)
    if nearer > least:
        return nearer
    if farther > least:
        return farther
    return inf


def other_side(kind: int, sphere: int, origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """From beside the surface to the other root of the sphere, by the formula of ray_offsets.py.

    There |o - c| is the radius less the offset; of a start that is moved along the ray both roots have moved. Who
    starts beside the sphere and comes back to it from outside meets it as any other.
    """
    if moves_along_ray[kind] < 0.5 and comes_back(origin, direction, center, radius):
        nearer, _ = sphere_roots(origin, direction, center, radius)
        return nearer
    from_center = subtract(origin, center)
    half_linear = dot(direction, from_center)
    if half_linear >= 0.0:
        return inf
    direction_squared = squared_length(direction)
    # The offset is found at the moved start; twice the offset's own share covers how much that differs.
    offset = bound_of(kind, sphere, origin) * (1.0 + 2.0 * relative_length_of_offset[kind] * either_way)
    if moves_along_ray[kind] > 0.5:
        return offset / sqrt(direction_squared) - 2.0 * half_linear / direction_squared
    product = (2.0 * sqrt(dot(from_center, from_center)) + offset) * offset
    return (sqrt(half_linear * half_linear + direction_squared * product) - half_linear) / direction_squared


def distance_to_triangle_by_policy(
    scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int
) -> Scalar:
    """To the triangle if it is beyond the least distance and not left out."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    both = left + spheres  # the traversal counts triangles from the last sphere
    kind = both % 4
    if both // 4 - spheres == triangle and leaves_surface_out[kind] > 0.5:
        return inf
    a, b, c = corners_of(scene, triangle)
    distance = triangle_root(origin, direction, a, b, c)
    if distance > least_distance(kind, origin, direction):
        return distance
    return inf


def distance_to_plane_by_policy(scene: SceneData, origin: Vector, direction: Vector, left: int, plane: int) -> Scalar:
    """As distance_to_triangle_by_policy, of an infinite plane."""
    both = left + first_plane(scene)
    kind = both % 4
    if both // 4 - first_plane(scene) == plane and leaves_surface_out[kind] > 0.5:
        return inf
    point, normal = vector_of(scene, PLANE_POINT, plane), vector_of(scene, PLANE_NORMAL, plane)
    distance = plane_distance(origin, direction, point, normal)
    if distance > least_distance(kind, origin, direction):
        return distance
    return inf
