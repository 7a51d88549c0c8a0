"""How people's own tracers let rays leave a surface, and which hits they leave out: apart for each kind of ray.

A ray is reflected, refracted, goes to a light, or comes from the camera. The tracer knows of a ray only which primitive
it has left. So in this behaviour that number tells the kind, too: it is 4·primitive + kind, and -1, the camera's, is
of the last kind by itself. The functions here are source of the tracer, as those of ray_offsets.py, in place of which
they stand where a renderer declares what those do not know: one of the formulas of sphere_formulas.py, policies that
differ between kinds of rays, or a start that is only bounded.

What is hit is compared with the least distance as the program does that: first the formula, then the comparison.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.comparisons.error_models.helpers import corners_of, largest_magnitude, under_name
from raytruth.comparisons.error_models.ray_offsets import comes_back
from raytruth.comparisons.error_models.sphere_formulas import (
    either_way,
    quadratic_roots,
    sphere_formula_behaviour,
    squared_length,
)
from raytruth.comparisons.error_models.start_bounds import ULP_STEPS, largest_terms, scale_of
from raytruth.comparisons.error_models.triangle_formulas import plain_root, triangle_formula_behaviour
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour, merged
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.scene_data import (
    SPHERE_CENTER,
    SPHERE_MATERIAL,
    SPHERE_RADIUS,
    number_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import shadow_ray_end
from raytruth.reference_tracer.source.traversal import is_occluded
from raytruth.reference_tracer.source.vector import add, along, dot, negate, normalize, scale, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel, RayOffset
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.ray_tree import Ray
    from raytruth.reference_tracer.source.scene_data import SceneData
    from raytruth.scenes.scene import Scene


# The kinds: 0 of shadow rays, 1 of reflected ones, 2 of refracted ones, 3 of the camera's.

sphere_roots: Any = quadratic_roots
"""The formula of sphere_formulas.py that is declared."""
triangle_root: Any = plain_root
"""The formula of triangle_formulas.py."""
as_traced: Any = normalize
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
leaves_surface_out: list[Scalar] = []
"""1 where the primitive that a ray leaves is known by its number, 0 where it is tested as all others are."""
least_of_hits: list[Scalar] = []
relative_least_of_hits: list[Scalar] = []
"""Times max|o|, o being where the ray starts."""
least_is_a_length: Scalar = 1.0
"""1 where least distances are lengths, 0 where they are compared with t in units of the direction's own length."""
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


def ray_policy_behaviour(error_model: ErrorModel, scene: Scene) -> Behaviour:
    """All that this renderer's rays do otherwise, or nothing if ray_offsets.py tells it.

    To be merged with HELPERS and `offset_behaviour`. The constants are balls that hold what the renderer stores.
    """
    if not error_model.needs_policies:
        return IDEAL
    bits = error_model.precision_bits
    offsets = error_model.offsets()
    stored = [_stored(offset, scene, bits) for offset in offsets]
    lists = {name: [values[name] for values in stored] for name in stored[0]}
    normalised = error_model.directions == "normalised"
    aims = {"light": arb(1), "parallel": arb(0), "either": arb(0.5, 0.5)}
    itself = Behaviour(
        {
            "reflected_ray": reflected_ray_by_policy,
            "transmitted_ray": transmitted_ray_by_policy,
            "is_shadowed": is_shadowed_by_policy,
            "distance_to_sphere": distance_to_sphere_by_policy,
            "distance_to_triangle": distance_to_triangle_by_policy,
        },
        (
            *(start_of, moved_by_units, offset_of, bound_of, least_distance, other_side),
            under_name("as_traced", normalize if normalised else as_it_is),
        ),
        {
            **lists,
            "terms_of_points": [arb(terms) for terms in largest_terms(scene)],
            "least_is_a_length": arb(0 if error_model.directions == "unnormalised" else 1),
            "aims_at_light": aims[error_model.shadow_aim],
            "some_of_it": arb(0.5, 0.5),
            "normalises": arb(1 if normalised else 0),
            **ULP_STEPS,
        },
        "ray policies",
    )
    return merged(itself, sphere_formula_behaviour(error_model), triangle_formula_behaviour(error_model))


def _stored(offset: RayOffset, scene: Scene, bits: int) -> dict[str, Any]:
    """The numbers of one kind of ray. Of a scene's scale each is the product, which is rounded like all else."""
    of_scene = offset.scale == "scene"
    relative = 0.0 if of_scene else offset.relative
    relative_least = 0.0 if of_scene else offset.relative_minimum_distance
    scene_scale = scale_of(scene, bits) if of_scene else arb(0)
    return {
        "length_of_offset": stored_number(offset.absolute, bits) + offset.relative * scene_scale,
        "relative_length_of_offset": stored_number(relative, bits),
        "error_bounds_of_offset": arb(offset.error_bound * 2.0**-bits),
        "moves_by_units": arb(1 if offset.in_units else 0),
        "moves_along_ray": arb(1 if offset.along == "direction" else 0),
        "leaves_surface_out": arb(1 if offset.excludes_surface else 0),
        "least_of_hits": stored_number(offset.minimum_distance, bits) + offset.relative_minimum_distance * scene_scale,
        "relative_least_of_hits": stored_number(relative_least, bits),
    }


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


def least_distance(kind: int, origin: Vector, direction: Vector) -> Scalar:
    """Hits at this t and nearer are none for a ray of this kind."""
    farthest = largest_magnitude(origin[0], origin[1], origin[2])
    least = least_of_hits[kind] + relative_least_of_hits[kind] * farthest
    if least_is_a_length > 0.5:
        return least / sqrt(squared_length(direction))
    return least


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
