"""Faults of the ray tree (docs/spec.md, TREE)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.background import background_radiance
from raytruth.reference_tracer.source.camera import primary_ray
from raytruth.reference_tracer.source.features import BLINN, CONSTANT_SPLIT, DIFFUSE, MIRRORS, PHONG, RADIOMETRIC
from raytruth.reference_tracer.source.illumination import diffuse, specular
from raytruth.reference_tracer.source.ray_tree import radiance, trace_ray
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.refraction import fresnel_reflectance
from raytruth.reference_tracer.source.scene_data import (
    CAMERA_MEDIUM,
    MATERIAL_HAS_CONSTANT_SPLIT,
    MATERIAL_IS_LIT,
    MATERIAL_IS_MIRROR,
    MATERIAL_REFLECTANCE,
    MATERIAL_SPECULAR,
    MATERIAL_TRANSMITTANCE,
    MAX_DEPTH,
    integer_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import departure, is_shadowed
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.reference_tracer.source.vector import add, dot, multiply, negate, normalize, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.camera import Frame
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.ray_tree import Ray
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("TREE-1", "direct_light", "Which terms does the equation have for a surface that mirrors?")
def mirrors_take_no_light(
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
    """A surface with a mirror's term gets no light of its own: either it mirrors or it is shaded."""
    if MIRRORS:
        if integer_of(scene, MATERIAL_IS_MIRROR, material):
            return (0.0, 0.0, 0.0)
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
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


@fault("TREE-2", "radiance_at", "How many reflections does a ray make for a depth of 1?")
def one_bounce_too_few(scene: SceneData, frame: Frame, x: Scalar, y: Scalar) -> Vector:
    """The camera ray counts as the first bounce, so the last reflection is missing."""
    origin, direction = primary_ray(frame, x, y)
    return radiance(scene, origin, direction, integer_of(scene, CAMERA_MEDIUM, 0), integer_of(scene, MAX_DEPTH, 0) - 1)


@fault("TREE-2", "radiance_at", "How many reflections does a ray make for a depth of 0?")
def one_bounce_too_many(scene: SceneData, frame: Frame, x: Scalar, y: Scalar) -> Vector:
    """The depth is compared with `<=`, so there is one reflection more than allowed."""
    origin, direction = primary_ray(frame, x, y)
    return radiance(scene, origin, direction, integer_of(scene, CAMERA_MEDIUM, 0), integer_of(scene, MAX_DEPTH, 0) + 1)


@fault("TREE-2", "transmitted_ray", "Which bounces count toward the depth?")
def refractions_not_counted(
    primitive: int, point: Vector, normal: Vector, refracted: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """Only reflections count toward the depth, refractions do not."""
    start, left = departure(primitive, point, negate(normal), refracted)
    return start, refracted, weight, left, medium, depth


@fault("TREE-2", "reflected_ray", "When does a path between two mirrors end?")
def no_depth_limit(
    primitive: int, point: Vector, normal: Vector, direction: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """The depth is never decreased, so a path between two mirrors has no end."""
    mirrored = mirror_direction(direction, normal)
    start, left = departure(primitive, point, normal, mirrored)
    return start, mirrored, weight, left, medium, depth


@fault("TREE-3", "reflected_ray", "What do many small contributions add up to?")
def faint_reflections_left_out(
    primitive: int, point: Vector, normal: Vector, direction: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """Reflections that weigh less than one percent are left out to save time."""
    mirrored = mirror_direction(direction, normal)
    start, left = departure(primitive, point, normal, mirrored)
    kept = weight
    if weight[0] < 0.01 and weight[1] < 0.01 and weight[2] < 0.01:
        kept = (0.0, 0.0, 0.0)
    return start, mirrored, kept, left, medium, depth - 1


@fault("TREE-3", "split", "How many rays go on from a glass surface?")
def only_the_stronger_of_two_rays(
    scene: SceneData, material: int, cosine: Scalar, g: Scalar, ratio: Scalar
) -> tuple[Vector, Vector]:
    """Of the reflected and the transmitted ray only the stronger one is followed."""
    reflectance = (0.0, 0.0, 0.0)
    transmittance = (0.0, 0.0, 0.0)
    constant = False
    if CONSTANT_SPLIT:
        if integer_of(scene, MATERIAL_HAS_CONSTANT_SPLIT, material):
            constant = True
            reflectance = vector_of(scene, MATERIAL_REFLECTANCE, material)
            transmittance = vector_of(scene, MATERIAL_TRANSMITTANCE, material)
    if not constant:
        reflected = fresnel_reflectance(cosine, g, ratio)
        transmitted = 1.0 - reflected
        if RADIOMETRIC:
            transmitted = transmitted / (ratio * ratio)
        reflectance = (reflected, reflected, reflected)
        transmittance = (transmitted, transmitted, transmitted)
    if reflectance[0] > transmittance[0]:
        return reflectance, (0.0, 0.0, 0.0)
    return (0.0, 0.0, 0.0), transmittance


@fault("TREE-2", "radiance", "What does a path bring that may not go on?")
def background_where_paths_end(scene: SceneData, origin: Vector, direction: Vector, medium: int, depth: int) -> Vector:
    """A path whose depth is used up brings the background in place of black."""
    total = (0.0, 0.0, 0.0)
    waiting = [(origin, direction, (1.0, 1.0, 1.0), NOTHING, medium, depth + 1)]
    while len(waiting) > 0:
        ray = waiting.pop()
        if ray[5] > 0:
            total = add(total, trace_ray(scene, ray, waiting))
        else:
            total = add(total, multiply(ray[2], background_radiance(scene, ray[1])))
    return total
