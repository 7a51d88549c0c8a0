"""What a dielectric surface does to a ray: index ratio, medium beyond, how light is split (docs/spec.md, REFR)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.features import CONSTANT_SPLIT, RADIOMETRIC
from raytruth.reference_tracer.source.refraction import fresnel_reflectance
from raytruth.reference_tracer.source.scene_data import (
    MATERIAL_HAS_CONSTANT_SPLIT,
    MATERIAL_INDEX,
    MATERIAL_OUTSIDE,
    MATERIAL_OUTSIDE_INDEX,
    MATERIAL_REFLECTANCE,
    MATERIAL_TRANSMITTANCE,
    integer_of,
    number_of,
    vector_of,
)

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


def index_ratio(scene: SceneData, material: int, entering: bool) -> Scalar:
    """The relative index η of refraction.py: the index of refraction beyond the surface over that before it."""
    inside = number_of(scene, MATERIAL_INDEX, material)
    outside = number_of(scene, MATERIAL_OUTSIDE_INDEX, material)
    return inside / outside if entering else outside / inside


def medium_beyond(scene: SceneData, material: int, entering: bool) -> int:
    """The medium that a ray enters through the surface: the row of its material, or -1 for empty space."""
    return material if entering else integer_of(scene, MATERIAL_OUTSIDE, material)


def total_reflection_weight(scene: SceneData, material: int) -> Vector:
    """The weight of a totally reflected ray, a colour: 1, or the classical constant ks."""
    if CONSTANT_SPLIT:
        if integer_of(scene, MATERIAL_HAS_CONSTANT_SPLIT, material):
            return vector_of(scene, MATERIAL_REFLECTANCE, material)
    return (1.0, 1.0, 1.0)


def split(scene: SceneData, material: int, cosine: Scalar, g: Scalar, ratio: Scalar) -> tuple[Vector, Vector]:
    """Weights of the reflected and of the transmitted ray: Fresnel's R and 1 - R, or the classical ks and kt.

    In the radiometric convention radiance changes with the square of the index: what comes through the surface into
    this medium is weighted by 1/η² (Veach, PhD thesis, 1997, section 5.2).
    """
    if CONSTANT_SPLIT:
        if integer_of(scene, MATERIAL_HAS_CONSTANT_SPLIT, material):
            reflectance = vector_of(scene, MATERIAL_REFLECTANCE, material)
            return reflectance, vector_of(scene, MATERIAL_TRANSMITTANCE, material)
    reflected = fresnel_reflectance(cosine, g, ratio)
    transmitted = 1.0 - reflected
    if RADIOMETRIC:
        transmitted = transmitted / (ratio * ratio)
    return (reflected, reflected, reflected), (transmitted, transmitted, transmitted)
