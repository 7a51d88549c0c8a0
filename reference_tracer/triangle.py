"""Intersection of a ray and a triangle (docs/spec.md, TRI).

The ray o + t·d meets the plane of a, b, c where o + t·d = a + u·(b-a) + v·(c-a): three equations for t, u and v, solved
by Cramer's rule (Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997, eq. 4 to 6).
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from reference_tracer.vector import cross, dot, normalize, subtract

if TYPE_CHECKING:
    from reference_tracer.numbers import Scalar, Vector


def triangle_distance(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """The positive t at which the ray meets the triangle, edges included, or infinity.

    A ray in the plane of the triangle misses, and so nothing hits a triangle of zero area. The three conditions
    u >= 0, v >= 0, u + v <= 1 are decided before dividing by the determinant, so that no scale is too small.
    """
    first_edge = subtract(b, a)
    second_edge = subtract(c, a)
    normal = cross(first_edge, second_edge)
    determinant = -dot(direction, normal)
    to_origin = subtract(origin, a)
    moment = cross(to_origin, direction)
    if determinant > 0.0:
        u = dot(second_edge, moment)
        v = -dot(first_edge, moment)
        t = dot(to_origin, normal)
    elif determinant < 0.0:
        determinant = -determinant
        u = -dot(second_edge, moment)
        v = dot(first_edge, moment)
        t = -dot(to_origin, normal)
    else:
        return inf
    # The edges first: from a coplanar neighbour, as in a floor of two triangles, t is 0 and undecidable in balls.
    if u < 0.0 or v < 0.0 or u + v > determinant or t <= 0.0:
        return inf
    return t / determinant


def triangle_normal(a: Vector, b: Vector, c: Vector) -> Vector:
    """The unit normal on the side from which a, b, c run counterclockwise."""
    return normalize(cross(subtract(b, a), subtract(c, a)))
