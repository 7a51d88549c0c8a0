"""Cameras: the ray through a point of the image (docs/spec.md, CAM).

Image coordinates are in pixels: x to the right, y down, (0, 0) the top left corner, so the centre of pixel (i, j) is
(i + 1/2, j + 1/2). Pixels are square.
"""

from __future__ import annotations

from math import pi, tan

from raytruth.reference_tracer.source.features import PERSPECTIVE
from raytruth.reference_tracer.source.numbers import Scalar, Vector
from raytruth.reference_tracer.source.scene_data import (
    CAMERA_EXTENT,
    CAMERA_LOOK_AT,
    CAMERA_POSITION,
    CAMERA_SIZE,
    CAMERA_UP,
    SceneData,
    integer_of,
    number_of,
    vector_of,
)
from raytruth.reference_tracer.source.vector import add, along, cross, normalize, scale, subtract

Frame = tuple[Vector, Vector, Vector, Vector, Vector]
"""Camera position; from there to the image's top left corner; one pixel to the right; one pixel down; forward."""


def camera_frame(scene: SceneData) -> Frame:
    """What all rays of the scene's camera share. The image plane of a perspective camera is at distance 1."""
    position = vector_of(scene, CAMERA_POSITION, 0)
    forward = normalize(subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position))
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


def primary_ray(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """Origin and unit direction of the ray through image point (x, y)."""
    position, corner, pixel_right, pixel_down, forward = frame
    on_image = along(along(corner, pixel_right, x), pixel_down, y)
    if PERSPECTIVE:
        return position, normalize(on_image)
    return add(position, on_image), forward
