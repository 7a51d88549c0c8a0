"""The ray tree: what one camera ray brings back (Whitted, "An Improved Illumination Model for Shaded Display", 1980).

Each ray of the tree has a weight: the product of all the reflectances and transmittances on its way from the camera.
The camera sees the sum, over all rays of the tree, of weight times local illumination where the ray ends. So the tree
is walked with a stack of rays that wait to be traced, which works at any depth and in any arithmetic.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.background import background_radiance
from raytruth.reference_tracer.source.dielectric import index_ratio, medium_beyond, split, total_reflection_weight
from raytruth.reference_tracer.source.features import ABSORPTION, DIELECTRICS, MIRRORS
from raytruth.reference_tracer.source.illumination import local_illumination
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.refraction import medium_transmittance, refracted_direction, snell_discriminant
from raytruth.reference_tracer.source.scene_data import (
    MATERIAL_ABSORPTION,
    MATERIAL_IS_DIELECTRIC,
    MATERIAL_IS_MIRROR,
    MATERIAL_MIRROR,
    integer_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import departure
from raytruth.reference_tracer.source.traversal import NOTHING, material_of, nearest_hit, surface_normal
from raytruth.reference_tracer.source.vector import add, along, dot, multiply, negate

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

    Ray = tuple[Vector, Vector, Vector, int, int, int]
    """Origin, unit direction, weight, the primitive it starts on (-1: none), the medium it travels in (a material, or
    -1 for empty space), and how many more reflections and refractions may follow."""


def radiance(scene: SceneData, origin: Vector, direction: Vector, medium: int, depth: int) -> Vector:
    """What arrives at the origin against a unit direction, in linear RGB."""
    if MIRRORS or DIELECTRICS or ABSORPTION:
        total = (0.0, 0.0, 0.0)
        waiting = [(origin, direction, (1.0, 1.0, 1.0), NOTHING, medium, depth)]
        while len(waiting) > 0:
            total = add(total, trace_ray(scene, waiting.pop(), waiting))
        return total
    distance, primitive = nearest_hit(scene, origin, direction, NOTHING)
    if primitive == NOTHING:
        return background_radiance(scene, direction)
    point, normal, _ = surface_at(scene, origin, direction, distance, primitive)
    return local_illumination(scene, primitive, material_of(scene, primitive), point, normal, direction)


def trace_ray(scene: SceneData, ray: Ray, waiting: list[Ray]) -> Vector:
    """Weight times local illumination where the ray ends; the rays that go on from there are put to those waiting."""
    origin, direction, weight, left, medium, depth = ray
    distance, primitive = nearest_hit(scene, origin, direction, left)
    if primitive == NOTHING:
        return multiply(weight, background_radiance(scene, direction))
    if ABSORPTION:
        if medium >= 0:
            weight = multiply(weight, medium_transmittance(vector_of(scene, MATERIAL_ABSORPTION, medium), distance))
    point, normal, entering = surface_at(scene, origin, direction, distance, primitive)
    material = material_of(scene, primitive)
    if depth > 0:
        if MIRRORS:
            if integer_of(scene, MATERIAL_IS_MIRROR, material):
                mirrored = multiply(weight, vector_of(scene, MATERIAL_MIRROR, material))
                waiting.append(reflected_ray(primitive, point, normal, direction, mirrored, medium, depth))
        if DIELECTRICS:
            if integer_of(scene, MATERIAL_IS_DIELECTRIC, material):
                cosine = -dot(direction, normal)
                ratio = index_ratio(scene, material, entering)
                discriminant = snell_discriminant(cosine, ratio)
                if discriminant < 0.0:
                    reflectance = multiply(weight, total_reflection_weight(scene, material))
                    waiting.append(reflected_ray(primitive, point, normal, direction, reflectance, medium, depth))
                else:
                    g = sqrt(discriminant)
                    reflectance, transmittance = split(scene, material, cosine, g, ratio)
                    reflectance = multiply(weight, reflectance)
                    transmittance = multiply(weight, transmittance)
                    refracted = refracted_direction(direction, normal, cosine, g, ratio)
                    beyond = medium_beyond(scene, material, entering)
                    waiting.append(reflected_ray(primitive, point, normal, direction, reflectance, medium, depth))
                    waiting.append(transmitted_ray(primitive, point, normal, refracted, transmittance, beyond, depth))
    return multiply(weight, local_illumination(scene, primitive, material, point, normal, direction))


def surface_at(
    scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int
) -> tuple[Vector, Vector, bool]:
    """Where the ray meets the primitive: the point, the unit normal turned to the ray, whether the ray is entering."""
    point = hit_point(scene, origin, direction, distance, primitive)
    outward = surface_normal(scene, primitive, point)
    entering = dot(direction, outward) < 0.0
    normal = outward if entering else negate(outward)
    return point, normal, entering


def hit_point(scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int) -> Vector:  # noqa: ARG001 - other formulas start from the primitive
    """The point where the ray meets the primitive."""
    return along(origin, direction, distance)


def reflected_ray(
    primitive: int, point: Vector, normal: Vector, direction: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """The ray that a surface sends on by reflecting one of the given direction; `depth` is that of the arriving ray."""
    mirrored = mirror_direction(direction, normal)
    start, left = departure(primitive, point, normal, mirrored)
    return start, mirrored, weight, left, medium, depth - 1


def transmitted_ray(
    primitive: int, point: Vector, normal: Vector, refracted: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """The ray that goes on behind a surface in the refracted direction, into `medium`."""
    start, left = departure(primitive, point, negate(normal), refracted)
    return start, refracted, weight, left, medium, depth - 1
