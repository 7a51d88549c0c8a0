"""How a renderer may find the point where a ray meets a surface, in place of going along the ray.

All are the same in exact arithmetic. Where a triangle is far larger than its distance, or a surface small and far,
rounding does other things to them. The functions here are source of the tracer, as those of triangle_tests.py.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from flint import arb

from raytruth.comparisons.error_models.helpers import (
    corners_of,
    cross_terms,
    largest_magnitude,
    magnitudes,
    pluecker_products,
    triangle_of,
)
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.source.scene_data import SPHERE_CENTER, SPHERE_RADIUS, number_of, vector_of
from raytruth.reference_tracer.source.vector import add, along, cross, dot, normalize, scale, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

interpolation_error_x: Scalar = 0.0
"""Of a coordinate that is interpolated between corners, in units of the largest of theirs."""
interpolation_error_y: Scalar = 0.0
interpolation_error_z: Scalar = 0.0
weight_error_u: Scalar = 0.0
"""Of a weight by Möller and Trumbore's formulas, in units of all terms that it is summed from."""
weight_error_v: Scalar = 0.0
put_back_error_x: Scalar = 0.0
"""Of a coordinate of a point that is put back on its sphere, in units of the lengths that it is computed from."""
put_back_error_y: Scalar = 0.0
put_back_error_z: Scalar = 0.0

# (1 - u - v)·a + u·b + v·c, for weights between 0 and 1: the first weight is off by two roundoffs at most, a coordinate
# of a by as much of it; each product and each of two sums rounds once, the weights' sum being 1: in all 2 + 3.
INTERPOLATION_ROUNDOFFS = 5
# Möller and Trumbore's U = ((a - o) × d)·e, and the determinant ((c - a) × (a - b))·d, are each six products of three
# numbers, of which each term is rounded by seven operations at most: two differences, two products, a difference of
# two and two sums. A weight is their quotient, off by the sum of their errors over the determinant, for a weight
# between 0 and 1, and by the 4 of a reciprocal and its product (triangle_tests.py), which are no more than 4 times the
# determinant's terms over the determinant: in all 7 of U's terms and 11 of the determinant's. One more is for the
# products of errors.
WEIGHT_ROUNDOFFS = 12


def hit_point_behaviour(error_model: ErrorModel) -> Behaviour:
    """What is replaced, nothing for who goes along the ray; to be merged with HELPERS. The constants are balls."""
    functions: dict[str, Function] = {}
    if error_model.triangle_points == "barycentric":
        by_weights = {
            "pluecker": hit_point_by_pluecker,
            "moeller-trumbore": hit_point_by_moeller_trumbore,
            "moeller-trumbore of 1997": hit_point_by_moeller_trumbore,  # the same products, each rounded no more often
            "cramer": hit_point_by_moeller_trumbore,  # likewise
        }
        functions["hit_point"] = by_weights[error_model.triangle_test]
    if error_model.sphere_points == "normalised":
        functions["sphere_normal"] = normalised_sphere_normal
    roundoff = 2.0**-error_model.precision_bits
    put_back = roundoff if error_model.sphere_points == "put back" else 0.0
    constants = {
        **{f"interpolation_error_{axis}": arb(0, INTERPOLATION_ROUNDOFFS * roundoff) for axis in "xyz"},
        **{f"weight_error_{weight}": arb(0, WEIGHT_ROUNDOFFS * roundoff) for weight in "uv"},
        **{f"put_back_error_{axis}": arb(0, put_back) for axis in "xyz"},
    }
    return Behaviour(functions, (as_interpolated, as_put_back), constants, "hit points")


def as_interpolated(point: Vector, a: Vector, b: Vector, c: Vector) -> Vector:
    """A point of a triangle, off by what rounding does to the sum (1 - u - v)·a + u·b + v·c."""
    x = point[0] + largest_magnitude(a[0], b[0], c[0]) * interpolation_error_x
    y = point[1] + largest_magnitude(a[1], b[1], c[1]) * interpolation_error_y
    return (x, y, point[2] + largest_magnitude(a[2], b[2], c[2]) * interpolation_error_z)


