"""The local terms of the lighting equation: emission, ambient, diffuse, specular (docs/spec.md, ILL)."""

from __future__ import annotations

from math import pi, sqrt
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.features import (
    AMBIENT,
    BLINN,
    DIFFUSE,
    DIRECTIONAL_LIGHTS,
    EMISSION,
    INVERSE_SQUARE_FALLOFF,
    PHONG,
    POINT_LIGHTS,
    POLYNOMIAL_FALLOFF,
    RADIOMETRIC,
)
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.scene_data import (
    AMBIENT_LIGHT,
    LIGHT_FALLOFF,
    LIGHT_FALLOFF_COEFFICIENTS,
    LIGHT_INTENSITY,
    LIGHT_POSITION,
    MATERIAL_AMBIENT,
    MATERIAL_DIFFUSE,
    MATERIAL_DIFFUSE_BOARD,
    MATERIAL_EMISSION,
    MATERIAL_EMISSION_BOARD,
    MATERIAL_EXPONENT,
    MATERIAL_IS_BLINN,
    MATERIAL_IS_LIT,
    MATERIAL_SPECULAR,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    SceneData,
    integer_of,
    number_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import is_shadowed
from raytruth.reference_tracer.source.texture import textured
from raytruth.reference_tracer.source.vector import add, dot, multiply, negate, normalize, scale, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector

INVERSE_SQUARE = 1
POLYNOMIAL = 2
"""Kinds of attenuation in `light_falloff`; 0 is none."""


def local_illumination(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """What the surface sends back along the viewing ray without reflection and refraction.

    `normal` is turned to the viewer, `direction` is that of the viewing ray; both are unit vectors.
    """
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, emission(scene, material, point))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        for light in range(rows_of(scene, LIGHT_POSITION)):
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), point)
            arriving = scale(
                vector_of(scene, LIGHT_INTENSITY, light), attenuation(scene, light, dot(to_light, to_light))
            )
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving)
            total = add(total, lit)
    if DIRECTIONAL_LIGHTS:
        for sun in range(rows_of(scene, SUN_DIRECTION)):
            to_light = negate(vector_of(scene, SUN_DIRECTION, sun))
            arriving = vector_of(scene, SUN_IRRADIANCE, sun)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
            total = add(total, lit)
    return total


def emission(scene: SceneData, material: int, point: Vector) -> Vector:
    """The radiance the surface sends out by itself."""
    return textured(scene, MATERIAL_EMISSION, MATERIAL_EMISSION_BOARD, material, point)


def ambient(scene: SceneData, material: int) -> Vector:
    """The ambient term ka·Od·Ia of the classical equation."""
    return multiply(vector_of(scene, MATERIAL_AMBIENT, material), vector_of(scene, AMBIENT_LIGHT, 0))


def attenuation(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """How much of a point light's intensity arrives: 1/d², or min(1, 1/(a + b·d + c·d²)), or all of it."""
    if INVERSE_SQUARE_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == INVERSE_SQUARE:
            return 1.0 / distance_squared
    if POLYNOMIAL_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == POLYNOMIAL:
            constant, linear, quadratic = vector_of(scene, LIGHT_FALLOFF_COEFFICIENTS, light)
            divisor = constant + linear * sqrt(distance_squared) + quadratic * distance_squared
            if divisor > 1.0:
                return 1.0 / divisor
    return 1.0


def direct_light(
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
    """The diffuse and specular terms of one light: nothing if it is behind the surface or hidden."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    cosine = dot(normal, toward_light)
    faces_light = cosine > 0.0
    if not faces_light:  # also where the light is at the point itself, and so has no direction and no cosine
        return (0.0, 0.0, 0.0)
    if is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), cosine))
    if PHONG or BLINN:
        highlight = specular(scene, material, normal, direction, toward_light)
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


def diffuse(scene: SceneData, material: int, point: Vector) -> Vector:
    """kd·Od in the classical convention, Lambert's ρ/π in the radiometric one."""
    reflectance = textured(scene, MATERIAL_DIFFUSE, MATERIAL_DIFFUSE_BOARD, material, point)
    if RADIOMETRIC:
        return scale(reflectance, 1.0 / pi)
    return reflectance


def specular(scene: SceneData, material: int, normal: Vector, direction: Vector, toward_light: Vector) -> Scalar:
    """The highlight: Phong's (r·v)^n (Phong 1975) or Blinn's (n·h)^n (Blinn 1977), 0 where the cosine is negative."""
    exponent = number_of(scene, MATERIAL_EXPONENT, material)
    if PHONG and BLINN:
        if integer_of(scene, MATERIAL_IS_BLINN, material):
            return blinn(normal, direction, toward_light, exponent)
        return phong(normal, direction, toward_light, exponent)
    if BLINN:
        return blinn(normal, direction, toward_light, exponent)
    return phong(normal, direction, toward_light, exponent)


def phong(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """(r·v)^n: r is where a mirror would send the light, v the direction to the viewer."""
    cosine = dot(mirror_direction(direction, normal), toward_light)
    highlight: Scalar = max(cosine, 0.0) ** exponent
    return highlight


def blinn(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """(n·h)^n: h halves the angle between the directions to the light and to the viewer."""
    halfway = subtract(toward_light, direction)
    cosine = dot(normal, normalize(halfway))
    highlight: Scalar = max(cosine, 0.0) ** exponent
    return highlight
