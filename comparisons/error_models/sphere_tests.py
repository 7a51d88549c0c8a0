"""How a renderer may test rays against spheres, in place of the formulas of the truth.

The formulas are equal in exact arithmetic. Far from the origin, and on large spheres, what rounding does to each is
not. Mitsuba 3.9.1 has two (src/shapes/sphere.cpp): for the nearest hit one from the ray's foot (lines 522-583), whether
anything is hit by the textbook's quadratic (lines 585-625). Both are solved by solve_quadratic (include/mitsuba/core/
math.h lines 359-402), which takes one root from the other by their product. The functions here are overrides, as in
triangle_tests.py.
"""

from __future__ import annotations

from math import dist, inf, sqrt
from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.features import SPHERES, TRIANGLES
from raytruth.reference_tracer.source.scene_data import (
    SPHERE_CENTER,
    SPHERE_RADIUS,
    number_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.sphere import distance_to_other_side, sphere_distance
from raytruth.reference_tracer.source.traversal import NOTHING, nearest_triangle
from raytruth.reference_tracer.source.vector import along, dot, subtract
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData
    from raytruth.scenes.scene import Scene

absolute_offset: Scalar = 0.0
"""As in ray_offsets.py."""
relative_offset: Scalar = 0.0
surface_slack: Scalar = 0.0
"""Of a radius and a largest coordinate: no offset above it is lost to what rounding does to either formula."""
put_back_slack: Scalar = 0.0
"""The same for a test in float64."""
reach_slack: Scalar = 0.0
"""What is lost besides of an offset from a point that was found along the longest ray."""

# A ray that starts δ above a sphere of radius r surely does not meet it again if δ is above what rounding may shift the
# roots by. With u the roundoff and m the largest coordinate of its start: the foot, and the vector from the centre to
# it, are off by e = u·(1.8·m + 3.8·r), its square less r² by D = 5·u·r² + 2·r·e; the roots move by e + D/(2·h) + 3·u·r,
# where h is half the chord. Far from a tangent the farther root lies δ·r/h behind the start, so that
# δ > D/r + 2·e + 6·u·r = u·(26.2·r + 7.2·m) suffices; at a tangent 2·r·δ > D does. The textbook's constant |o-c|² - r²
# is off by less than D. And the start may be beside where it should be, by what is counted next.
SURFACE_ROUNDOFFS = 36
# A point that was put back on the sphere: its unit normal is off by 5·u (its square by 3, the root and the product),
# times r by one more, and the sums with the centre and with the offset round m: u·(6·r + 2·√3·m).
PUT_BACK_ROUNDOFFS = 6
# A point along a ray of length t: besides e + D/(2·r) + 3·u·r for the root, the sum of root and foot, and its product
# with the direction, are rounded: u·(9.3·r + 3.6·m + 2·t).
ALONG_ROUNDOFFS = 2


def sphere_test_overrides(error_model: ErrorModel) -> dict[str, Callable[..., Any]]:
    """The functions of the tracer's source that this renderer's tests replace; nothing for the truth's own test."""
    if error_model.sphere_test == "accurate":
        return {}
    overrides: dict[str, Callable[..., Any]] = {
        "distance_to_sphere": distance_to_sphere_from_foot,
    }
    if error_model.sphere_test == "from the foot, accurate for shadows":
        return {**overrides, "is_occluded": is_occluded_by_accurate_spheres}
    return {**overrides, "is_occluded": is_occluded_by_textbook_spheres}


def sphere_test_constants(error_model: ErrorModel, scene: Scene) -> dict[str, Any]:
    """The constants of the overrides by name, as balls."""
    roundoff = 2.0**-error_model.precision_bits
    along = 0.0 if error_model.sphere_points == "put back" else ALONG_ROUNDOFFS * _reach(scene)
    return {
        "surface_slack": arb(SURFACE_ROUNDOFFS * roundoff),
        "put_back_slack": arb(PUT_BACK_ROUNDOFFS * roundoff),
        "reach_slack": arb(along * roundoff),
    }


def _reach(scene: Scene) -> float:
    """No ray that meets a sphere is longer: all come from the camera, from a mirror or from glass."""
    spheres = [shape for shape in scene.objects if isinstance(shape, Sphere)]
    starts = [(scene.camera.position, 0.0)]
    for shape in scene.objects:
        material = scene.materials[shape.material]
        if material.mirror or material.dielectric:
            starts += (
                [(shape.center, shape.radius)] if isinstance(shape, Sphere) else [(c, 0.0) for c in shape.vertices]
            )
    return max((dist(start, s.center) + radius + s.radius for s in spheres for start, radius in starts), default=0.0)


def distance_to_sphere_from_foot(scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int) -> Scalar:
    """The ray is moved to its foot, where it is nearest to the centre, and meets the sphere from there.

    The foot's own error is none of the roots', since they are counted from where it came to lie. Of the two ways to
    a root, -B/2 ± √D and one by their product, this is the one that rounding shifts more. A sphere that a ray has left
    is tested as all others are, unless its offset is surely above all rounding.
    """
    center = vector_of(scene, SPHERE_CENTER, sphere)
    radius = number_of(scene, SPHERE_RADIUS, sphere)
    if sphere == left:
        largest = max(max(abs(origin[0]), abs(origin[1])), abs(origin[2]))  # noqa: PLW3301 - balls have a maximum of two
        offset = absolute_offset + relative_offset * largest
        beside = certainly_less(surface_slack * (radius + largest) + reach_slack, offset)
        from_center = subtract(origin, center)
        outside = certainly_less(radius * radius, dot(from_center, from_center))
        if beside and not (outside and certainly_less(dot(direction, from_center), 0.0)):
            return distance_to_other_side(origin, direction, center)
    direction_squared = dot(direction, direction)
    foot = -dot(subtract(origin, center), direction) / direction_squared
    start = subtract(along(origin, direction, foot), center)
    half_linear = dot(start, direction)
    discriminant = half_linear * half_linear - direction_squared * (dot(start, start) - radius * radius)
    if discriminant < 0.0:
        return inf
    half_chord = sqrt(discriminant)
    nearer = foot - (half_linear + half_chord) / direction_squared
    if nearer >= 0.0:
        return nearer
    farther = foot + (half_chord - half_linear) / direction_squared
    if farther >= 0.0:
        return farther
    return inf


def is_occluded_by_accurate_spheres(
    scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar
) -> bool:
    """By the textbook's quadratic, too, but in float64, whose roundings are nothing beside float32's of the ray.

    So it is the truth's own formula, of this ray.
    """
    if SPHERES:
        largest = max(max(abs(origin[0]), abs(origin[1])), abs(origin[2]))  # noqa: PLW3301 - balls have a maximum of two
        offset = absolute_offset + relative_offset * largest
        for sphere in range(rows_of(scene, SPHERE_RADIUS)):
            center = vector_of(scene, SPHERE_CENTER, sphere)
            radius = number_of(scene, SPHERE_RADIUS, sphere)
            from_center = subtract(origin, center)
            beside = sphere == left and certainly_less(put_back_slack * (radius + largest), offset)
            outside = certainly_less(radius * radius, dot(from_center, from_center))
            distance = inf
            if beside and not (outside and certainly_less(dot(direction, from_center), 0.0)):
                distance = distance_to_other_side(origin, direction, center)
            else:
                distance = sphere_distance(origin, direction, center, radius)
            if distance < end:
                return True
    if TRIANGLES:
        _, hit = nearest_triangle(scene, origin, direction, left, end, NOTHING)
        return hit != NOTHING
    return False


def is_occluded_by_textbook_spheres(
    scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar
) -> bool:
    """By the quadratic from the ray's start, whose discriminant loses a small and far sphere to rounding."""
    if SPHERES:
        largest = max(max(abs(origin[0]), abs(origin[1])), abs(origin[2]))  # noqa: PLW3301 - balls have a maximum of two
        offset = absolute_offset + relative_offset * largest
        direction_squared = dot(direction, direction)
        for sphere in range(rows_of(scene, SPHERE_RADIUS)):
            center = vector_of(scene, SPHERE_CENTER, sphere)
            radius = number_of(scene, SPHERE_RADIUS, sphere)
            from_center = subtract(origin, center)
            half_linear = dot(from_center, direction)
            center_squared = dot(from_center, from_center)
            beside = sphere == left and certainly_less(surface_slack * (radius + largest) + reach_slack, offset)
            outside = certainly_less(radius * radius, center_squared)
            distance = inf
            if beside and not (outside and certainly_less(half_linear, 0.0)):
                distance = distance_to_other_side(origin, direction, center)
            else:
                discriminant = half_linear * half_linear - direction_squared * (center_squared - radius * radius)
                if discriminant >= 0.0:
                    half_chord = sqrt(discriminant)
                    distance = -(half_linear + half_chord) / direction_squared
                    if distance < 0.0:
                        distance = (half_chord - half_linear) / direction_squared
                    if distance < 0.0:
                        distance = inf
            if distance < end:
                return True
    if TRIANGLES:
        _, hit = nearest_triangle(scene, origin, direction, left, end, NOTHING)
        return hit != NOTHING
    return False