def as_put_back(scene: SceneData, point: Vector, distance: Scalar, sphere: int) -> Vector:
    """A point of a sphere, where it lies on a ray of unit direction, off by what remains when it is put back.

    What rounding does to the root moves a point along its ray (e, D, h and L in sphere_tests.py). To put it back along
    its normal n leaves of e + D/(2·h) + 3·u·r what is along n, at most the h/r-th of it, which is within e + D/(2·r) +
    3·u·r; and at a tangent, of its square over 2·r, D/(2·r): together 3·e + 8·u·r, to any side. The point before was
    rounded, by e at most; n is off by 5·u, times r by one more; the sum with the centre is rounded. So all is within
    4·e + 15·u·r + u·|c| = u·(4·L + 5·|c| + 23·r), where L is within the distance and r.
    """
    center = vector_of(scene, SPHERE_CENTER, sphere)
    lengths = 4.0 * distance + 5.0 * sqrt(dot(center, center)) + 27.0 * number_of(scene, SPHERE_RADIUS, sphere)
    x, y, z = point
    return (x + lengths * put_back_error_x, y + lengths * put_back_error_y, z + lengths * put_back_error_z)


def hit_point_by_pluecker(
    scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int
) -> Vector:
    """On a sphere along the ray, on a triangle from its corners: (1 - u - v)·a + u·b + v·c.

    The weights are the products of Plücker coordinates of Embree's robust test (triangle_tests.pluecker_distance), over
    the sum of all three by a reciprocal: PlueckerHitM::finalize in kernels/geometry/triangle_intersector_pluecker.h.
    Plain balls do not know that the weights' errors cancel, so they are given a + u·(b - a) + v·(c - a), and what
    rounding does to the sum above.
    """
    triangle = triangle_of(scene, primitive)
    if triangle < 0:
        return along(origin, direction, distance)
    a, b, c = corners_of(scene, triangle)
    to_a, to_b, to_c = subtract(a, origin), subtract(b, origin), subtract(c, origin)
    u, v, w = pluecker_products(to_a, to_b, to_c, direction)
    reciprocal = 1.0 / (u + v + w) * 1.0 * 1.0 * 1.0  # as in triangle_tests.py
    from_a = add(scale(subtract(b, a), u * reciprocal), scale(subtract(c, a), v * reciprocal))
    return as_interpolated(add(a, from_a), a, b, c)


def hit_point_by_moeller_trumbore(
    scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int
) -> Vector:
    """As hit_point_by_pluecker, with the weights of Embree's fast test (triangle_tests.moeller_trumbore_distance).

    Mitsuba 3.9.1 takes its points so from Embree 3.13.4 (src/render/mesh.cpp line 1566; kernels/geometry/
    triangle_intersector_moeller.h, MoellerTrumboreHitM::finalize). A point on a sphere is found along the ray and, in
    its scalar variants, put back on the sphere along its normal (src/shapes/sphere.cpp lines 690-693).

    In exact arithmetic the corners give the same point as the ray does. So the point is found along the ray, and then
    moved, in the triangle's plane, by what rounding does to the weights: WEIGHT_ROUNDOFFS.
    """
    triangle = triangle_of(scene, primitive)
    if triangle < 0:
        return as_put_back(scene, along(origin, direction, distance), distance, primitive)
    a, b, c = corners_of(scene, triangle)
    first_edge, second_edge = subtract(a, b), subtract(c, a)
    area = dot(cross_terms(first_edge, second_edge), magnitudes(direction))
    turn = cross_terms(subtract(a, origin), direction)
    inverse = 1.0 / abs(dot(cross(second_edge, first_edge), direction))
    u_error = (dot(turn, magnitudes(second_edge)) + area) * inverse * weight_error_u
    v_error = (dot(turn, magnitudes(first_edge)) + area) * inverse * weight_error_v
    from_weights = add(scale(first_edge, u_error), scale(second_edge, v_error))
    return as_interpolated(add(along(origin, direction, distance), from_weights), a, b, c)


def normalised_sphere_normal(point: Vector, center: Vector, radius: Scalar) -> Vector:  # noqa: ARG001 - the signature of the function it stands for
    """Of length 1 also at a point beside the sphere, where (p - c)/r is not."""
    return normalize(subtract(point, center))
