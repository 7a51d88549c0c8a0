"""Intersection of a ray and a triangle (docs/spec.md, TRI).

Seen along the ray, the triangle is one of the plane, and the ray the plane's origin. It hits where the origin is on the
same side of all three edges; t is then where the ray meets the triangle's plane.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.vector import cross, dot, normalize, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def triangle_distance(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """The positive t at which the ray meets the triangle, edges included, or infinity.

    Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", 2013: the axis along which the direction is longest
    becomes the last one, and a shear turns the ray into it. A corner has then the same place in the plane for all
    triangles that share it, and rounding keeps the order of two products, so that the sign of x·y' - y·x' is right or
    the difference is 0. Since 0 counts as inside, no ray passes between triangles that share an edge or a corner; it
    may hit both. A ray in the plane of the triangle misses, and so nothing hits a triangle of zero area.
    Valid where no product of two coordinates overflows or vanishes.
    """
    axis = longest_axis(direction)
    ray = turned(direction, axis)
    shear_x = ray[0] / ray[2]
    shear_y = ray[1] / ray[2]
    to_corner = subtract(a, origin)
    to_a = turned(to_corner, axis)
    to_b = turned(subtract(b, origin), axis)
    to_c = turned(subtract(c, origin), axis)
    ax, ay = sheared(to_a, shear_x, shear_y)
    bx, by = sheared(to_b, shear_x, shear_y)
    cx, cy = sheared(to_c, shear_x, shear_y)
    u = cx * by - cy * bx
    v = ax * cy - ay * cx
    w = bx * ay - by * ax
    if (u < 0.0 or v < 0.0 or w < 0.0) and (u > 0.0 or v > 0.0 or w > 0.0):
        return inf
    # Not from the corners' depths, whose mean loses what a far corner rounds: of a floor the plane's distance is exact.
    normal = cross(subtract(b, a), subtract(c, a))
    area = u + v + w
    if area == 0.0 or (normal[0] == 0.0 and normal[1] == 0.0 and normal[2] == 0.0):
        return inf
    depths = (to_a[2] / ray[2], to_b[2] / ray[2], to_c[2] / ray[2])
    determinant = dot(direction, normal)
    if determinant == 0.0:
        distance = dot((u, v, w), depths) / area
    else:
        distance = between(dot(to_corner, normal) / determinant, depths)
    if distance > 0.0:
        return distance
    return inf


def between(distance: Scalar, depths: Vector) -> Scalar:
    """The distance, but no nearer than the nearest corner and no farther than the farthest.

    Rounding may put the plane of a triangle seen edge on anywhere, even behind the ray, or along it; a ray would then
    pass between that triangle and its neighbour.
    """
    nearest = min(depths[0], depths[1])
    farthest = max(depths[0], depths[1])
    distance = min(distance, max(farthest, depths[2]))
    return max(distance, min(nearest, depths[2]))


def longest_axis(direction: Vector) -> int:
    """The axis along which the direction is longest; the last of equals."""
    x, y, z = abs(direction[0]), abs(direction[1]), abs(direction[2])
    if z >= x and z >= y:
        return 2
    return 1 if y >= x else 0


def turned(a: Vector, last: int) -> Vector:
    """The vector's parts in cyclic order, so that the given axis is the last one."""
    if last == 2:
        return a
    if last == 1:
        return (a[2], a[0], a[1])
    return (a[1], a[2], a[0])


def sheared(a: Vector, shear_x: Scalar, shear_y: Scalar) -> tuple[Scalar, Scalar]:
    """Where a vector ends in the plane across the ray, seen along the ray."""
    return (a[0] - shear_x * a[2], a[1] - shear_y * a[2])


def triangle_normal(a: Vector, b: Vector, c: Vector) -> Vector:
    """The unit normal on the side from which a, b, c run counterclockwise."""
    return normalize(cross(subtract(b, a), subtract(c, a)))
