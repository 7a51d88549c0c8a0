"""Faults that students make, each one function of the tracer gone wrong."""

from __future__ import annotations

from math import pi, sqrt, tan
from typing import TYPE_CHECKING

from reference_tracer.illumination import diffuse
from reference_tracer.reflection import mirror_direction
from reference_tracer.scene_data import (
    CAMERA_EXTENT,
    CAMERA_LOOK_AT,
    CAMERA_POSITION,
    CAMERA_SIZE,
    CAMERA_UP,
    MATERIAL_INDEX,
    MATERIAL_OUTSIDE_INDEX,
    integer_of,
    number_of,
    vector_of,
)
from reference_tracer.shadow import departure
from reference_tracer.traversal import surface_normal
from reference_tracer.vector import add, along, cross, dot, multiply, negate, normalize, scale, subtract

if TYPE_CHECKING:
    from reference_tracer.camera import Frame
    from reference_tracer.numbers import Scalar, Vector
    from reference_tracer.ray_tree import Ray
    from reference_tracer.scene_data import SceneData


def mirrored_image(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """Left and right are swapped."""
    position, corner, pixel_right, pixel_down, _ = frame
    on_image = along(along(corner, pixel_right, x), pixel_down, y)
    right = normalize(pixel_right)
    return position, normalize(along(on_image, right, -2.0 * dot(on_image, right)))


def half_pixel_shift(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """Rays go through the corners of the pixels."""
    position, corner, pixel_right, pixel_down, _ = frame
    return position, normalize(along(along(corner, pixel_right, x - 0.5), pixel_down, y - 0.5))


def horizontal_field_of_view(scene: SceneData) -> Frame:
    """The vertical field of view is taken for the horizontal one."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position))
    right = normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))
    down = cross(forward, right)
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    pixel = 2.0 * tan(number_of(scene, CAMERA_EXTENT, 0) * pi / 360.0) / width
    corner = add(add(scale(right, -0.5 * width * pixel), scale(down, -0.5 * height * pixel)), forward)
    return position, corner, scale(right, pixel), scale(down, pixel), forward


def one_over_r(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """The light falls off with the distance, not with its square."""
    return 1.0 / sqrt(distance_squared)


def no_shadow_rays(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Everything is lit."""
    return False


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
    """A light behind the surface takes light away."""
    return multiply(scale(diffuse(scene, material, point), dot(normal, normalize(to_light))), arriving)


def flipped_normal_inside_glass(
    scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int
) -> tuple[Vector, Vector, bool]:
    """Rays that leave the glass are taken to enter it once more."""
    point = along(origin, direction, distance)
    outward = surface_normal(scene, primitive, point)
    normal = outward if dot(direction, outward) < 0.0 else negate(outward)
    return point, normal, True


def inverted_index_ratio(scene: SceneData, material: int, entering: bool) -> Scalar:
    """The index before the surface over that beyond it."""
    inside = number_of(scene, MATERIAL_INDEX, material)
    outside = number_of(scene, MATERIAL_OUTSIDE_INDEX, material)
    return outside / inside if entering else inside / outside


def no_total_internal_reflection(cosine: Scalar, ratio: Scalar) -> Scalar:
    """Beyond the critical angle the ray goes on along the surface."""
    return max((ratio - 1.0) * (ratio + 1.0) + cosine * cosine, 0.0)


def schlick(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """Schlick's approximation (1994) with the cosine on the thinner side, in place of Fresnel's equations."""
    normal_incidence = ((ratio - 1.0) / (ratio + 1.0)) * ((ratio - 1.0) / (ratio + 1.0))
    thin = cosine
    if ratio < 1.0:
        thin = g / ratio
    rest = 1.0 - thin
    return normal_incidence + (1.0 - normal_incidence) * rest * rest * rest * rest * rest


def one_bounce_too_few(
    primitive: int, point: Vector, normal: Vector, direction: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """The last reflection is left out."""
    mirrored = mirror_direction(direction, normal)
    start, left = departure(primitive, point, normal, mirrored)
    last = weight
    if depth == 1:
        last = scale(weight, 0.0)
    return start, mirrored, last, left, medium, depth - 1


def phong_for_blinn(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """The mirrored direction in place of the halfway vector."""
    cosine = dot(mirror_direction(direction, normal), toward_light)
    highlight: Scalar = max(cosine, 0.0) ** exponent
    return highlight
