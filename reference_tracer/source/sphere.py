"""Intersection of a ray and a sphere (docs/spec.md, SPH).

With o the origin, d the direction, c the centre and r the radius, the ray meets the sphere where |o + t·d - c|² = r².
Divided by d², that is t² - 2·f·t + k = 0: f is the ray's foot, where it comes closest to the centre, and k =
(|o-c|² - r²)/d² the product of both roots.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.compensated import sphere_constant
from raytruth.reference_tracer.source.vector import along, dot, scale, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def sphere_distance(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """The smallest positive root t, or infinity where the ray misses; a tangent ray hits.

    The squared half chord is f² - k, or r² less the squared distance between centre and line, over d² (Haines, Günther,
    Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019, ch. 7, eq. 5). Rounding
    shifts the first in proportion to |f·d|, the second in proportion to that distance. Near a tangent, where it
    matters, the distance is r, and (f·d)² = |o-c|² - r²: so the first is better up to |o-c|² = 2·r², if its constant
    term does not cancel (sphere_constant), and the second beyond.
    Valid where no square of a number, nor of a quotient |o-c|/|d|, overflows or vanishes; beyond, the result may be 0,
    or NaN, which is nearer than nothing, but never negative. An input that is NaN or infinite is never hit.
    """
    to_origin = subtract(origin, center)
    direction_squared = dot(direction, direction)
    half_linear = dot(direction, to_origin)
    radius_squared = radius * radius
    constant = dot(to_origin, to_origin) - radius_squared
    if certainly_less(radius_squared, constant):
        if half_linear < 0.0:
            foot = -half_linear / direction_squared
            closest = along(to_origin, direction, foot)
            gap = radius_squared - dot(closest, closest)
            return root_outside(foot, gap / direction_squared, constant / direction_squared)
        return inf
    constant = sphere_constant(origin, center, radius)
    foot = -half_linear / direction_squared
    product = constant / direction_squared
    if constant < 0.0:
        return root_inside(foot, product)
    if foot > 0.0:
        return root_outside(foot, foot * foot - product, product)
    return inf


def root_outside(foot: Scalar, half_chord_squared: Scalar, product: Scalar) -> Scalar:
    """The nearer of two positive roots, taken from their product, since foot - half chord cancels (ibid., eq. 10)."""
    if half_chord_squared >= 0.0:
        farther = foot + sqrt(half_chord_squared)
        if product > 0.0:
            return product / farther
        return farther  # the nearer root is the start itself
    return inf


def root_inside(foot: Scalar, product: Scalar) -> Scalar:
    """The positive one of two roots of different signs, for a ray that starts inside; without cancellation."""
    half_chord = sqrt(foot * foot - product)
    if foot > 0.0:
        return foot + half_chord
    return product / (foot - half_chord)


def distance_to_other_side(origin: Vector, direction: Vector, center: Vector) -> Scalar:
    """The root that remains for a ray that starts on the sphere: one root is 0, their sum is -2·(d·(o-c))/(d·d).

    Infinity for a ray that leaves outward. This excludes the starting point exactly, without an epsilon. With an input
    that is NaN or infinite nothing is hit: the result is NaN or infinity.
    """
    half_linear = dot(direction, subtract(origin, center))
    if half_linear >= 0.0:
        return inf
    return -2.0 * half_linear / dot(direction, direction)


def sphere_normal(point: Vector, center: Vector, radius: Scalar) -> Vector:
    """The outward unit normal at a point of the sphere, whose radius is not 0; NaN where an input is NaN."""
    return scale(subtract(point, center), 1.0 / radius)
