"""Vectors of three scalars."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def add(a: Vector, b: Vector) -> Vector:
    """The sum a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    """The difference a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def negate(a: Vector) -> Vector:
    """-a."""
    return (-a[0], -a[1], -a[2])


def scale(a: Vector, factor: Scalar) -> Vector:
    """Each component of a times the factor."""
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def multiply(a: Vector, b: Vector) -> Vector:
    """Component by component: how a colour filters another."""
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


def dot(a: Vector, b: Vector) -> Scalar:
    """The scalar product a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product a × b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a: Vector) -> Vector:
    """The unit vector along a, which must not be zero."""
    return scale(a, 1.0 / sqrt(dot(a, a)))


def along(origin: Vector, direction: Vector, distance: Scalar) -> Vector:
    """The point of a ray at a distance, in units of the direction's length."""
    return add(origin, scale(direction, distance))
