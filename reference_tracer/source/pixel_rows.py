"""From rays to pixels (docs/spec.md, IMG)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.camera import camera_frame, primary_ray
from raytruth.reference_tracer.source.ray_tree import radiance
from raytruth.reference_tracer.source.scene_data import CAMERA_MEDIUM, CAMERA_SIZE, MAX_DEPTH, integer_of
from raytruth.reference_tracer.source.traversal import NOTHING, nearest_hit
from raytruth.reference_tracer.source.vector import add, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.camera import Frame
    from raytruth.reference_tracer.source.numbers import Scalar, Table, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


def radiance_at(scene: SceneData, frame: Frame, x: Scalar, y: Scalar) -> Vector:
    """What arrives through the image point (x, y), in linear RGB."""
    origin, direction = primary_ray(frame, x, y)
    medium = integer_of(scene, CAMERA_MEDIUM, 0)
    return radiance(scene, origin, direction, medium, integer_of(scene, MAX_DEPTH, 0))


def render_rows(scene: SceneData, samples: int, first: int, end: int, image: Table) -> None:
    """Fill the rows `first` to `end` - 1 of an image of shape (height, width, 3).

    Each pixel is the mean over a regular grid of samples × samples points, its centre alone for samples = 1.
    """
    frame = camera_frame(scene)
    step = 1.0 / float(samples)
    for row in range(first, end):
        for column in range(integer_of(scene, CAMERA_SIZE, 0)):
            total = (0.0, 0.0, 0.0)
            for i in range(samples):
                for j in range(samples):
                    x = float(column) + (float(i) + 0.5) * step
                    y = float(row) + (float(j) + 0.5) * step
                    total = add(total, radiance_at(scene, frame, x, y))
            mean = scale(total, step * step)
            image[row, column, 0] = mean[0]
            image[row, column, 1] = mean[1]
            image[row, column, 2] = mean[2]


def first_hit_rows(scene: SceneData, first: int, end: int, depths: Table, primitives: Table) -> None:
    """Distance and number of what the ray through each pixel's centre meets first; arrays of shape (height, width)."""
    frame = camera_frame(scene)
    for row in range(first, end):
        for column in range(integer_of(scene, CAMERA_SIZE, 0)):
            origin, direction = primary_ray(frame, float(column) + 0.5, float(row) + 0.5)
            distance, primitive = nearest_hit(scene, origin, direction, NOTHING)
            depths[row, column] = distance
            primitives[row, column] = primitive
