"""The formulas by which most tracers find where a ray meets a sphere, each with both of its roots.

They are equal in exact arithmetic. Each is evaluated step by step as it is written, so that balls lose what it loses.
A direction is a unit vector in most of these programs, but for its rounding, and some formulas leave its length out:
`squared_length` holds both. The functions here are source of the tracer, as those of triangle_tests.py.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from flint import arb

from raytruth.comparisons.error_models.helpers import under_name
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.compensated import sphere_constant
from raytruth.reference_tracer.source.vector import along, dot, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector

    Roots = tuple[Scalar, Scalar]
    """Both t at which the line meets the sphere, the smaller one first; infinity twice where it does not."""

about_one_squared: Scalar = 1.0
"""What the squared length may be of what was just made a unit vector."""
nearly_a_unit: Scalar = 0.0
"""How far the squared length of what is meant for a unit vector may be from 1."""
between_nothing_and_all: Scalar = 0.0
"""Between 0 and 1: how much of that a formula sees."""
either_way: Scalar = 0.0
"""Between -1 and 1: a root of which nothing but a bound is known."""

# A vector is made a unit vector with a squared length off by 12 roundoffs at most: 3 of its own square, a root, a
# quotient and a product, each of these three twice, and 3 of the square that is taken of it. Four are for the products
# of errors, and for who takes the reciprocal first.
ONE_UNIT_ROUNDOFFS = 16
# Each mirror or refraction adds no more than that where the normal is a unit vector: this is enough for 15 in a row.
# Where it is not, the squared length is further from 1, and a formula that leaves it out is wrong by that.
UNIT_ROUNDOFFS = 256


def sphere_formula_behaviour(error_model: ErrorModel) -> Behaviour:
    """The formula that `sphere_roots` is, for the functions of ray_policies.py; the constants are balls."""
    formulas = {
        "accurate": accurate_roots,
        "quadratic": quadratic_roots,
        "stable quadratic": stable_quadratic_roots,
        "geometric": geometric_roots,
    }
    unit = error_model.directions == "normalised"
    return Behaviour(
        helpers=(
            under_name("squared_length", squared_length_of_unit if unit else squared_length),
            under_name("sphere_roots", formulas[error_model.sphere_test]),
        ),
        constants={
            "about_one_squared": arb(1, ONE_UNIT_ROUNDOFFS * 2.0**-error_model.precision_bits),
            "nearly_a_unit": arb(UNIT_ROUNDOFFS * 2.0**-error_model.precision_bits),
            "between_nothing_and_all": arb(0.5, 0.5),
            "either_way": arb(0, 1),
        },
        name="the formula for spheres",
    )


def squared_length(direction: Vector) -> Scalar:
    """The squared length of a direction, or anything between it and 1 for what may be taken for a unit vector."""
    squared = dot(direction, direction)
    off = 1.0 - squared
    if certainly_less(abs(off), nearly_a_unit):
        return squared + off * between_nothing_and_all
    return squared


def squared_length_of_unit(direction: Vector) -> Scalar:  # noqa: ARG001 - the signature of the function that it stands for
    """The same of a direction that was just made a unit vector: balls do not know that all of its parts make 1."""
    return about_one_squared


def accurate_roots(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Roots:
    """As `sphere_distance` of the truth: the squared half chord by whichever way loses less, a root by the product."""
    to_origin = subtract(origin, center)
    direction_squared = squared_length(direction)
    foot = -dot(direction, to_origin) / direction_squared
    radius_squared = radius * radius
    constant = dot(to_origin, to_origin) - radius_squared
    if certainly_less(radius_squared, constant):
        closest = along(to_origin, direction, foot)
        half_chord_squared = (radius_squared - dot(closest, closest)) / direction_squared
    else:
        constant = sphere_constant(origin, center, radius)
        half_chord_squared = foot * foot - constant / direction_squared
    if half_chord_squared < 0.0:
        return inf, inf
    half_chord = sqrt(half_chord_squared)
    product = constant / direction_squared
    if certainly_less(0.0, foot):
        farther = foot + half_chord
        return product / farther, farther
    nearer = foot - half_chord
    if certainly_less(nearer, 0.0):
        return nearer, product / nearer
    return nearer, foot + half_chord


def quadratic_roots(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Roots:
    """The textbook's (-b ± √(b² - 4ac))/2a (Shirley et al., Fundamentals of Computer Graphics, 3rd ed., 4.4.1).

    With half of b the same is computed with fewer roundings, since powers of two round nothing.
    """
    to_origin = subtract(origin, center)
    a = squared_length(direction)
    b = 2.0 * dot(direction, to_origin)
    c = dot(to_origin, to_origin) - radius * radius
    discriminant = b * b - 4.0 * a * c
    if discriminant < 0.0:
        return inf, inf
    root = sqrt(discriminant)
    return (-b - root) / (2.0 * a), (-b + root) / (2.0 * a)


def stable_quadratic_roots(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Roots:
    """By q = -(b + sign(b)·√(b² - 4ac))/2, q/a and c/q (Press et al., Numerical Recipes, 3rd ed., 5.6).

    Where balls do not know that q is not 0, they know of c/q that |q| is at least √|ac|, but for rounding: so it is
    within twice √|c/a|.
    """
    to_origin = subtract(origin, center)
    a = squared_length(direction)
    b = 2.0 * dot(direction, to_origin)
    c = dot(to_origin, to_origin) - radius * radius
    discriminant = b * b - 4.0 * a * c
    if discriminant < 0.0:
        return inf, inf
    root = sqrt(discriminant)
    is_ahead = b < 0.0
    q = -0.5 * (b - root) if is_ahead else -0.5 * (b + root)
    other = c / q if certainly_less(0.0, abs(q)) else 2.0 * sqrt(abs(c) / a) * either_way
    if is_ahead:
        return other, q / a
    return q / a, other


def geometric_roots(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Roots:
    """By the foot of the perpendicular, its squared length and the half chord: t_ca, d² and t_hc.

    Haines, "Essential Ray Tracing Algorithms", in Glassner (ed.), An Introduction to Ray Tracing, 1989, section 2.2.
    """
    to_center = subtract(center, origin)
    squared = squared_length(direction)
    length = sqrt(squared)
    foot = dot(to_center, direction) / length
    distance_squared = dot(to_center, to_center) - foot * foot
    radius_squared = radius * radius
    if distance_squared > radius_squared:
        return inf, inf
    half_chord = sqrt(radius_squared - distance_squared)
    return (foot - half_chord) / length, (foot + half_chord) / length
