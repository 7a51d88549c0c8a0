"""Vectors and colours: tuples of three numbers."""

from math import sqrt

Vec = tuple[float, float, float]


def add(a: Vec, b: Vec) -> Vec:
    """The sum a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vec, b: Vec) -> Vec:
    """The difference a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(k: float, a: Vec) -> Vec:
    """The vector k times as long."""
    return (k * a[0], k * a[1], k * a[2])


def multiply(a: Vec, b: Vec) -> Vec:
    """The product of two colours, channel by channel."""
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


def dot(a: Vec, b: Vec) -> float:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec, b: Vec) -> Vec:
    """The vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a: Vec) -> float:
    """The length of a vector."""
    return sqrt(dot(a, a))


def unit(a: Vec) -> Vec:
    """The vector of length 1 in the direction of `a`, which is not zero."""
    size = length(a)
    return (a[0] / size, a[1] / size, a[2] / size)
