"""Faults in the shared source, beside those of comparisons/faults: each one function gone wrong."""

from __future__ import annotations

from math import floor, inf, sqrt
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.illumination import diffuse
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.refraction import fresnel_reflectance
from raytruth.reference_tracer.source.scene_data import (
    BACKGROUND_COLOR,
    CHECKERBOARD_FIRST_OFFSET,
    CHECKERBOARD_SECOND_OFFSET,
    CHECKERBOARD_SIZE,
    LIGHT_FALLOFF_COEFFICIENTS,
    MATERIAL_DIFFUSE,
    MATERIAL_DIFFUSE_BOARD,
    MATERIAL_REFLECTANCE,
    MATERIAL_TRANSMITTANCE,
    number_of,
    vector_of,
)
from raytruth.reference_tracer.source.texture import textured
from raytruth.reference_tracer.source.vector import add, along, cross, dot, multiply, negate, normalize, scale, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


def cosine_squared(
    scene: SceneData,
    primitive: int,
    material: int,
    point: Vector,
    normal: Vector,
    direction: Vector,
    to_light: Vector,
    light_is_near: bool,
    arriving: Vector,
) -> Vector:
    """Lambert's cosine counts twice."""
    cosine = dot(normal, normalize(to_light))
    if cosine <= 0.0:
        return (0.0, 0.0, 0.0)
    return multiply(scale(diffuse(scene, material, point), cosine * cosine), arriving)


def no_pi(scene: SceneData, material: int, point: Vector) -> Vector:
    """Lambert's reflectance is not divided by π."""
    return textured(scene, MATERIAL_DIFFUSE, MATERIAL_DIFFUSE_BOARD, material, point)


def unclamped_attenuation(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """A light may become stronger than it is."""
    constant, linear, quadratic = vector_of(scene, LIGHT_FALLOFF_COEFFICIENTS, light)
    return 1.0 / (constant + linear * sqrt(distance_squared) + quadratic * distance_squared)


def half_of_the_exponent(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """Phong's highlight is too wide."""
    cosine = dot(mirror_direction(direction, normal), toward_light)
    highlight: Scalar = max(cosine, 0.0) ** (0.5 * exponent)
    return highlight


def parallelogram(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """The third edge is forgotten."""
    first_edge = subtract(b, a)
    second_edge = subtract(c, a)
    normal = cross(first_edge, second_edge)
    determinant = -dot(direction, normal)
    to_origin = subtract(origin, a)
    moment = cross(to_origin, direction)
    u = dot(second_edge, moment) / determinant
    v = -dot(first_edge, moment) / determinant
    t = dot(to_origin, normal) / determinant
    if u < 0.0 or v < 0.0 or u > 1.0 or v > 1.0 or t <= 0.0:
        return inf
    return t


def squares_in_one_floor(scene: SceneData, board: int, point: Vector) -> bool:
    """Column and row are added before they are rounded down: diagonal stripes."""
    size = number_of(scene, CHECKERBOARD_SIZE, board)
    u = (point[0] - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size
    v = (point[1] - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size
    return floor(u + v) % 2 == 0


def upper_half_of_the_sky(scene: SceneData, direction: Vector) -> Vector:
    """The gradient goes from the horizon to the top."""
    height = max(direction[1], 0.0)
    return add(
        scale(vector_of(scene, BACKGROUND_COLOR, 0), 1.0 - height),
        scale(vector_of(scene, BACKGROUND_COLOR, 1), height),
    )


def mirrored_behind_the_surface(direction: Vector, normal: Vector) -> Vector:
    """The formula for a vector that points away from the surface, used for one that arrives."""
    return along(negate(direction), normal, 2.0 * dot(direction, normal))


def fresnel_without_half(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """The two polarisations are added, not averaged."""
    perpendicular = (ratio - 1.0) * (ratio + 1.0) / ((g + cosine) * (g + cosine))
    sine_squared = (1.0 - cosine) * (1.0 + cosine)
    quotient = (cosine * g - sine_squared) / (cosine * g + sine_squared)
    return perpendicular * perpendicular * (1.0 + quotient * quotient)


def radiance_not_scaled(
    scene: SceneData, material: int, cosine: Scalar, g: Scalar, ratio: Scalar
) -> tuple[Vector, Vector]:
    """The transmitted weight lacks 1/η²."""
    reflected = fresnel_reflectance(cosine, g, ratio)
    transmitted = 1.0 - reflected
    return (reflected, reflected, reflected), (transmitted, transmitted, transmitted)


def radiance_scaled_the_wrong_way(
    scene: SceneData, material: int, cosine: Scalar, g: Scalar, ratio: Scalar
) -> tuple[Vector, Vector]:
    """Times η² in place of 1/η²."""
    reflected = fresnel_reflectance(cosine, g, ratio)
    transmitted = (1.0 - reflected) * ratio * ratio
    return (reflected, reflected, reflected), (transmitted, transmitted, transmitted)


def exchanged_constants(
    scene: SceneData, material: int, cosine: Scalar, g: Scalar, ratio: Scalar
) -> tuple[Vector, Vector]:
    """What Whitted calls ks is taken for kt."""
    return vector_of(scene, MATERIAL_TRANSMITTANCE, material), vector_of(scene, MATERIAL_REFLECTANCE, material)


def total_reflection_of_everything(scene: SceneData, material: int) -> Vector:
    """Beyond the critical angle the stated ks is ignored."""
    return (1.0, 1.0, 1.0)


def linear_absorption(absorption: Vector, distance: Scalar) -> Vector:
    """The first two terms of the exponential's series."""
    return (1.0 - absorption[0] * distance, 1.0 - absorption[1] * distance, 1.0 - absorption[2] * distance)


def always_into_empty_space(scene: SceneData, material: int, entering: bool) -> int:
    """What leaves a bubble is thought to leave the glass around it."""
    return material if entering else -1


def three_quarters_of_the_way(origin: Vector, direction: Vector, center: Vector) -> Scalar:
    """A ray inside a sphere ends before the other side."""
    half_linear = dot(direction, subtract(origin, center))
    if half_linear >= 0.0:
        return inf
    return -1.5 * half_linear / dot(direction, direction)


def discriminant_without_sign(cosine: Scalar, ratio: Scalar) -> Scalar:
    """Beyond the critical angle rays are refracted all the same."""
    return abs((ratio - 1.0) * (ratio + 1.0) + cosine * cosine)
