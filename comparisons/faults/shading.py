"""Faults in the terms of local illumination (docs/spec.md, ILL)."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.features import (
    BLINN,
    DIFFUSE,
    DIRECTIONAL_LIGHTS,
    PHONG,
    POINT_LIGHTS,
    RADIOMETRIC,
)
from raytruth.reference_tracer.source.illumination import diffuse, specular
from raytruth.reference_tracer.source.scene_data import (
    AMBIENT_LIGHT,
    LIGHT_POSITION,
    MATERIAL_AMBIENT,
    MATERIAL_DIFFUSE,
    MATERIAL_DIFFUSE_BOARD,
    MATERIAL_IS_LIT,
    MATERIAL_SPECULAR,
    SUN_DIRECTION,
    integer_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import is_shadowed
from raytruth.reference_tracer.source.texture import textured
from raytruth.reference_tracer.source.vector import add, dot, multiply, normalize, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("ILL-2", "direct_light", "Which sign has n·l where the light is behind the surface?")
def missing_clamp(
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
    """The cosine is not clamped to 0, so a light behind the surface takes light away."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    cosine = dot(normal, toward_light)
    if cosine > 0.0 and is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), cosine))
    if PHONG or BLINN:
        highlight = specular(scene, material, normal, direction, toward_light)
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


@fault("ILL-2", "direct_light", "Which side of the surface does the light shine on, and which one do you see?")
def lit_through_the_surface(
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
    """The absolute value of the cosine is taken, so a light behind the surface lights its front."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    if is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), abs(dot(normal, toward_light))))
    if PHONG or BLINN:
        highlight = specular(scene, material, normal, direction, toward_light)
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


@fault("ILL-2", "direct_light", "How does the brightness change where light arrives at a slant?")
def no_cosine(
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
    """The diffuse term lacks n·l, so a lit sphere looks like a disc."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    faces_light = dot(normal, toward_light) > 0.0
    if not faces_light or is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, diffuse(scene, material, point))
    if PHONG or BLINN:
        highlight = specular(scene, material, normal, direction, toward_light)
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


@fault("ILL-2", "direct_light", "Look at the line between day and night: is it sharp?")
def grazing_light_dropped(
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
    """Light that arrives at a cosine below 0.05 is dropped, against noise at the border of day and night."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    cosine = dot(normal, toward_light)
    if cosine < 0.05 or is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), cosine))
    if PHONG or BLINN:
        highlight = specular(scene, material, normal, direction, toward_light)
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


@fault("ILL-2", "direct_light", "How long is l?")
def light_direction_not_normalised(
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
    """The direction to the light is not made a unit vector, so n·l grows with the distance."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    cosine = dot(normal, to_light)
    faces_light = cosine > 0.0
    if not faces_light or is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), cosine))
    if PHONG or BLINN:
        highlight = specular(scene, material, normal, direction, normalize(to_light))
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


@fault("ILL-2", "ambient", "How often does ambient light arrive?")
def ambient_once_a_light(scene: SceneData, material: int) -> Vector:
    """The ambient term stands within the loop over the lights."""
    once = multiply(vector_of(scene, MATERIAL_AMBIENT, material), vector_of(scene, AMBIENT_LIGHT, 0))
    lights = 0
    if POINT_LIGHTS:
        lights += rows_of(scene, LIGHT_POSITION)
    if DIRECTIONAL_LIGHTS:
        lights += rows_of(scene, SUN_DIRECTION)
    return scale(once, float(lights))


@fault("ILL-2", "ambient", "Which two factors has the ambient term?")
def ambient_light_not_filtered(scene: SceneData, material: int) -> Vector:
    """The ambient light comes back in full, not times the ambient reflectance of the surface."""
    return vector_of(scene, AMBIENT_LIGHT, 0)


@fault("ILL-2", "diffuse", "Do all your terms add up to what arrives?")
def diffuse_one_percent_too_dark(scene: SceneData, material: int, point: Vector) -> Vector:
    """One percent of the diffuse light is lost."""
    reflectance = textured(scene, MATERIAL_DIFFUSE, MATERIAL_DIFFUSE_BOARD, material, point)
    if RADIOMETRIC:
        return scale(reflectance, 0.99 / pi)
    return scale(reflectance, 0.99)


@fault("ILL-2", "diffuse", "Which units has the classical equation?")
def pi_in_the_classical_equation(scene: SceneData, material: int, point: Vector) -> Vector:
    """The diffuse term is divided by π in the classical convention, too."""
    return scale(textured(scene, MATERIAL_DIFFUSE, MATERIAL_DIFFUSE_BOARD, material, point), 1.0 / pi)


@fault("ILL-3", "diffuse", "How much of the light that arrives does Lambert's surface send to one direction?")
def no_pi(scene: SceneData, material: int, point: Vector) -> Vector:
    """The reflectance is used for the radiance without division by π."""
    return textured(scene, MATERIAL_DIFFUSE, MATERIAL_DIFFUSE_BOARD, material, point)


@fault("ILL-3", "diffuse", "How many digits has your 1/π?")
def rounded_inverse_pi(scene: SceneData, material: int, point: Vector) -> Vector:
    """1/π is written as 0.318."""
    reflectance = textured(scene, MATERIAL_DIFFUSE, MATERIAL_DIFFUSE_BOARD, material, point)
    if RADIOMETRIC:
        return scale(reflectance, 0.318)
    return reflectance


@fault("ILL-8", "diffuse", "What stands where a colour is not stated?")
def missing_diffuse_is_grey(scene: SceneData, material: int, point: Vector) -> Vector:
    """A material that states no diffuse term gets a dark grey one."""
    reflectance = textured(scene, MATERIAL_DIFFUSE, MATERIAL_DIFFUSE_BOARD, material, point)
    if reflectance[0] + reflectance[1] + reflectance[2] == 0.0:
        reflectance = (0.1, 0.1, 0.1)
    if RADIOMETRIC:
        return scale(reflectance, 1.0 / pi)
    return reflectance
