"""How a renderer may test rays against triangles, in place of the watertight test of the truth.

The formulas are equal in exact arithmetic; what rounding does to each near an edge is not. The functions here are
source of the tracer, in place of its `triangle_distance`. So they run in every number type.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.helpers import edge_slack, pluecker_product
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.vector import along, cross, dot, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def triangle_test_behaviour(error_model: ErrorModel) -> Behaviour:
    """What this renderer's test replaces, nothing for the truth's own test; to be merged with HELPERS."""
    tests = {
        "moeller-trumbore": moeller_trumbore_distance,
        "moeller-trumbore of 1997": moeller_trumbore_distance_of_1997,
        "pluecker": pluecker_distance,
        "cramer": cramer_distance,
        "plane and inside": plane_and_inside_distance,
    }
    test = tests.get(error_model.triangle_test)
    if test is None:
        return IDEAL
    return Behaviour({"triangle_distance": test}, (beside_triangle,), name="the test of triangles")


def moeller_trumbore_distance(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Möller and Trumbore 1997 as Embree 4.4 has it (kernels/geometry/triangle_intersector_moeller.h, lines 73-111)."""
    first_edge = subtract(a, b)
    second_edge = subtract(c, a)
    normal = cross(second_edge, first_edge)
    to_corner = subtract(a, origin)
    determinant = dot(normal, direction)
    if determinant == 0.0:
        return inf
    side = 1.0 if determinant > 0.0 else -1.0
    turn = cross(to_corner, direction)
    u = side * dot(turn, second_edge)
    v = side * dot(turn, first_edge)
    if u < 0.0 or v < 0.0 or u + v > side * determinant:
        return inf
    height = side * dot(normal, to_corner)
    if height <= 0.0:
        return inf
    # Embree multiplies by a reciprocal: rcpps, which errs by at most 1.5·2^-12 relatively (Intel 64 and IA-32
    # Architectures Software Developer's Manual, volume 2), after one Newton step r + r·(1 - a·r), which squares that
    # (common/simd/vfloat4_sse2.h line 304, vfloat8_avx.h line 254). The square is 2.25·2^-24, and the step's last
    # addition rounds: in all less than the four roundoffs of a division and three multiplications.
    return height * (1.0 / (side * determinant) * 1.0 * 1.0 * 1.0)


def pluecker_distance(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Embree 4.4's robust test (kernels/geometry/triangle_intersector_pluecker.h, lines 68-109).

    Each edge's sign comes from its corners relative to the ray's origin, as the product of Plücker coordinates; a
    little outside still hits. Embree takes each part of the normal from that of two cross products whose terms are
    smaller. That bounds the terms by those here; but its edges, also of the other corner, may be twice as long, which
    the adapter's error model makes up for by one bit.
    """
    to_a, to_b, to_c = subtract(a, origin), subtract(b, origin), subtract(c, origin)
    edges = (subtract(to_c, to_a), subtract(to_a, to_b), subtract(to_b, to_c))
    u = pluecker_product(edges[0], to_a, to_c, direction)
    v = pluecker_product(edges[1], to_b, to_a, direction)
    w = pluecker_product(edges[2], to_c, to_b, direction)
    slack = edge_slack * abs(u + v + w)
    if (u < -slack or v < -slack or w < -slack) and (u > slack or v > slack or w > slack):
        return inf
    normal = cross(edges[0], edges[1])
    determinant = 2.0 * dot(normal, direction)
    if determinant == 0.0:
        return inf
    height = 2.0 * dot(to_a, normal)
    distance = height * (1.0 / determinant * 1.0 * 1.0 * 1.0)  # a reciprocal, as above
    if distance > 0.0:
        return distance
    return inf


def beside_triangle(u: Scalar, v: Scalar, w: Scalar) -> bool:
    """Whether weights surely have different signs, so that a ray misses, even if it may be in the triangle's plane."""
    some_below = certainly_less(u, 0.0) or certainly_less(v, 0.0) or certainly_less(w, 0.0)
    return some_below and (certainly_less(0.0, u) or certainly_less(0.0, v) or certainly_less(0.0, w))


def moeller_trumbore_distance_of_1997(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997: their steps in their order.

    Weights are compared before they are divided, where balls still know their signs; a quotient with the determinant is
    rounded up to three times in the program, and so is the determinant here.
    """
    first_edge, second_edge = subtract(b, a), subtract(c, a)
    p = cross(direction, second_edge)
    determinant = dot(first_edge, p)
    to_origin = subtract(origin, a)
    u = dot(to_origin, p)
    q = cross(to_origin, first_edge)
    v = dot(direction, q)
    if beside_triangle(u, v, determinant - u - v) or determinant == 0.0:
        return inf
    side = 1.0 if determinant > 0.0 else -1.0
    if side * u < 0.0 or side * v < 0.0 or side * (u + v) > side * determinant * 1.0 * 1.0 * 1.0:
        return inf
    height = dot(second_edge, q)
    if side * height <= 0.0:
        return inf
    return height * (1.0 / determinant)


def cramer_distance(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Cramer's rule for (a - b)·u + (a - c)·v + d·t = a - o, each determinant by its first column.

    Shirley et al., Fundamentals of Computer Graphics, 3rd ed., section 4.4.2. As above, weights are compared before
    they are divided.
    """
    first_edge, second_edge, to_corner = subtract(a, b), subtract(a, c), subtract(a, origin)
    across = cross(second_edge, direction)
    determinant = dot(first_edge, across)
    u = dot(to_corner, across)
    v = dot(first_edge, cross(to_corner, direction))
    if beside_triangle(u, v, determinant - u - v) or determinant == 0.0:
        return inf
    side = 1.0 if determinant > 0.0 else -1.0
    if side * u < 0.0 or side * v < 0.0 or side * (u + v) > side * determinant * 1.0 * 1.0 * 1.0:
        return inf
    height = dot(first_edge, cross(second_edge, to_corner))
    if side * height <= 0.0:
        return inf
    return height * (1.0 / determinant)


def plane_and_inside_distance(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Where the ray meets the plane, and whether that point is on the inner side of each edge, by vector products.

    Snyder, Barr, "Ray Tracing Complex Models Containing Surface Tessellations", 1987, with the plane as n·p = n·a.
    """
    first_edge = subtract(b, a)
    normal = cross(first_edge, subtract(c, a))
    determinant = dot(normal, direction)
    if determinant == 0.0:
        return inf
    distance = (dot(normal, a) - dot(normal, origin)) / determinant
    if distance <= 0.0:
        return inf
    point = along(origin, direction, distance)
    u = dot(normal, cross(first_edge, subtract(point, a)))
    v = dot(normal, cross(subtract(c, b), subtract(point, b)))
    w = dot(normal, cross(subtract(a, c), subtract(point, c)))
    if u < 0.0 or v < 0.0 or w < 0.0:
        return inf
    return distance
