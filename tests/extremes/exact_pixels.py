"""Pixels in exact balls, and the right values of small scenes in fractions, for tests of ties."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

from flint import ctx

from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.exact_arithmetic import ExactArithmetic
from raytruth.reference_tracer.certification import FEWEST_BITS, MOST_WORK, Enclosure, enclosure_of
from raytruth.reference_tracer.tables import build_tables
from raytruth.reference_tracer.ties import RaisingDecisions
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.reference_tracer.arithmetics.arithmetic import Kernel
    from raytruth.scenes.scene import Scene

    Point = tuple[Fraction, ...]


@cache
def exact_kernel(features: frozenset[str]) -> tuple[ExactArithmetic, Kernel]:
    exact = ExactArithmetic(RaisingDecisions())
    return exact, make_kernel(exact.arithmetic, features)


def exact_pixel(scene: Scene, column: int = 0, row: int = 0) -> Enclosure:
    """As a Certifier has it, but for kernels that are kept from scene to scene. Raises UndecidedComparisonError."""
    features = frozenset(required_features(scene))
    with ctx.workprec(FEWEST_BITS):
        exact, kernel = exact_kernel(features)
        data = build_tables(scene, features, exact.arithmetic)
        exact.restart(MOST_WORK)
        number = exact.arithmetic.number
        frame = kernel.camera_frame(data)
        color = kernel.radiance_at(data, frame, number(column + 0.5), number(row + 0.5))
        return enclosure_of([channel.ball for channel in color])


def holds_root(enclosure: Enclosure, square: Fraction) -> bool:
    """Whether the first channel encloses the square root of a fraction, as narrowly as float64 allows."""
    middle, radius = Fraction(enclosure.middle[0]), Fraction(enclosure.radius[0])
    low, high = max(middle - radius, Fraction(0)), middle + radius
    return low * low <= square <= high * high and radius <= Fraction(math.ulp(enclosure.middle[0]))


def minus(a: Sequence[Any], b: Sequence[Any]) -> Point:
    return tuple(Fraction(x) - Fraction(y) for x, y in zip(a, b, strict=True))


def dot(a: Sequence[Any], b: Sequence[Any]) -> Fraction:
    return sum((Fraction(x) * Fraction(y) for x, y in zip(a, b, strict=True)), Fraction(0))


def cross(a: Sequence[Any], b: Sequence[Any]) -> Point:
    (ax, ay, az), (bx, by, bz) = a, b
    return (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)


def triangle_hides(triangle: Sequence[Sequence[Any]], start: Sequence[Any], light: Sequence[Any]) -> bool:
    """Whether the triangle, edges included, meets the open segment: by its plane, then by the sides of its edges."""
    corners = [tuple(map(Fraction, corner)) for corner in triangle]
    normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
    way = minus(light, start)
    slope = dot(way, normal)
    if slope == 0:
        return False
    t = dot(minus(corners[0], start), normal) / slope
    point = tuple(Fraction(s) + t * w for s, w in zip(start, way, strict=True))
    sides = [
        dot(cross(minus(corners[(i + 1) % 3], corners[i]), minus(point, corners[i])), normal) >= 0 for i in range(3)
    ]
    return 0 < t < 1 and all(sides)


def sphere_hides_from_outside(
    center: Sequence[Any], radius: Fraction, start: Sequence[Any], light: Sequence[Any]
) -> bool:
    """Whether a sphere meets the open segment from a point outside to a light on the sphere: its other root is less."""
    way = minus(light, start)
    constant = dot(minus(start, center), minus(start, center)) - radius * radius
    return constant / dot(way, way) < 1  # the product of both roots, one of which is 1
