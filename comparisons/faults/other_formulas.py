"""Legitimate variants by formula: each is algebraically equal to what it stands in for."""

from __future__ import annotations

from math import inf, pi, sqrt, tan
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import Subject, stand_in, words_of
from raytruth.reference_tracer.source.features import BACKGROUND, BACKGROUND_GRADIENT, PERSPECTIVE
from raytruth.reference_tracer.source.scene_data import (
    BACKGROUND_COLOR,
    CAMERA_EXTENT,
    CAMERA_LOOK_AT,
    CAMERA_POSITION,
    CAMERA_SIZE,
    CAMERA_UP,
    CHECKERBOARD_FIRST_AXIS,
    CHECKERBOARD_FIRST_OFFSET,
    CHECKERBOARD_SECOND_AXIS,
    CHECKERBOARD_SECOND_OFFSET,
    CHECKERBOARD_SIZE,
    integer_of,
    number_of,
    vector_of,
)
from raytruth.reference_tracer.source.vector import add, along, cross, dot, negate, normalize, scale, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reference_tracer.arithmetics.edits import Edit, Function
    from raytruth.reference_tracer.source.camera import Frame
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


def variant(function: str, *edits: Edit) -> Callable[[Function], Subject]:
    """Make a legitimate variant of what stands in for a function of the tracer, as `fault` does."""

    def made(body: Function) -> Subject:
        name = body.__name__.replace("_", " ")
        return Subject(name, words_of(body), {function: stand_in(function, body, edits, None)})

    return made


