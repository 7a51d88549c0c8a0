"""Faults in the sum over the lights (docs/spec.md, ILL-2, ILL-7 and ILL-8)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.features import AMBIENT, DIRECTIONAL_LIGHTS, EMISSION, POINT_LIGHTS
from raytruth.reference_tracer.source.illumination import ambient, attenuation, direct_light, emission
from raytruth.reference_tracer.source.scene_data import (
    LIGHT_INTENSITY,
    LIGHT_POSITION,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.vector import add, dot, negate, scale, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("ILL-2", "local_illumination", "Take all lights but one away: which one still counts?")
def first_light_only(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """Only the first of all point lights is used, and only the first directional one."""
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, emission(scene, material, point))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        to_light = subtract(vector_of(scene, LIGHT_POSITION, 0), point)
        arriving = scale(vector_of(scene, LIGHT_INTENSITY, 0), attenuation(scene, 0, dot(to_light, to_light)))
        total = add(total, direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving))
    if DIRECTIONAL_LIGHTS:
        to_light = negate(vector_of(scene, SUN_DIRECTION, 0))
        arriving = vector_of(scene, SUN_IRRADIANCE, 0)
        total = add(
            total, direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
        )
    return total


@fault("ILL-2", "local_illumination", "What happens to the image if you list a light twice?")
def first_light_counted_twice(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """The sum begins with the first light and the loop adds it once more."""
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, emission(scene, material, point))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        for place in range(rows_of(scene, LIGHT_POSITION) + 1):
            light = max(place - 1, 0)
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), point)
            factor = attenuation(scene, light, dot(to_light, to_light))
            arriving = scale(vector_of(scene, LIGHT_INTENSITY, light), factor)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving)
            total = add(total, lit)
    if DIRECTIONAL_LIGHTS:
        for place in range(rows_of(scene, SUN_DIRECTION) + 1):
            sun = max(place - 1, 0)
            to_light = negate(vector_of(scene, SUN_DIRECTION, sun))
            arriving = vector_of(scene, SUN_IRRADIANCE, sun)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
            total = add(total, lit)
    return total


@fault("ILL-2", "local_illumination", "Should a room become darker when a dim lamp is switched on?")
def lights_averaged(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """The light of all point lights is averaged instead of summed."""
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, emission(scene, material, point))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        share = 1.0 / float(rows_of(scene, LIGHT_POSITION))
        for light in range(rows_of(scene, LIGHT_POSITION)):
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), point)
            factor = share * attenuation(scene, light, dot(to_light, to_light))
            arriving = scale(vector_of(scene, LIGHT_INTENSITY, light), factor)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving)
            total = add(total, lit)
    if DIRECTIONAL_LIGHTS:
        for sun in range(rows_of(scene, SUN_DIRECTION)):
            to_light = negate(vector_of(scene, SUN_DIRECTION, sun))
            arriving = vector_of(scene, SUN_IRRADIANCE, sun)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
            total = add(total, lit)
    return total


@fault("ILL-2", "local_illumination", "What colour has the light where a red and a blue lamp shine?")
def lights_without_colour(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """The red channel of a light's intensity is used for all three."""
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, emission(scene, material, point))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        for light in range(rows_of(scene, LIGHT_POSITION)):
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), point)
            red = vector_of(scene, LIGHT_INTENSITY, light)[0] * attenuation(scene, light, dot(to_light, to_light))
            arriving = (red, red, red)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving)
            total = add(total, lit)
    if DIRECTIONAL_LIGHTS:
        for sun in range(rows_of(scene, SUN_DIRECTION)):
            to_light = negate(vector_of(scene, SUN_DIRECTION, sun))
            red = vector_of(scene, SUN_IRRADIANCE, sun)[0]
            arriving = (red, red, red)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
            total = add(total, lit)
    return total


@fault("ILL-7", "local_illumination", "How far away is the sun?")
def sun_falls_off(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """Directional light falls off with the distance from the origin, as if a point light stood there."""
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, emission(scene, material, point))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        for light in range(rows_of(scene, LIGHT_POSITION)):
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), point)
            factor = attenuation(scene, light, dot(to_light, to_light))
            arriving = scale(vector_of(scene, LIGHT_INTENSITY, light), factor)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving)
            total = add(total, lit)
    if DIRECTIONAL_LIGHTS:
        for sun in range(rows_of(scene, SUN_DIRECTION)):
            to_light = negate(vector_of(scene, SUN_DIRECTION, sun))
            arriving = scale(vector_of(scene, SUN_IRRADIANCE, sun), 1.0 / (1.0 + dot(point, point)))
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
            total = add(total, lit)
    return total


@fault("ILL-2", "local_illumination", "Where does sunlight come from, and where does its direction point?")
def sun_from_the_other_side(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """The direction in which sunlight travels is taken for the direction to the sun."""
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, emission(scene, material, point))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        for light in range(rows_of(scene, LIGHT_POSITION)):
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), point)
            factor = attenuation(scene, light, dot(to_light, to_light))
            arriving = scale(vector_of(scene, LIGHT_INTENSITY, light), factor)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving)
            total = add(total, lit)
    if DIRECTIONAL_LIGHTS:
        for sun in range(rows_of(scene, SUN_DIRECTION)):
            to_light = vector_of(scene, SUN_DIRECTION, sun)
            arriving = vector_of(scene, SUN_IRRADIANCE, sun)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
            total = add(total, lit)
    return total


@fault("ILL-8", "local_illumination", "What is brighter than white?")
def shading_clamped_to_one(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """The sum of the local terms is clamped to 1 at each hit."""
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, emission(scene, material, point))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        for light in range(rows_of(scene, LIGHT_POSITION)):
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), point)
            factor = attenuation(scene, light, dot(to_light, to_light))
            arriving = scale(vector_of(scene, LIGHT_INTENSITY, light), factor)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving)
            total = add(total, lit)
    if DIRECTIONAL_LIGHTS:
        for sun in range(rows_of(scene, SUN_DIRECTION)):
            to_light = negate(vector_of(scene, SUN_DIRECTION, sun))
            arriving = vector_of(scene, SUN_IRRADIANCE, sun)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
            total = add(total, lit)
    return (min(total[0], 1.0), min(total[1], 1.0), min(total[2], 1.0))


@fault("ILL-4", "local_illumination", "What does a lamp look like from the side?")
def emission_falls_with_the_angle(
    scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector, direction: Vector
) -> Vector:
    """Emission is multiplied by the cosine of the viewing angle."""
    total = (0.0, 0.0, 0.0)
    if EMISSION:
        total = add(total, scale(emission(scene, material, point), -dot(normal, direction)))
    if AMBIENT:
        total = add(total, ambient(scene, material))
    if POINT_LIGHTS:
        for light in range(rows_of(scene, LIGHT_POSITION)):
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), point)
            factor = attenuation(scene, light, dot(to_light, to_light))
            arriving = scale(vector_of(scene, LIGHT_INTENSITY, light), factor)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, True, arriving)
            total = add(total, lit)
    if DIRECTIONAL_LIGHTS:
        for sun in range(rows_of(scene, SUN_DIRECTION)):
            to_light = negate(vector_of(scene, SUN_DIRECTION, sun))
            arriving = vector_of(scene, SUN_IRRADIANCE, sun)
            lit = direct_light(scene, primitive, material, point, normal, direction, to_light, False, arriving)
            total = add(total, lit)
    return total
