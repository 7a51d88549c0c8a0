"""Faults of the camera (docs/spec.md, CAM and IMG)."""

from __future__ import annotations

from math import inf, pi, tan
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.camera import primary_ray
from raytruth.reference_tracer.source.features import PERSPECTIVE, SPHERES, TRIANGLES
from raytruth.reference_tracer.source.ray_tree import radiance
from raytruth.reference_tracer.source.scene_data import (
    CAMERA_EXTENT,
    CAMERA_LOOK_AT,
    CAMERA_POSITION,
    CAMERA_SIZE,
    CAMERA_UP,
    MAX_DEPTH,
    SPHERE_CENTER,
    SPHERE_RADIUS,
    integer_of,
    number_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.traversal import NOTHING, distance_to_sphere, nearest_triangle
from raytruth.reference_tracer.source.vector import add, along, cross, dot, negate, normalize, scale, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.camera import Frame
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("CAM-1", "primary_ray", "Which way does the cross product of forward and up point?")
def mirrored_image(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """Left and right are swapped, because the cross product of forward and up is taken the other way round."""
    position, corner, pixel_right, pixel_down, forward = frame
    on_image = along(along(corner, pixel_right, x), pixel_down, y)
    right = normalize(pixel_right)
    flipped = along(on_image, right, -2.0 * dot(on_image, right))
    if PERSPECTIVE:
        return position, normalize(flipped)
    return add(position, flipped), forward


@fault("CAM-1", "camera_frame", "Is up perpendicular to the direction of view in every scene?")
def up_not_made_perpendicular(scene: SceneData) -> Frame:
    """The camera's own up is taken as it stands, although it is not perpendicular to the direction of view."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position))
    right = normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))
    down = negate(normalize(vector_of(scene, CAMERA_UP, 0)))
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    visible_height = number_of(scene, CAMERA_EXTENT, 0)
    if PERSPECTIVE:
        visible_height = 2.0 * tan(visible_height * pi / 360.0)
    pixel = visible_height / height
    corner = add(scale(right, -0.5 * width * pixel), scale(down, -0.5 * height * pixel))
    if PERSPECTIVE:
        corner = add(corner, forward)
    return position, corner, scale(right, pixel), scale(down, pixel), forward


@fault("CAM-1", "camera_frame", "What does the scene file say that `look_at` is?")
def look_at_taken_for_a_direction(scene: SceneData) -> Frame:
    """The point to look at is used as the direction of view."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(vector_of(scene, CAMERA_LOOK_AT, 0))
    right = normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))
    down = cross(forward, right)
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    visible_height = number_of(scene, CAMERA_EXTENT, 0)
    if PERSPECTIVE:
        visible_height = 2.0 * tan(visible_height * pi / 360.0)
    pixel = visible_height / height
    corner = add(scale(right, -0.5 * width * pixel), scale(down, -0.5 * height * pixel))
    if PERSPECTIVE:
        corner = add(corner, forward)
    return position, corner, scale(right, pixel), scale(down, pixel), forward


@fault("CAM-2", "primary_ray", "Where is the row 0 of the image?")
def image_upside_down(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """Rows are counted from the bottom, so the image stands on its head."""
    position, corner, pixel_right, pixel_down, forward = frame
    on_image = along(along(corner, pixel_right, x), pixel_down, y)
    down = normalize(pixel_down)
    flipped = along(on_image, down, -2.0 * dot(on_image, down))
    if PERSPECTIVE:
        return position, normalize(flipped)
    return add(position, flipped), forward


@fault("CAM-2", "camera_frame", "How wide is a pixel, and how high, in an image that is not square?")
def aspect_ratio_forgotten(scene: SceneData) -> Frame:
    """The image is as wide as it is high, whatever its size in pixels: everything is stretched."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position))
    right = normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))
    down = cross(forward, right)
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    visible_height = number_of(scene, CAMERA_EXTENT, 0)
    if PERSPECTIVE:
        visible_height = 2.0 * tan(visible_height * pi / 360.0)
    corner = add(scale(right, -0.5 * visible_height), scale(down, -0.5 * visible_height))
    if PERSPECTIVE:
        corner = add(corner, forward)
    return position, corner, scale(right, visible_height / width), scale(down, visible_height / height), forward


@fault(
    "CAM-2", "camera_frame", "How many pixels fit between the image's edges, and how many gaps between their centres?"
)
def one_pixel_too_few(scene: SceneData) -> Frame:
    """The height is divided by the number of rows less one, so that the outermost centres lie on the edges."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position))
    right = normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))
    down = cross(forward, right)
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    visible_height = number_of(scene, CAMERA_EXTENT, 0)
    if PERSPECTIVE:
        visible_height = 2.0 * tan(visible_height * pi / 360.0)
    pixel = visible_height / (height - 1.0)
    corner = add(scale(right, -0.5 * width * pixel), scale(down, -0.5 * height * pixel))
    if PERSPECTIVE:
        corner = add(corner, forward)
    return position, corner, scale(right, pixel), scale(down, pixel), forward


