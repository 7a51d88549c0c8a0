"""Whether a ray may meet the triangle again that it has left, where its start is moved off it.

It does so where the offset is not above what rounding does to a triangle that is large beside it. The function here is
source of the tracer, as those of triangle_tests.py.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from flint import arb

from raytruth.comparisons.error_models.helpers import corners_of, cross_terms, largest_magnitude, magnitudes
from raytruth.comparisons.error_models.ray_offsets import offset_length
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import cross, dot, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

height_slack: Scalar = 0.0
"""Of the terms that a height above the triangle is summed from: what rounding does to it."""
start_slack: Scalar = 0.0
"""Of the largest coordinate of the corners: how far a start may be nearer to the triangle than its offset."""

# Möller and Trumbore's height ((c - a) × (a - b))·(a - o) is the sum of products of three numbers. Each is rounded by
# seven operations at most: three differences, two products or the one of two sums in a product's place, and two sums.
# One more is for the products of errors.
HEIGHT_ROUNDOFFS = 8
# A point from the corners is off by 5 in each coordinate (hit_points.INTERPOLATION_ROUNDOFFS), and its sum with the
# offset is rounded once: 6·√3 along the normal.
START_ROUNDOFFS = 11


def left_triangle_behaviour(error_model: ErrorModel) -> Behaviour:
    """What is replaced for who moves rays off triangles, and takes points and test from the corners; else nothing.

    To be merged with HELPERS and `offset_behaviour`. The constants are balls.
    """
    offset = error_model.ray_offset
    moves = offset.moves_rays and offset.excludes_surface and not offset.is_bound
    from_corners = error_model.triangle_test == "moeller-trumbore" and error_model.triangle_points == "barycentric"
    if error_model.needs_policies or not (moves and from_corners):
        return IDEAL
    roundoff = 2.0**-error_model.precision_bits
    return Behaviour(
        {"distance_to_triangle": distance_to_triangle_from_offset},
        constants={"height_slack": arb(HEIGHT_ROUNDOFFS * roundoff), "start_slack": arb(START_ROUNDOFFS * roundoff)},
        name="the test of a triangle that a ray has left",
    )


def distance_to_triangle_from_offset(
    scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int
) -> Scalar:
    """A triangle that a ray has left is tested as all others are, unless its offset is surely above all rounding."""
    a, b, c = corners_of(scene, triangle)
    if triangle == left:
        first_edge, second_edge = subtract(a, b), subtract(c, a)
        normal = cross(second_edge, first_edge)
        size = sqrt(dot(normal, normal))
        height = dot(cross_terms(first_edge, second_edge), magnitudes(subtract(a, origin)))
        farthest_corner = largest_magnitude(
            largest_magnitude(a[0], a[1], a[2]),
            largest_magnitude(b[0], b[1], b[2]),
            largest_magnitude(c[0], c[1], c[2]),
        )
        lost = height_slack * height + start_slack * farthest_corner * size
        if certainly_less(lost, offset_length(origin) * size):
            return inf
    return triangle_distance(origin, direction, a, b, c)
