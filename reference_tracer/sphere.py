"""Intersection of a ray and a sphere (docs/spec.md, SPH).

With o the origin, d the direction, c the centre and r the radius, the ray meets the sphere where
|o + t·d - c|² = r², a quadratic in t: (d·d)·t² + 2·(d·(o-c))·t + |o-c|² - r² = 0.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from reference_tracer.vector import along, dot, scale, subtract

if TYPE_CHECKING:
    from reference_tracer.numbers import Scalar, Vector


def sphere_distance(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """The smallest positive root t, or infinity where the ray misses; a tangent ray hits.

    From outside the discriminant is taken from the distance between centre and line (Haines, Günther, Akenine-Möller,
    "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019, ch. 7, eq. 5), which does not cancel
    for far spheres; from inside both terms of the textbook's have one sign. The roots come from their product, which
    does not cancel either (ibid., eq. 10 to 12).
    """
    to_origin = subtract(origin, center)
    direction_squared = dot(direction, direction)
    half_linear = dot(direction, to_origin)
    constant = dot(to_origin, to_origin) - radius * radius
    if constant < 0.0:  # inside
        root = sqrt(half_linear * half_linear - direction_squared * constant)
        if half_linear < 0.0:
            return (root - half_linear) / direction_squared
        return -constant / (half_linear + root)
    if half_linear >= 0.0:
        return inf  # moving away
    foot = -half_linear / direction_squared
    closest = along(to_origin, direction, foot)
    discriminant = direction_squared * (radius * radius - dot(closest, closest))
    if discriminant < 0.0:
        return inf
    larger = sqrt(discriminant) - half_linear
    if constant > 0.0:
        # The nearer root lies before the foot; a quotient of two numbers that are nearly zero may not.
        return min(constant / larger, foot)
    return larger / direction_squared


def distance_to_other_side(origin: Vector, direction: Vector, center: Vector) -> Scalar:
    """The root that remains for a ray that starts on the sphere: one root is 0, their sum is -2·(d·(o-c))/(d·d).

    Infinity for a ray that leaves outward. This excludes the starting point exactly, without an epsilon.
    """
    half_linear = dot(direction, subtract(origin, center))
    if half_linear >= 0.0:
        return inf
    return -2.0 * half_linear / dot(direction, direction)


def sphere_normal(point: Vector, center: Vector, radius: Scalar) -> Vector:
    """The outward unit normal at a point of the sphere."""
    return scale(subtract(point, center), 1.0 / radius)
