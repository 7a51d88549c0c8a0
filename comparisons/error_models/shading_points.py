"""Functions that departures call: from where a surface is lit and textured, and the clamped sum of its lights.

They are source of the tracer. What is declared beside them for their sake are helpers of the same behaviour.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.helpers import under_name
from raytruth.comparisons.error_models.policy_starts import start_of
from raytruth.reference_tracer.source.features import DIRECTIONAL_LIGHTS, POINT_LIGHTS
from raytruth.reference_tracer.source.illumination import attenuation, diffuse
from raytruth.reference_tracer.source.scene_data import (
    LIGHT_INTENSITY,
    LIGHT_POSITION,
    MATERIAL_IS_LIT,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    integer_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import departure, is_shadowed
from raytruth.reference_tracer.source.vector import add, dot, multiply, negate, normalize, scale, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


SHADING_POINT = {
    "lit": "lit_point(primitive, point, normal)",
    "textured": "textured_point(primitive, point, normal)",
}
"""How they are called where light is summed up."""


def shading_point_helper(name: str, error_model: ErrorModel, *, beside: bool) -> Function:
    """The helper of this name: the point of the surface itself, or beside it, where rays leave it along the normal.

    Where kinds of rays leave it otherwise each, that is where shadow rays do.
    """
    leaving = beside_surface_by_policy if error_model.needs_policies else beside_surface
    return under_name(name, leaving if beside else on_surface)


def on_surface(primitive: int, point: Vector, normal: Vector) -> Vector:  # noqa: ARG001 - the signature of the other
    """The point itself."""
    return point


lit_point = textured_point = on_surface
"""Helpers of these names, which are what `shading_point_helper` chooses."""


def beside_surface(primitive: int, point: Vector, normal: Vector) -> Vector:
    """Where a ray starts that leaves the surface along its normal."""
    start, _ = departure(primitive, point, normal, normal)
    return start


def beside_surface_by_policy(primitive: int, point: Vector, normal: Vector) -> Vector:
    """Where a shadow ray starts that leaves the surface along its normal."""
    return start_of(0, primitive, point, normal, normal)


def from_surface(primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool) -> Vector:
    """The direction to a light from the point of the surface, where a shadow ray takes its end from; the light stays
    where it is.
    """
    if light_is_near:
        return subtract(add(lit_point(primitive, point, normal), to_light), point)
    return to_light


def clamped_diffuse(scene: SceneData, primitive: int, material: int, point: Vector, normal: Vector) -> Vector:
    """The diffuse term of all lights together, whose sum of intensity times cosine is at most 1 in each channel."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    total = (0.0, 0.0, 0.0)
    if POINT_LIGHTS:
        for light in range(rows_of(scene, LIGHT_POSITION)):
            to_light = subtract(vector_of(scene, LIGHT_POSITION, light), lit_point(primitive, point, normal))
            arriving = scale(
                vector_of(scene, LIGHT_INTENSITY, light), attenuation(scene, light, dot(to_light, to_light))
            )
            total = add(total, lambert(scene, primitive, point, normal, to_light, True, arriving))
    if DIRECTIONAL_LIGHTS:
        for sun in range(rows_of(scene, SUN_DIRECTION)):
            to_light = negate(vector_of(scene, SUN_DIRECTION, sun))
            arriving = vector_of(scene, SUN_IRRADIANCE, sun)
            total = add(total, lambert(scene, primitive, point, normal, to_light, False, arriving))
    clamped = (min(total[0], 1.0), min(total[1], 1.0), min(total[2], 1.0))
    return multiply(diffuse(scene, material, textured_point(primitive, point, normal)), clamped)


def lambert(
    scene: SceneData,
    primitive: int,
    point: Vector,
    normal: Vector,
    to_light: Vector,
    light_is_near: bool,
    arriving: Vector,
) -> Vector:
    """What arrives of one light, times the cosine: nothing if it is behind the surface or hidden."""
    cosine = dot(normal, normalize(to_light))
    faces_light = cosine > 0.0
    if not faces_light:
        return (0.0, 0.0, 0.0)
    way = from_surface(primitive, point, normal, to_light, light_is_near)
    if is_shadowed(scene, primitive, point, normal, way, light_is_near):
        return (0.0, 0.0, 0.0)
    return scale(arriving, cosine)
