"""Whether a ray may meet the triangle again that it has left, where its start is moved off it.

It does so where the offset is not above what rounding does to a triangle that is large beside it. The function here is
an override, as in triangle_tests.py.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.scene_data import TRIANGLE_A, TRIANGLE_B, TRIANGLE_C, vector_of
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import add, cross, dot, scale, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

absolute_offset: Scalar = 0.0
"""As in ray_offsets.py."""
relative_offset: Scalar = 0.0
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


def left_triangle_overrides(error_model: ErrorModel) -> dict[str, Callable[..., Any]]:
    """The function of the tracer's source that is replaced, for who takes points and test from the corners."""
    moves = error_model.ray_offset.moves_rays and error_model.ray_offset.excludes_surface
    from_corners = error_model.triangle_test == "moeller-trumbore" and error_model.triangle_points == "barycentric"
    return {"distance_to_triangle": distance_to_triangle_from_offset} if moves and from_corners else {}


def left_triangle_constants(error_model: ErrorModel) -> dict[str, Any]:
    """The constants of the override by name, as balls."""
    roundoff = 2.0**-error_model.precision_bits
    return {"height_slack": arb(HEIGHT_ROUNDOFFS * roundoff), "start_slack": arb(START_ROUNDOFFS * roundoff)}


def distance_to_triangle_from_offset(
    scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int
) -> Scalar:
    """A triangle that a ray has left is tested as all others are, unless its offset is surely above all rounding."""
    a = vector_of(scene, TRIANGLE_A, triangle)
    b = vector_of(scene, TRIANGLE_B, triangle)
    c = vector_of(scene, TRIANGLE_C, triangle)
    if triangle == left:
        first_edge, second_edge, to_corner = subtract(a, b), subtract(c, a), subtract(a, origin)
        normal = cross(second_edge, first_edge)
        size = sqrt(dot(normal, normal))
        edge_1 = (abs(first_edge[0]), abs(first_edge[1]), abs(first_edge[2]))
        edge_2 = (abs(second_edge[0]), abs(second_edge[1]), abs(second_edge[2]))
        # The cross product with its minus made a plus, as in hit_points.py.
        negative = (edge_1[2] * edge_2[1], edge_1[0] * edge_2[2], edge_1[1] * edge_2[0])
        terms = add(cross(edge_1, edge_2), scale(negative, 2.0))
        height = dot(terms, (abs(to_corner[0]), abs(to_corner[1]), abs(to_corner[2])))
        far_a = max(max(abs(a[0]), abs(a[1])), abs(a[2]))  # noqa: PLW3301 - balls have a maximum of two
        far_b = max(max(abs(b[0]), abs(b[1])), abs(b[2]))  # noqa: PLW3301 - as above
        far_c = max(max(abs(c[0]), abs(c[1])), abs(c[2]))  # noqa: PLW3301 - as above
        lost = height_slack * height + start_slack * max(max(far_a, far_b), far_c) * size  # noqa: PLW3301 - as above
        largest = max(max(abs(origin[0]), abs(origin[1])), abs(origin[2]))  # noqa: PLW3301 - as above
        if certainly_less(lost, (absolute_offset + relative_offset * largest) * size):
            return inf
    return triangle_distance(origin, direction, a, b, c)
