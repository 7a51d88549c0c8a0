"""Textbook forms of functions of the tracer, as overrides of the robust ones: for the speed-accuracy study.

In exact arithmetic each gives what the tracer's own form gives. They differ in what rounding does to them, and in time.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.vector import along, cross, dot, scale, subtract

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def plain_sphere_constant(origin: Vector, center: Vector, radius: Scalar) -> Scalar:
    """|o-c|² - r² as it stands, which loses most digits close to a large sphere."""
    to_origin = subtract(origin, center)
    return dot(to_origin, to_origin) - radius * radius


def quadratic_sphere_distance(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """The textbook's (-b ± √(b² - 4ac))/2a (Shirley et al., Fundamentals of Computer Graphics, 3rd ed., 4.4.1)."""
    to_origin = subtract(origin, center)
    a = dot(direction, direction)
    b = 2.0 * dot(direction, to_origin)
    c = dot(to_origin, to_origin) - radius * radius
    discriminant = b * b - 4.0 * a * c
    if discriminant < 0.0:
        return inf
    root = sqrt(discriminant)
    nearer = (-b - root) / (2.0 * a)
    if nearer > 0.0:
        return nearer
    farther = (-b + root) / (2.0 * a)
    if farther > 0.0:
        return farther
    return inf


def perpendicular_sphere_distance(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """Both remedies of Haines, Günther, Akenine-Möller ("Precision Improvements for Ray/Sphere Intersection", 2019).

    The discriminant comes from the distance between centre and line (eq. 5), the roots from their product (eq. 10 to
    12); |o-c|² - r² is computed as it stands.
    """
    to_origin = subtract(origin, center)
    a = dot(direction, direction)
    b = -dot(direction, to_origin)
    closest = along(to_origin, direction, b / a)
    discriminant = a * (radius * radius - dot(closest, closest))
    if discriminant < 0.0:
        return inf
    c = dot(to_origin, to_origin) - radius * radius
    q = b + sqrt(discriminant) if b > 0.0 else b - sqrt(discriminant)
    if c > 0.0:
        return min(c / q, b / a) if b > 0.0 else inf
    return q / a if b > 0.0 else c / q


def moeller_trumbore(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997: their code without culling.

    With their test |determinant| < ε = 1e-6, which no scale can live with.
    """
    first_edge = subtract(b, a)
    second_edge = subtract(c, a)
    p = cross(direction, second_edge)
    determinant = dot(first_edge, p)
    if determinant > -1e-6 and determinant < 1e-6:
        return inf
    inverse = 1.0 / determinant
    to_origin = subtract(origin, a)
    u = dot(to_origin, p) * inverse
    if u < 0.0 or u > 1.0:
        return inf
    q = cross(to_origin, first_edge)
    v = dot(direction, q) * inverse
    if v < 0.0 or u + v > 1.0:
        return inf
    t = dot(second_edge, q) * inverse
    return t if t > 0.0 else inf


def cramer_triangle_distance(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Cramer's rule for o + t·d = a + u·(b-a) + v·(c-a) (Möller, Trumbore 1997, eq. 4), decided before dividing."""
    first_edge = subtract(b, a)
    second_edge = subtract(c, a)
    normal = cross(first_edge, second_edge)
    determinant = -dot(direction, normal)
    to_origin = subtract(origin, a)
    moment = cross(to_origin, direction)
    u = dot(second_edge, moment)
    v = -dot(first_edge, moment)
    w = determinant - u - v
    # Beside the triangle, even where a ray along its plane leaves the determinant's sign undecided in balls.
    if (certainly_less(u, 0.0) or certainly_less(v, 0.0) or certainly_less(w, 0.0)) and (
        certainly_less(0.0, u) or certainly_less(0.0, v) or certainly_less(0.0, w)
    ):
        return inf
    t = dot(to_origin, normal)
    if determinant < 0.0:
        determinant, u, v, t = -determinant, -u, -v, -t
    elif determinant == 0.0:
        return inf
    # The edges first: from a coplanar neighbour, as in a floor of two triangles, t is 0 and undecidable in balls.
    if u < 0.0 or v < 0.0 or u + v > determinant or t <= 0.0:
        return inf
    return t / determinant


def cosine_fresnel_reflectance(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """Fresnel's r_s and r_p by both cosines (Born, Wolf, Principles of Optics, 7th ed., 1.5.2); g = η·cos θt."""
    if cosine == 0.0:
        return 1.0
    beyond = g / ratio
    across = (cosine - ratio * beyond) / (cosine + ratio * beyond)
    within = (ratio * cosine - beyond) / (ratio * cosine + beyond)
    return 0.5 * (across * across + within * within)


def angle_refracted_direction(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:  # noqa: ARG001 - the signature of refracted_direction
    """Snell's law by the sines of both angles: sin θt along the surface, cos θt along the normal.

    Foley, van Dam, Feiner, Hughes, Computer Graphics: Principles and Practice, 2nd ed., 16.5.2.
    """
    tangential = along(direction, normal, cosine)
    sine = sqrt(dot(tangential, tangential))
    if sine == 0.0:
        return direction
    sine_beyond = sine / ratio
    cosine_beyond = sqrt(max(0.0, 1.0 - sine_beyond * sine_beyond))
    return along(scale(tangential, sine_beyond / sine), normal, -cosine_beyond)


def direct_snell_discriminant(cosine: Scalar, ratio: Scalar) -> Scalar:
    """η²·(1 - sin²θi/η²) with sin²θi = 1 - c²: cancels near grazing, and for nearly equal indices."""
    return ratio * ratio * (1.0 - (1.0 - cosine * cosine) / (ratio * ratio))


PLAIN_FORMS: Mapping[str, Callable[..., object]] = {
    "sphere_constant": plain_sphere_constant,
    "triangle_distance": cramer_triangle_distance,
}
"""For balls, which carry their own error: fewer operations, and no choice of an axis, which they might not decide."""

VARIANTS: Mapping[str, Mapping[str, Callable[..., object]]] = {
    "quadratic-sphere": {"sphere_distance": quadratic_sphere_distance},
    "perpendicular-sphere": {"sphere_distance": perpendicular_sphere_distance},
    "moeller-trumbore": {"triangle_distance": moeller_trumbore},
    "cramer-triangle": {"triangle_distance": cramer_triangle_distance},
    "cosine-fresnel": {"fresnel_reflectance": cosine_fresnel_reflectance},
    "refraction-by-angles": {
        "snell_discriminant": direct_snell_discriminant,
        "refracted_direction": angle_refracted_direction,
    },
}
"""Name, and the functions that it replaces."""
