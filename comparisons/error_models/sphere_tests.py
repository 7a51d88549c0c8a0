"""How a renderer may test rays against spheres, in place of the formulas of the truth.

The formulas are equal in exact arithmetic. Far from the origin, and on large spheres, what rounding does to each is
not. Mitsuba 3.9.1 has two (src/shapes/sphere.cpp): for the nearest hit one from the ray's foot (lines 522-583), whether
anything is hit by the textbook's quadratic (lines 585-625). Both are solved by solve_quadratic (include/mitsuba/core/
math.h lines 359-402), which takes one root from the other by their product. The functions here are source of the
tracer, as those of triangle_tests.py.
"""

from __future__ import annotations

from math import dist, inf, sqrt
from typing import TYPE_CHECKING

from flint import arb

from raytruth.comparisons.error_models.helpers import largest_magnitude
from raytruth.comparisons.error_models.ray_offsets import comes_back, offset_length
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.compensated import sphere_constant
from raytruth.reference_tracer.source.scene_data import SPHERE_CENTER, SPHERE_RADIUS, number_of, rows_of, vector_of
from raytruth.reference_tracer.source.sphere import distance_to_other_side, sphere_distance
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.reference_tracer.source.vector import along, dot, subtract
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData
    from raytruth.scenes.scene import Scene

roundoff: Scalar = 0.0
"""The largest relative error of one operation."""
chord_error: Scalar = 0.0
"""Between -1 and 1: how far the squared half chord is off, of the most that it may be."""
root_error: Scalar = 0.0
"""The same of a root besides; apart, since nothing is known of how both go together."""
surface_slack: Scalar = 0.0
"""Of a radius and a largest coordinate: no offset above it is lost to what rounding does to either formula."""
put_back_slack: Scalar = 0.0
"""The same for a test in float64."""
reach_slack: Scalar = 0.0
"""What is lost besides of an offset from a point that was found along the longest ray."""
moves_starts: Scalar = 0.0
"""1 where rays start beside the sphere that they leave, 0 where on it, and it is known by its number."""

# What rounding does to a test from the foot, u being the roundoff, for a ray that comes within the radius r of the
# centre c: the product of direction and way to the foot, of length L, the foot's coordinates, which are within |c| +
# r, and the vector from the centre, which is within r, are each rounded once: by e = u·(L + |c| + 2·r) together. Its
# square less r² is off by D = 5·u·r² + 2·r·e + e²; the roots move by e + D/(2·h) + 3·u·r, where h is half the chord.
# A ray that starts δ above a sphere surely does not meet it again if δ is above that. Then L is within r, and with m
# the largest coordinate of its start, e is within u·(1.8·m + 3.8·r). Far from a tangent the farther root lies δ·r/h
# behind the start, so that δ > D/r + 2·e + 6·u·r = u·(26.2·r + 7.2·m) suffices; at a tangent 2·r·δ > D does. The
# textbook's constant |o-c|² - r² is off by less than D. And the start may be beside where it should be, as is counted
# next.
SURFACE_ROUNDOFFS = 36
# A point that was put back on the sphere: its unit normal is off by 5·u (its square by 3, the root and the product),
# times r by one more, and the sums with the centre and with the offset round m: u·(6·r + 2·√3·m).
PUT_BACK_ROUNDOFFS = 6
# A point along a ray of length t: besides e + D/(2·r) + 3·u·r for the root, the sum of root and foot, and its product
# with the direction, are rounded: u·(9.3·r + 3.6·m + 2·t).
ALONG_ROUNDOFFS = 2


def sphere_test_behaviour(error_model: ErrorModel, scene: Scene) -> Behaviour:
    """What this renderer's tests replace, nothing for the truth's own.

    The tracer asks `nearest_sphere` for the nearest hit, and `distance_to_sphere` whether anything is hit. To be merged
    with HELPERS and `offset_behaviour`. The constants are balls.
    """
    if not error_model.sphere_test.startswith("from the foot"):
        return IDEAL
    in_float64 = error_model.sphere_test == "from the foot, accurate for shadows"
    roundoff = 2.0**-error_model.precision_bits
    along_rays = 0.0 if error_model.sphere_points == "put back" else ALONG_ROUNDOFFS * _reach(scene)
    return Behaviour(
        {
            "nearest_sphere": nearest_sphere_from_foot,
            "distance_to_sphere": distance_to_sphere_in_float64 if in_float64 else distance_to_sphere_by_textbook,
        },
        (only_other_side_remains, distance_from_foot, nonnegative_root),
        {
            "roundoff": arb(roundoff),
            "chord_error": arb(0, 1),
            "root_error": arb(0, 1),
            "surface_slack": arb(SURFACE_ROUNDOFFS * roundoff),
            "put_back_slack": arb(PUT_BACK_ROUNDOFFS * roundoff),
            "reach_slack": arb(along_rays * roundoff),
            "moves_starts": arb(1 if error_model.ray_offset.moves_rays else 0),
        },
        "the test of spheres",
    )


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


