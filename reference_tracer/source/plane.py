"""Intersection of a ray and an infinite plane (docs/spec.md, PLANE).

With o the origin, d the direction, p a point of the plane and m its normal, of any length, the ray meets the plane
where (o + t·d - p)·m = 0, which is at t = (p-o)·m / d·m: the length of m has no effect.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.vector import dot, normalize, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def plane_distance(origin: Vector, direction: Vector, point: Vector, normal: Vector) -> Scalar:
    """The positive t at which the ray meets the plane, or infinity; `normal` is not zero.

    A parallel ray misses, within the plane too, and so does one that starts on the plane. Both are told by signs before
    anything is divided: the ray meets the plane if it goes to the side on which the plane is. Valid where no product of
    two numbers overflows or vanishes. With an input that is NaN nothing is hit.
    """
    height = dot(subtract(point, origin), normal)
    approach = dot(direction, normal)
    if (height > 0.0 and approach > 0.0) or (height < 0.0 and approach < 0.0):
        return height / approach
    return inf


def plane_normal(normal: Vector) -> Vector:
    """The unit normal, the same at all points; `normal` is not zero."""
    return normalize(normal)