@fault("CAM-3", "camera_frame", "Between which two edges of the image is the field of view measured?")
def horizontal_field_of_view(scene: SceneData) -> Frame:
    """The vertical field of view is taken for the horizontal one."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position))
    right = normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))
    down = cross(forward, right)
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    visible_width = number_of(scene, CAMERA_EXTENT, 0)
    if PERSPECTIVE:
        visible_width = 2.0 * tan(visible_width * pi / 360.0)
    pixel = visible_width / width
    corner = add(scale(right, -0.5 * width * pixel), scale(down, -0.5 * height * pixel))
    if PERSPECTIVE:
        corner = add(corner, forward)
    return position, corner, scale(right, pixel), scale(down, pixel), forward


@fault("CAM-3", "camera_frame", "Draw the triangle of camera, image centre and image edge: which angle does it have?")
def tangent_of_the_whole_angle(scene: SceneData) -> Frame:
    """The image's height is taken from the tangent of the whole field of view instead of twice that of its half."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position))
    right = normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))
    down = cross(forward, right)
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    visible_height = number_of(scene, CAMERA_EXTENT, 0)
    if PERSPECTIVE:
        visible_height = tan(visible_height * pi / 180.0)
    pixel = visible_height / height
    corner = add(scale(right, -0.5 * width * pixel), scale(down, -0.5 * height * pixel))
    if PERSPECTIVE:
        corner = add(corner, forward)
    return position, corner, scale(right, pixel), scale(down, pixel), forward


@fault("CAM-3", "camera_frame", "How many digits does your π have?")
def short_pi(scene: SceneData) -> Frame:
    """π is written as 3.14, so the field of view is a little too narrow."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position))
    right = normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))
    down = cross(forward, right)
    width = float(integer_of(scene, CAMERA_SIZE, 0))
    height = float(integer_of(scene, CAMERA_SIZE, 1))
    visible_height = number_of(scene, CAMERA_EXTENT, 0)
    if PERSPECTIVE:
        visible_height = 2.0 * tan(visible_height * 3.14 / 360.0)
    pixel = visible_height / height
    corner = add(scale(right, -0.5 * width * pixel), scale(down, -0.5 * height * pixel))
    if PERSPECTIVE:
        corner = add(corner, forward)
    return position, corner, scale(right, pixel), scale(down, pixel), forward


@fault("CAM-3", "primary_ray", "How long is the ray's direction at the image's corner, and who relies on its length?")
def camera_rays_not_normalised(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """The directions of camera rays are not made unit vectors, which the rest of the code takes them for."""
    position, corner, pixel_right, pixel_down, forward = frame
    on_image = along(along(corner, pixel_right, x), pixel_down, y)
    if PERSPECTIVE:
        return position, on_image
    return add(position, on_image), forward


@fault("CAM-4", "primary_ray", "From where to where does the view height reach?")
def view_height_from_the_centre(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """The view height of a parallel projection is taken for the distance from the centre to the upper edge."""
    position, corner, pixel_right, pixel_down, forward = frame
    on_image = along(along(corner, pixel_right, x), pixel_down, y)
    if PERSPECTIVE:
        return position, normalize(on_image)
    return add(position, scale(on_image, 2.0)), forward


@fault("CAM-4", "primary_ray", "What do all rays of a parallel projection have in common?")
def parallel_rays_spread(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """In a parallel projection rays start on the image plane but still run away from the camera's position."""
    position, corner, pixel_right, pixel_down, forward = frame
    on_image = along(along(corner, pixel_right, x), pixel_down, y)
    if PERSPECTIVE:
        return position, normalize(on_image)
    return add(position, on_image), normalize(add(forward, on_image))


@fault("CAM-5", "radiance_at", "What lies between the camera and what it sees first?")
def medium_of_the_camera_forgotten(scene: SceneData, frame: Frame, x: Scalar, y: Scalar) -> Vector:
    """Camera rays start in empty space although the camera is inside a medium that absorbs."""
    origin, direction = primary_ray(frame, x, y)
    return radiance(scene, origin, direction, NOTHING, integer_of(scene, MAX_DEPTH, 0))


@fault("CAM-6", "nearest_hit", "What does a camera see that stands inside a ball?")
def no_inner_sides_for_the_camera(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """Spheres that the camera is inside of are left out, as if they hid nothing."""
    nearest = inf
    hit = NOTHING
    if SPHERES:
        for sphere in range(rows_of(scene, SPHERE_RADIUS)):
            to_center = subtract(vector_of(scene, SPHERE_CENTER, sphere), origin)
            radius = number_of(scene, SPHERE_RADIUS, sphere)
            inside = left == NOTHING and dot(to_center, to_center) < radius * radius
            distance = distance_to_sphere(scene, origin, direction, left, sphere)
            if distance < nearest and not inside:
                nearest = distance
                hit = sphere
    if TRIANGLES:
        nearest, hit = nearest_triangle(scene, origin, direction, left, nearest, hit)
    return nearest, hit
