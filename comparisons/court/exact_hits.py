"""Whether a ray hits, in rational numbers: nothing is rounded, so what is found here is proven.

Written apart from the tracer's own tests, none of whose code it shares.

A program may give either answer where the ray only touches: at a tangent of a sphere, or at the rim of triangles, where
rays as near as one likes miss. Where triangles surround the point that is met, on an edge or a corner that they share,
every ray near enough hits, and so must this one: that is what "watertight" means (Woop, Benthin, Wald, "Watertight
Ray/Triangle Intersection", 2013, section 1). A ray in the plane of a triangle misses that triangle (docs/spec.md, TRI).
A box is taken with its faces, edges and corners, since what it bounds may lie there; then its test may miss none.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby
from math import isqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.court.sectors import Direction, Sector, is_counterclockwise, surrounds

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.court.questions import Question

Exact = tuple[Fraction, Fraction, Fraction]

# Bits of a root beside its integer part: twice those of float64, so that rounding it gives what rounding the root does.
_ROOT_BITS = 106


@dataclass(frozen=True)
class Truth:
    """What is proven of a question."""

    hit: bool | None
    """None where the ray only touches, and either answer is right."""
    distance: float | None
    """The least t of a hit or a touch, rounded to float64; None where there is none."""
    primitives: frozenset[int]
    """The triangles of which each is a right answer; empty of other shapes."""


@dataclass(frozen=True)
class _Contact:
    """Where a ray meets a triangle, edges and corners included."""

    distance: Fraction
    primitive: int
    sector: Sector | None
    """How much of the surroundings, seen along the ray, the triangle covers; None for all of it, as inside."""


def truth_of(question: Question) -> Truth:
    """Proven in rational numbers."""
    origin, direction = _exact(question.origin), _exact(question.direction)
    if question.sphere is not None:
        center, radius = question.sphere
        return _sphere(origin, direction, _exact(center), Fraction(radius))
    if question.box is not None:
        return _box(origin, direction, _exact(question.box[0]), _exact(question.box[1]))
    found = (
        _contact(origin, direction, [_exact(corner) for corner in corners], number)
        for number, corners in enumerate(question.triangles)
    )
    return _triangles([contact for contact in found if contact is not None])


def _triangles(contacts: Sequence[_Contact]) -> Truth:
    """The nearest that surround the ray are hit; what it touches in front of them may be answered, too."""
    if not contacts:
        return Truth(hit=False, distance=None, primitives=frozenset())
    contacts = sorted(contacts, key=lambda contact: contact.distance)
    primitives: set[int] = set()
    hit: bool | None = None
    for _, near in groupby(contacts, key=lambda contact: contact.distance):
        together = list(near)
        primitives |= {contact.primitive for contact in together}
        if _is_surrounded(together):
            hit = True
            break
    if hit is None and _is_surrounded(contacts):
        hit = True
    return Truth(hit, float(contacts[0].distance), frozenset(primitives))


def _is_surrounded(contacts: Sequence[_Contact]) -> bool:
    sectors = [contact.sector for contact in contacts if contact.sector is not None]
    return len(sectors) < len(contacts) or surrounds(sectors)


def _contact(origin: Exact, direction: Exact, corners: Sequence[Exact], number: int) -> _Contact | None:
    """By Cramer's rule for o + t·d = a + u·(b-a) + v·(c-a) (Möller, Trumbore 1997, eq. 4)."""
    a, b, c = corners
    first, second = _minus(b, a), _minus(c, a)
    normal = _cross(first, second)
    determinant = -_dot(direction, normal)
    if determinant == 0:
        return None
    to_origin = _minus(origin, a)
    moment = _cross(to_origin, direction)
    u, v = _dot(second, moment) / determinant, -_dot(first, moment) / determinant
    distance = _dot(to_origin, normal) / determinant
    if min(u, v, 1 - u - v) < 0 or distance <= 0:
        return None
    seen = [_seen_along(direction, _minus(corner, origin)) for corner in corners]
    if not is_counterclockwise(seen):
        seen, (u, v) = [seen[0], seen[2], seen[1]], (v, u)
    return _Contact(distance, number, _sector(seen, (1 - u - v, u, v)))


def _sector(corners: Sequence[Direction], weights: tuple[Fraction, Fraction, Fraction]) -> Sector | None:
    """What a triangle covers around one of its points, whose weights at the counterclockwise corners these are."""
    zeros = [index for index, weight in enumerate(weights) if weight == 0]
    if not zeros:
        return None
    if len(zeros) == 1:  # on the edge across from a corner
        start, end = corners[zeros[0] - 2], corners[zeros[0] - 1]
        along = (end[0] - start[0], end[1] - start[1])
        return along, (-along[0], -along[1])
    at = next(index for index, weight in enumerate(weights) if weight != 0)
    here, after, before = corners[at], corners[at - 2], corners[at - 1]
    return (after[0] - here[0], after[1] - here[1]), (before[0] - here[0], before[1] - here[1])


def _seen_along(direction: Exact, to_point: Exact) -> Direction:
    """Where a point lies in the plane of two axes, moved there along the ray, whose place is the plane's origin."""
    last = max(range(3), key=lambda axis: abs(direction[axis]))
    x, y = (last + 1) % 3, (last + 2) % 3
    shift = to_point[last] / direction[last]
    return to_point[x] - shift * direction[x], to_point[y] - shift * direction[y]


def _sphere(origin: Exact, direction: Exact, center: Exact, radius: Fraction) -> Truth:
    """The roots of t²·d² + 2·t·(d·(o-c)) + |o-c|² - r²."""
    to_origin = _minus(origin, center)
    a, half_b = _dot(direction, direction), _dot(direction, to_origin)
    c = _dot(to_origin, to_origin) - radius * radius
    discriminant = half_b * half_b - a * c
    is_ahead = c < 0 or half_b < 0
    if discriminant < 0 or not is_ahead:
        return Truth(hit=False, distance=None, primitives=frozenset())
    root = _root(discriminant)
    distance = (-half_b - root) / a if c > 0 else (-half_b + root) / a
    return Truth(True if discriminant > 0 else None, float(distance), frozenset())


def _root(square: Fraction) -> Fraction:
    """Rounded down, with so many bits that the difference is nothing to float64."""
    bits = 2 * (_ROOT_BITS + square.denominator.bit_length())
    return Fraction(isqrt((square.numerator << bits) // square.denominator), 1 << (bits // 2))


def _box(origin: Exact, direction: Exact, low: Exact, high: Exact) -> Truth:
    """The stretch of t at which the ray is between both planes of each axis."""
    nearest, farthest = Fraction(0), None
    for o, d, least, greatest in zip(origin, direction, low, high, strict=True):
        if d == 0:
            if not least <= o <= greatest:
                return Truth(hit=False, distance=None, primitives=frozenset())
            continue
        enters, leaves = sorted(((least - o) / d, (greatest - o) / d))
        nearest = max(nearest, enters)
        farthest = leaves if farthest is None else min(farthest, leaves)
    assert farthest is not None  # the direction is not 0
    is_hit = nearest <= farthest
    return Truth(is_hit, float(nearest) if is_hit else None, frozenset())


def _exact(point: Sequence[float]) -> Exact:
    x, y, z = map(Fraction, point)
    return x, y, z


def _minus(a: Exact, b: Exact) -> Exact:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _dot(a: Exact, b: Exact) -> Fraction:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Exact, b: Exact) -> Exact:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
