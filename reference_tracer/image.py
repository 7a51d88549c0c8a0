"""From rays to pixels (docs/spec.md, IMG)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference_tracer.camera import Frame, primary_ray
from reference_tracer.ray_tree import radiance
from reference_tracer.traversal import NOTHING, nearest_hit
from reference_tracer.vector import add, scale

if TYPE_CHECKING:
    from reference_tracer.numbers import Scalar, Table, Vector
    from reference_tracer.scene_data import SceneData


def pixel_radiance(scene: SceneData, frame: Frame, medium: int, depth: int, x: Scalar, y: Scalar) -> Vector:
    """What arrives through the image point (x, y)."""
    origin, direction = primary_ray(frame, x, y)
    return radiance(scene, origin, direction, medium, depth)


def render_rows(
    scene: SceneData, frame: Frame, medium: int, depth: int, samples: int, first: int, end: int, image: Table
) -> None:
    """Fill the rows `first` to `end` - 1 of an image of shape (height, width, 3).

    Each pixel is the mean over a regular grid of samples × samples points, its centre alone for samples = 1.
    """
    step = 1.0 / float(samples)
    for row_number in range(first, end):
        for column in range(image.shape[1]):
            total = (0.0, 0.0, 0.0)
            for i in range(samples):
                for j in range(samples):
                    x = float(column) + (float(i) + 0.5) * step
                    y = float(row_number) + (float(j) + 0.5) * step
                    total = add(total, pixel_radiance(scene, frame, medium, depth, x, y))
            mean = scale(total, step * step)
            image[row_number, column, 0] = mean[0]
            image[row_number, column, 1] = mean[1]
            image[row_number, column, 2] = mean[2]


def first_hit_rows(scene: SceneData, frame: Frame, first: int, end: int, depths: Table, primitives: Table) -> None:
    """Distance and number of what the ray through each pixel's centre meets first; arrays of shape (height, width)."""
    for row_number in range(first, end):
        for column in range(depths.shape[1]):
            origin, direction = primary_ray(frame, float(column) + 0.5, float(row_number) + 0.5)
            distance, primitive = nearest_hit(scene, origin, direction, NOTHING)
            depths[row_number, column] = distance
            primitives[row_number, column] = primitive
