"""Faults in specular highlights (docs/spec.md, ILL-2, ILL-5 and ILL-6)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.features import BLINN, DIFFUSE, PHONG
from raytruth.reference_tracer.source.illumination import diffuse, specular
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.scene_data import MATERIAL_IS_LIT, MATERIAL_SPECULAR, integer_of, vector_of
from raytruth.reference_tracer.source.shadow import is_shadowed
from raytruth.reference_tracer.source.vector import add, dot, multiply, normalize, scale, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("ILL-2", "direct_light", "Can a light behind the surface make a highlight on its front?")
def highlight_on_the_dark_side(
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
    """The diffuse term is clamped, but the highlight is added where the light is behind the surface, too."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    cosine = dot(normal, toward_light)
    if cosine > 0.0 and is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), max(cosine, 0.0)))
    if PHONG or BLINN:
        highlight = specular(scene, material, normal, direction, toward_light)
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


@fault("ILL-2", "direct_light", "Which factors has the specular term of the classical equation?")
def highlight_times_cosine(
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
    """The highlight is multiplied by n·l like the diffuse term."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    cosine = dot(normal, toward_light)
    faces_light = cosine > 0.0
    if not faces_light or is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), cosine))
    if PHONG or BLINN:
        highlight = cosine * specular(scene, material, normal, direction, toward_light)
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


@fault("ILL-2", "direct_light", "Which colour has a highlight?")
def highlight_in_the_diffuse_colour(
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
    """The highlight is filtered by the diffuse colour as well as by the specular one."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    cosine = dot(normal, toward_light)
    faces_light = cosine > 0.0
    if not faces_light or is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), cosine))
        if PHONG or BLINN:
            highlight = specular(scene, material, normal, direction, toward_light)
            shine = multiply(vector_of(scene, MATERIAL_SPECULAR, material), diffuse(scene, material, point))
            reflectance = add(reflectance, scale(shine, highlight))
    return multiply(reflectance, arriving)


@fault("ILL-5", "phong", "Between which two directions is the angle of Phong's highlight?")
def blinn_for_phong(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """The halfway vector is used in place of the mirror direction, with the same exponent."""
    cosine = dot(normal, normalize(subtract(toward_light, direction)))
    highlight: Scalar = max(cosine, 0.0) ** exponent
    return highlight


@fault("ILL-5", "phong", "How often is the cosine multiplied by itself for the exponent 1?")
def exponent_off_by_one(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """The loop that takes the power runs once too often."""
    cosine = dot(mirror_direction(direction, normal), toward_light)
    highlight: Scalar = max(cosine, 0.0) ** (exponent + 1.0)
    return highlight


@fault("ILL-5", "phong", "What is the power of a negative cosine?")
def highlight_not_clamped(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """The power is taken of the absolute cosine, so there is a second highlight on the opposite side."""
    cosine = dot(mirror_direction(direction, normal), toward_light)
    highlight: Scalar = abs(cosine) ** exponent
    return highlight


@fault("ILL-6", "blinn", "Between which two directions is the angle of Blinn's highlight?")
def phong_for_blinn(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """The mirror direction is used in place of the halfway vector, with the same exponent."""
    cosine = dot(mirror_direction(direction, normal), toward_light)
    highlight: Scalar = max(cosine, 0.0) ** exponent
    return highlight


@fault("ILL-6", "blinn", "How long is the sum of two unit vectors?")
def halfway_vector_not_normalised(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """The halfway vector is half the sum of both directions, not made a unit vector."""
    cosine = 0.5 * dot(normal, subtract(toward_light, direction))
    highlight: Scalar = max(cosine, 0.0) ** exponent
    return highlight
