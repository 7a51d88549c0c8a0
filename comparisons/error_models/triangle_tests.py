"""How a renderer may test rays against triangles, in place of the watertight test of the truth.

The formulas are equal in exact arithmetic; what rounding does to each near an edge is not. The functions here are
source of the tracer, in place of its `triangle_distance`. So they run in every number type.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.helpers import edge_slack, pluecker_product
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.source.vector import cross, dot, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def triangle_test_behaviour(error_model: ErrorModel) -> Behaviour:
    """What this renderer's test replaces, nothing for the truth's own test; to be merged with HELPERS."""
    tests = {"moeller-trumbore": moeller_trumbore_distance, "pluecker": pluecker_distance}
    test = tests.get(error_model.triangle_test)
    return Behaviour({} if test is None else {"triangle_distance": test}, name="the test of triangles")


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