@variant("sphere_distance")
def geometric_sphere(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """By the foot of the perpendicular and the half chord (Akenine-Möller et al., Real-Time Rendering, 22.6.2)."""
    length = sqrt(dot(direction, direction))
    unit = scale(direction, 1.0 / length)
    to_center = subtract(center, origin)
    foot = dot(to_center, unit)
    closest = along(to_center, unit, -foot)
    half_chord_squared = radius * radius - dot(closest, closest)
    if half_chord_squared < 0.0:
        return inf
    half_chord = sqrt(half_chord_squared)
    if foot - half_chord > 0.0:
        return (foot - half_chord) / length
    if foot + half_chord > 0.0:
        return (foot + half_chord) / length
    return inf


@variant("triangle_distance")
def moeller_trumbore_without_threshold(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Möller's and Trumbore's test (1997), with 0 for their threshold, and decided before it divides."""
    first_edge = subtract(b, a)
    second_edge = subtract(c, a)
    p = cross(direction, second_edge)
    determinant = dot(first_edge, p)
    if determinant == 0.0:
        return inf
    to_origin = subtract(origin, a)
    q = cross(to_origin, first_edge)
    u = dot(to_origin, p) / determinant
    v = dot(direction, q) / determinant
    if u < 0.0 or v < 0.0 or u + v > 1.0:
        return inf
    t = dot(second_edge, q) / determinant
    return t if t > 0.0 else inf


MOELLER_TRUMBORE = moeller_trumbore_without_threshold.overrides["triangle_distance"]
"""The textbook's function, which the faults of triangles are edits of."""


@variant("triangle_distance")
def plane_then_edges(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """The plane first, then on which side of each edge the point in it lies (Snyder, Barr 1987)."""
    normal = cross(subtract(b, a), subtract(c, a))
    slope = dot(direction, normal)
    if slope == 0.0:
        return inf
    t = dot(subtract(a, origin), normal) / slope
    if t <= 0.0:
        return inf
    point = along(origin, direction, t)
    if dot(cross(subtract(b, a), subtract(point, a)), normal) < 0.0:
        return inf
    if dot(cross(subtract(c, b), subtract(point, b)), normal) < 0.0:
        return inf
    if dot(cross(subtract(a, c), subtract(point, c)), normal) < 0.0:
        return inf
    return t


@variant("plane_distance")
def plane_by_its_distance_from_the_origin(origin: Vector, direction: Vector, point: Vector, normal: Vector) -> Scalar:
    """In Hesse's normal form, by the unit normal and how far the plane is from the origin along it."""
    unit = normalize(normal)
    slope = dot(direction, unit)
    if slope == 0.0:
        return inf
    t = (dot(point, unit) - dot(origin, unit)) / slope
    return t if t > 0.0 else inf


@variant("mirror_direction")
def reflection_by_parts(direction: Vector, normal: Vector) -> Vector:
    """The part along the surface is kept and the part along the normal turned round."""
    across = scale(normal, dot(direction, normal))
    return subtract(subtract(direction, across), across)


@variant("fresnel_reflectance")
def fresnel_by_definition(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """The mean of both polarisations, as the specification writes it."""
    if cosine == 0.0:
        return 1.0
    across = (cosine - g) / (cosine + g)
    within = (ratio * ratio * cosine - g) / (ratio * ratio * cosine + g)
    return 0.5 * (across * across + within * within)


@variant("refracted_direction")
def refraction_by_the_ratio_of_speeds(
    direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar
) -> Vector:
    """With μ = 1/η and the cosine behind the surface: μ·d + (μ·c - cos θt)·n (Glassner 1989, 4.3)."""
    speed = 1.0 / ratio
    cosine_beyond = sqrt(max(1.0 - speed * speed * (1.0 - cosine * cosine), 0.0))
    return add(scale(direction, speed), scale(normal, speed * cosine - cosine_beyond))


@variant("camera_frame")
def tangent_of_the_half_angle(scene: SceneData) -> Frame:
    """Tan φ/2 = 2·tan φ/4 / (1 - tan² φ/4), and the axes in another order."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    backward = normalize(subtract(position, vector_of(scene, CAMERA_LOOK_AT, 0)))
    right = normalize(cross(vector_of(scene, CAMERA_UP, 0), backward))
    up = cross(backward, right)
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    half_height = 0.5 * number_of(scene, CAMERA_EXTENT, 0)
    if PERSPECTIVE:
        quarter = tan(number_of(scene, CAMERA_EXTENT, 0) * pi / 720.0)
        half_height = 2.0 * quarter / (1.0 - quarter * quarter)
    half_width = half_height * width / height
    corner = add(scale(right, -half_width), scale(up, half_height))
    if PERSPECTIVE:
        corner = subtract(corner, backward)
    pixel_right = scale(right, 2.0 * half_width / width)
    return position, corner, pixel_right, scale(up, -2.0 * half_height / height), negate(backward)


@variant("phong")
def phong_by_the_reflected_light(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """The light is reflected and compared with the viewer, instead of the other way round."""
    reflected = subtract(scale(normal, 2.0 * dot(normal, toward_light)), toward_light)
    highlight: Scalar = max(dot(reflected, negate(direction)), 0.0) ** exponent
    return highlight


@variant("blinn")
def blinn_without_a_halfway_vector(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """n·h = (n·l + n·v)/√(2 + 2·l·v): no halfway vector is made."""
    sines = dot(normal, toward_light) - dot(normal, direction)
    highlight: Scalar = max(sines / sqrt(2.0 - 2.0 * dot(toward_light, direction)), 0.0) ** exponent
    return highlight


@variant("normalize")
def normalised_by_division(a: Vector) -> Vector:
    """Each component is divided by the length."""
    length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    return (a[0] / length, a[1] / length, a[2] / length)


@variant("dot")
def sum_from_the_other_end(a: Vector, b: Vector) -> Scalar:
    """The products are added from the last to the first."""
    return a[2] * b[2] + a[1] * b[1] + a[0] * b[0]


@variant("dot")
def fused_products(a: Vector, b: Vector) -> Scalar:
    """What fused multiply-adds give or better: the products are exact, split by Dekker's method (1971)."""
    total = 0.0
    rest = 0.0
    for axis in range(3):
        shifted_a = 134217729.0 * a[axis]
        shifted_b = 134217729.0 * b[axis]
        high_a = shifted_a - (shifted_a - a[axis])
        high_b = shifted_b - (shifted_b - b[axis])
        low_a = a[axis] - high_a
        low_b = b[axis] - high_b
        product = a[axis] * b[axis]
        rest += ((high_a * high_b - product) + high_a * low_b + low_a * high_b) + low_a * low_b
        total += product
    return total + rest


@variant("medium_transmittance")
def transmittance_as_a_power(absorption: Vector, distance: Scalar) -> Vector:
    """The transmittance of one unit, to the power of the distance."""
    e = 2.718281828459045
    return (
        (1.0 / e ** absorption[0]) ** distance,
        (1.0 / e ** absorption[1]) ** distance,
        (1.0 / e ** absorption[2]) ** distance,
    )


@variant("background_radiance")
def gradient_as_a_difference(scene: SceneData, direction: Vector) -> Vector:
    """Bottom + k·(top - bottom)."""
    if BACKGROUND_GRADIENT:
        bottom = vector_of(scene, BACKGROUND_COLOR, 0)
        height = 0.5 + 0.5 * direction[1]
        return along(bottom, subtract(vector_of(scene, BACKGROUND_COLOR, 1), bottom), height)
    if BACKGROUND:
        return vector_of(scene, BACKGROUND_COLOR, 0)
    return (0.0, 0.0, 0.0)


@variant("is_even_square")
def parity_of_each_axis(scene: SceneData, board: int, point: Vector) -> bool:
    """Even where both axes have the same parity; the size is inverted once."""
    squares = 1.0 / number_of(scene, CHECKERBOARD_SIZE, board)
    u = point[integer_of(scene, CHECKERBOARD_FIRST_AXIS, board)]
    v = point[integer_of(scene, CHECKERBOARD_SECOND_AXIS, board)]
    along_u = (u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) * squares
    along_v = (v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) * squares
    return (along_u // 1.0) % 2.0 == (along_v // 1.0) % 2.0