def only_other_side_remains(
    origin: Vector, direction: Vector, center: Vector, radius: Scalar, slack: Scalar, lost: Scalar
) -> bool:
    """Whether a ray that has left a sphere cannot meet it where it started.

    It surely cannot if its offset is above all rounding: `slack` of radius and coordinates, and what else is `lost`.
    But who starts beside a sphere may come back to it from outside.
    """
    if moves_starts > 0.0:
        rounding = slack * (radius + largest_magnitude(origin[0], origin[1], origin[2])) + lost
        is_beside = certainly_less(rounding, offset_length(origin))
        return is_beside and not comes_back(origin, direction, center, radius)
    return True


def nearest_sphere_from_foot(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """The nearest of all spheres, each tested from the ray's foot."""
    nearest = inf
    hit = NOTHING
    for sphere in range(rows_of(scene, SPHERE_RADIUS)):
        center = vector_of(scene, SPHERE_CENTER, sphere)
        radius = number_of(scene, SPHERE_RADIUS, sphere)
        distance = inf
        if sphere == left and only_other_side_remains(origin, direction, center, radius, surface_slack, reach_slack):
            distance = distance_to_other_side(origin, direction, center)
        else:
            distance = distance_from_foot(origin, direction, center, radius)
        if distance < nearest:
            nearest = distance
            hit = sphere
    return nearest, hit


def distance_from_foot(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """The ray is moved to its foot, where it is nearest to the centre, and meets the sphere from there.

    In exact arithmetic that is sphere_distance. So its steps are taken, with what rounding does to the others: the
    squared half chord is off by D, both roots by e and three roundoffs of the radius besides.
    """
    to_origin = subtract(origin, center)
    direction_squared = dot(direction, direction)
    length = sqrt(direction_squared)
    radius_squared = radius * radius
    half_linear = dot(direction, to_origin)
    foot = -half_linear / direction_squared
    shift = roundoff * (abs(half_linear) / length + sqrt(dot(center, center)) + 2.0 * radius)  # e
    lost = chord_error * (5.0 * roundoff * radius_squared + (2.0 * radius + shift) * shift) / direction_squared
    moved = root_error * (shift + 3.0 * roundoff * radius) / length
    constant = dot(to_origin, to_origin) - radius_squared
    if certainly_less(radius_squared, constant):
        closest = along(to_origin, direction, foot)
        half_chord_squared = (radius_squared - dot(closest, closest)) / direction_squared
    else:
        half_chord_squared = foot * foot - sphere_constant(origin, center, radius) / direction_squared
    return nonnegative_root(foot + moved, half_chord_squared + lost)


def nonnegative_root(foot: Scalar, half_chord_squared: Scalar) -> Scalar:
    """The nearer of both roots that is not negative, or infinity."""
    if half_chord_squared < 0.0:
        return inf
    half_chord = sqrt(half_chord_squared)
    nearer = foot - half_chord
    if nearer >= 0.0:
        return nearer
    farther = foot + half_chord
    if farther >= 0.0:
        return farther
    return inf


def distance_to_sphere_in_float64(
    scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int
) -> Scalar:
    """By the textbook's quadratic, too, but in float64, whose roundings are nothing beside float32's of the ray.

    So it is the truth's own formula, of this ray.
    """
    center = vector_of(scene, SPHERE_CENTER, sphere)
    radius = number_of(scene, SPHERE_RADIUS, sphere)
    if sphere == left and only_other_side_remains(origin, direction, center, radius, put_back_slack, 0.0):
        return distance_to_other_side(origin, direction, center)
    return sphere_distance(origin, direction, center, radius)


def distance_to_sphere_by_textbook(
    scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int
) -> Scalar:
    """By the quadratic from the ray's start, whose discriminant loses a small and far sphere to rounding."""
    center = vector_of(scene, SPHERE_CENTER, sphere)
    radius = number_of(scene, SPHERE_RADIUS, sphere)
    if sphere == left and only_other_side_remains(origin, direction, center, radius, surface_slack, reach_slack):
        return distance_to_other_side(origin, direction, center)
    from_center = subtract(origin, center)
    direction_squared = dot(direction, direction)
    foot = -dot(from_center, direction) / direction_squared
    constant = dot(from_center, from_center) - radius * radius
    return nonnegative_root(foot, foot * foot - constant / direction_squared)
