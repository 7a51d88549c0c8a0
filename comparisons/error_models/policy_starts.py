"""Where rays start whose renderer has policies of its own, and where they go: source of the tracer."""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.helpers import largest_magnitude
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.shadow import shadow_ray_end
from raytruth.reference_tracer.source.traversal import is_occluded
from raytruth.reference_tracer.source.vector import add, along, dot, negate, normalize, scale, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.ray_tree import Ray
    from raytruth.reference_tracer.source.scene_data import SceneData

as_traced: Callable[[Vector], Vector] = normalize
"""Or `as_it_is`."""

length_of_offset: list[Scalar] = []
"""For each kind of ray, as all lists here but one."""
relative_length_of_offset: list[Scalar] = []
"""Times max|p|."""
error_bounds_of_offset: list[Scalar] = []
"""From 0 to so many times the terms that a point on the primitive is computed from."""
terms_of_points: list[Scalar] = []
"""Those, for each primitive; projected onto its normal."""
moves_by_units: list[Scalar] = []
"""1 where each coordinate is moved by units in the last place, else 0."""
moves_along_ray: list[Scalar] = []
"""1 where rays start farther along themselves, 0 where along the normal."""
aims_at_light: Scalar = 1.0
"""1 where shadow rays go from their start to the light, 0 where in the direction from the point; or in between."""
units_small: Scalar = 0.0
"""How far a coordinate near 0 is moved for a normal along its axis."""
units_large: Scalar = 0.0
"""The same for others, as a part of the coordinate."""
unit_lost: Scalar = 0.0
"""Of a coordinate, what is lost since only whole units are moved."""
some_of_it: Scalar = 0.0
"""Between 0 and 1: how much of a bound a start is moved by."""
normalises: Scalar = 0.0
"""1 where directions are made unit vectors once more before they are traced."""


def as_it_is(direction: Vector) -> Vector:
    """The direction, unchanged."""
    return direction


def offset_of(kind: int, primitive: int, point: Vector) -> Scalar:
    """How far a ray of this kind starts from a point of a surface, but for who moves it by units in the last place."""
    farthest = largest_magnitude(point[0], point[1], point[2])
    bound = error_bounds_of_offset[kind] * terms_of_points[primitive] * some_of_it
    return length_of_offset[kind] + relative_length_of_offset[kind] * farthest + bound


def bound_of(kind: int, primitive: int, point: Vector) -> Scalar:
    """How far it may start from there along the normal, by whatever policy."""
    offset = offset_of(kind, primitive, point)
    if moves_by_units[kind] > 0.5:
        farthest = largest_magnitude(point[0], point[1], point[2])
        return offset + (units_small + units_large * farthest) * some_of_it
    return offset


def start_of(kind: int, primitive: int, point: Vector, normal: Vector, direction: Vector) -> Vector:
    """Where a ray of this kind starts that leaves a point on the side of this normal, in a direction of any length."""
    if moves_by_units[kind] > 0.5:
        x = moved_by_units(point[0], normal[0])
        y = moved_by_units(point[1], normal[1])
        return (x, y, moved_by_units(point[2], normal[2]))
    offset = offset_of(kind, primitive, point)
    if moves_along_ray[kind] > 0.5:
        return along(point, direction, offset / sqrt(dot(direction, direction)))  # to a light it may have any length
    return along(point, normal, offset)


def moved_by_units(coordinate: Scalar, part: Scalar) -> Scalar:
    """A coordinate that is moved by units in the last place, as many as this part of a unit normal says."""
    size = abs(coordinate)
    if certainly_less(size, 0.03125):
        return coordinate + part * units_small
    by_units = part * units_large * size + unit_lost * size
    if certainly_less(0.03125, size):
        return coordinate + by_units
    return coordinate + part * units_small * some_of_it + by_units * some_of_it


def reflected_ray_by_policy(
    primitive: int, point: Vector, normal: Vector, direction: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """As `reflected_ray`, from where this kind starts."""
    mirrored = as_traced(mirror_direction(direction, normal))
    start = start_of(1, primitive, point, normal, mirrored)
    return start, mirrored, weight, primitive + primitive + primitive + primitive + 1, medium, depth - 1


def transmitted_ray_by_policy(
    primitive: int, point: Vector, normal: Vector, refracted: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """As `transmitted_ray`, from where this kind starts."""
    onward = as_traced(refracted)
    start = start_of(2, primitive, point, negate(normal), onward)
    return start, onward, weight, primitive + primitive + primitive + primitive + 2, medium, depth - 1


def is_shadowed_by_policy(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """As `is_shadowed`, from where this kind starts, towards the light or as from the point itself."""
    start = start_of(0, primitive, point, normal, to_light)
    left = primitive + primitive + primitive + primitive
    if light_is_near:
        from_start = subtract(add(point, to_light), start)
        direction = along(to_light, subtract(from_start, to_light), aims_at_light)
        if normalises > 0.5:
            length = sqrt(dot(direction, direction))
            return is_occluded(scene, start, scale(direction, 1.0 / length), left, length * shadow_ray_end())
        return is_occluded(scene, start, direction, left, shadow_ray_end())
    return is_occluded(scene, start, as_traced(to_light), left, inf)
