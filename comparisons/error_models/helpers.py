"""Functions that several of the behaviours here call: source of the tracer, as those are."""

from __future__ import annotations

from functools import cache
from types import FunctionType
from typing import TYPE_CHECKING, cast

from flint import arb

from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.source.features import SPHERES
from raytruth.reference_tracer.source.scene_data import (
    SPHERE_MATERIAL,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.vector import add, cross, dot, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

    Three = tuple[Vector, Vector, Vector]

edge_slack: Scalar = 2.0**-23
"""How far outside of an edge a ray still hits, in parts of the sum of all three products of Plücker coordinates.

Embree's `ulp`, the machine epsilon of float32 (common/math/constants.h line 120)."""


@cache
def under_name(name: str, function: Function) -> Function:
    """A function as a helper of this name, of which there may be one of several; no source of the tracer itself."""
    original = cast("FunctionType", function)
    return FunctionType(original.__code__, original.__globals__, name, original.__defaults__)


def largest_magnitude(x: Scalar, y: Scalar, z: Scalar) -> Scalar:
    """The largest absolute value of three numbers."""
    return max(max(abs(x), abs(y)), abs(z))  # noqa: PLW3301 - balls have a maximum of two


def magnitudes(a: Vector) -> Vector:
    """The absolute value of each coordinate."""
    return (abs(a[0]), abs(a[1]), abs(a[2]))


def cross_terms(a: Vector, b: Vector) -> Vector:
    """How large the terms of a × b are: the vector product with each minus made a plus, of absolute values."""
    x, y, z = magnitudes(a)
    p, q, r = magnitudes(b)
    return (y * r + z * q, z * p + x * r, x * q + y * p)


def triangle_of(scene: SceneData, primitive: int) -> int:
    """The number of a primitive among the triangles; below 0 for a sphere."""
    if SPHERES:
        return primitive - rows_of(scene, SPHERE_MATERIAL)
    return primitive


def corners_of(scene: SceneData, triangle: int) -> Three:
    """The corners a, b and c of a triangle."""
    a = vector_of(scene, TRIANGLE_A, triangle)
    b = vector_of(scene, TRIANGLE_B, triangle)
    return a, b, vector_of(scene, TRIANGLE_C, triangle)


def pluecker_product(edge: Vector, start: Vector, end: Vector, direction: Vector) -> Scalar:
    """On which side of an edge, from start to end, a ray goes by: the product of Plücker coordinates of both.

    Both ends are relative to the ray's origin (Embree 4.4, kernels/geometry/triangle_intersector_pluecker.h, lines
    68-109).
    """
    return dot(cross(edge, add(end, start)), direction)


def pluecker_products(a: Vector, b: Vector, c: Vector, direction: Vector) -> Vector:
    """The Plücker products of a triangle's three edges; all have one sign where the ray, or its line, meets it."""
    u = pluecker_product(subtract(c, a), a, c, direction)
    v = pluecker_product(subtract(a, b), b, a, direction)
    return u, v, pluecker_product(subtract(b, c), c, b, direction)


HELPERS = Behaviour(
    helpers=(
        *(largest_magnitude, magnitudes, cross_terms),
        *(triangle_of, corners_of, pluecker_product, pluecker_products),
    ),
    constants={"edge_slack": arb(edge_slack)},
    name="the helpers of error models",
)
"""What the other behaviours here need to be merged with; it changes nothing by itself."""
