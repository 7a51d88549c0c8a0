"""The formulas by which most tracers find where a ray meets a triangle, in place of the watertight test of the truth.

They are equal in exact arithmetic; each is evaluated step by step as it is written. What they give is the t of the
line, which may be negative, or infinity beside the triangle: who asks for it leaves out what is too near. To compare it
with 0 here as well would leave open, for each triangle that a ray starts on, what makes no difference.

The functions here are source of the tracer, as those of triangle_tests.py.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.helpers import largest_magnitude, under_name
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import along, cross, dot, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector

least_determinant: Scalar = 0.0
"""What the determinant of Möller and Trumbore's test is compared with, their EPSILON."""


def triangle_formula_behaviour(error_model: ErrorModel) -> Behaviour:
    """The formula that `triangle_root` is, for the functions of ray_policies.py."""
    formulas = {
        "watertight": plain_root,
        "moeller-trumbore of 1997": moeller_trumbore_root,
        "cramer": cramer_root,
        "plane and inside": plane_and_inside_root,
    }
    formula = formulas.get(error_model.triangle_test, root_by_test)
    least = error_model.least_determinant
    return Behaviour(
        helpers=(
            beside_triangle,
            under_name("triangle_root", formula),
            under_name("is_edge_on", is_small if least > 0.0 else is_zero),
        ),
        constants={"least_determinant": stored_number(least, error_model.precision_bits)},
        name="the formula for triangles",
    )


def is_zero(determinant: Scalar) -> bool:
    """Whether a ray is parallel to a triangle, for who asks that and no more."""
    return determinant == 0.0


def is_small(determinant: Scalar) -> bool:
    """The same for who calls it parallel where the determinant is small, whatever the triangle's size."""
    return abs(determinant) < least_determinant


is_edge_on: Callable[[Scalar], bool] = is_zero
"""The one of these that is declared."""


def root_by_test(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """By one of triangle_tests.py, which leaves out what is behind."""
    return triangle_distance(origin, direction, a, b, c)


def plain_root(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """As balls have the truth's own: the watertight test's choice of an axis is one that they might not decide."""
    first_edge, second_edge, to_origin = subtract(b, a), subtract(c, a), subtract(origin, a)
    normal = cross(first_edge, second_edge)
    determinant = -dot(direction, normal)
    moment = cross(to_origin, direction)
    u = dot(second_edge, moment)
    v = -dot(first_edge, moment)
    if beside_triangle(u, v, determinant - u - v) or determinant == 0.0:
        return inf
    side = 1.0 if determinant > 0.0 else -1.0
    if side * u < 0.0 or side * v < 0.0 or side * (u + v) > side * determinant:
        return inf
    return dot(to_origin, normal) / determinant


def beside_triangle(u: Scalar, v: Scalar, w: Scalar) -> bool:
    """Whether weights surely have different signs, so that a ray misses, even if it may be in the triangle's plane."""
    some_below = certainly_less(u, 0.0) or certainly_less(v, 0.0) or certainly_less(w, 0.0)
    return some_below and (certainly_less(0.0, u) or certainly_less(0.0, v) or certainly_less(0.0, w))


def moeller_trumbore_root(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997: their steps in their order.

    Weights are compared before they are divided, where balls still know their signs; a quotient with the determinant is
    rounded up to three times in the program, and so is the determinant here. Their EPSILON is `least_determinant`.
    """
    first_edge, second_edge = subtract(b, a), subtract(c, a)
    p = cross(direction, second_edge)
    determinant = dot(first_edge, p)
    to_origin = subtract(origin, a)
    u = dot(to_origin, p)
    q = cross(to_origin, first_edge)
    v = dot(direction, q)
    if beside_triangle(u, v, determinant - u - v) or is_edge_on(determinant):
        return inf
    side = 1.0 if determinant > 0.0 else -1.0
    if side * u < 0.0 or side * v < 0.0 or side * (u + v) > side * determinant * 1.0 * 1.0 * 1.0:
        return inf
    return dot(second_edge, q) * (1.0 / determinant)


def cramer_root(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Cramer's rule for (a - b)·u + (a - c)·v + d·t = a - o, each determinant by its first column.

    Shirley et al., Fundamentals of Computer Graphics, 3rd ed., section 4.4.2. As above, weights are compared before
    they are divided.
    """
    first_edge, second_edge, to_corner = subtract(a, b), subtract(a, c), subtract(a, origin)
    across = cross(second_edge, direction)
    determinant = dot(first_edge, across)
    u = dot(to_corner, across)
    v = dot(first_edge, cross(to_corner, direction))
    if beside_triangle(u, v, determinant - u - v) or determinant == 0.0:
        return inf
    side = 1.0 if determinant > 0.0 else -1.0
    if side * u < 0.0 or side * v < 0.0 or side * (u + v) > side * determinant * 1.0 * 1.0 * 1.0:
        return inf
    return dot(first_edge, cross(second_edge, to_corner)) * (1.0 / determinant)


def plane_and_inside_root(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Where the ray meets the plane, and whether that point is on the inner side of each edge, by vector products.

    Snyder, Barr, "Ray Tracing Complex Models Containing Surface Tessellations", 1987, with the plane as n·p = n·a.
    """
    first_edge = subtract(b, a)
    normal = cross(first_edge, subtract(c, a))
    determinant = dot(normal, direction)
    height = dot(normal, a) - dot(normal, origin)
    if not certainly_less(0.0, abs(determinant)):
        # Of a plane seen edge on balls know no distance, but may know that it is met beyond all of the triangle: twice
        # as far away as its farthest corner, so that no edge's product of a triangle with angles above some roundoffs,
        # as a program may compute it, has the wrong sign.
        to_a, to_b, to_c = subtract(a, origin), subtract(b, origin), subtract(c, origin)
        farthest = largest_magnitude(sqrt(dot(to_a, to_a)), sqrt(dot(to_b, to_b)), sqrt(dot(to_c, to_c)))
        if certainly_less(2.0 * abs(determinant) * farthest, abs(height) * sqrt(dot(direction, direction))):
            return inf
    if determinant == 0.0:
        return inf
    distance = height / determinant
    point = along(origin, direction, distance)
    u = dot(normal, cross(first_edge, subtract(point, a)))
    v = dot(normal, cross(subtract(c, b), subtract(point, b)))
    w = dot(normal, cross(subtract(a, c), subtract(point, c)))
    if u < 0.0 or v < 0.0 or w < 0.0:
        return inf
    return distance
