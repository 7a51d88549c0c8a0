"""Faults in which ray belongs to a pixel, and in what is told of its first hit (docs/spec.md, IMG)."""

from __future__ import annotations

from math import tan
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.camera import camera_frame, primary_ray
from raytruth.reference_tracer.source.features import PERSPECTIVE
from raytruth.reference_tracer.source.pixel_rows import radiance_at
from raytruth.reference_tracer.source.ray_tree import radiance
from raytruth.reference_tracer.source.scene_data import (
    CAMERA_MEDIUM,
    CAMERA_SIZE,
    MAX_DEPTH,
    integer_of,
)
from raytruth.reference_tracer.source.traversal import NOTHING, nearest_hit
from raytruth.reference_tracer.source.vector import add, along, dot, normalize, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.camera import Frame
    from raytruth.reference_tracer.source.numbers import Scalar, Table, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("IMG-1", "primary_ray", "Which point of pixel (0, 0) has the image coordinates (0, 0)?")
def half_a_pixel_off(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """Rays go through the upper left corners of the pixels instead of their centres."""
    position, corner, pixel_right, pixel_down, forward = frame
    on_image = along(along(corner, pixel_right, x - 0.5), pixel_down, y - 0.5)
    if PERSPECTIVE:
        return position, normalize(on_image)
    return add(position, on_image), forward


@fault("IMG-1", "radiance_at", "Render twice with another seed: what changes?")
def jittered_rays(scene: SceneData, frame: Frame, x: Scalar, y: Scalar) -> Vector:
    """Each ray goes through a random point of its pixel, as for anti-aliasing."""
    # The fractional part of a wild number serves for a random one.
    wild = tan(12.9898 * x + 78.233 * y) * 43758.5453
    shift = wild - float(int(wild)) - 0.5
    origin, direction = primary_ray(frame, x + 0.5 * shift, y - 0.5 * shift)
    return radiance(scene, origin, direction, integer_of(scene, CAMERA_MEDIUM, 0), integer_of(scene, MAX_DEPTH, 0))


@fault("IMG-4", "first_hit_rows", "Along which line is the depth of a pixel measured?", gives="first hits")
def depth_along_the_axis(scene: SceneData, first: int, end: int, depths: Table, primitives: Table) -> None:
    """The depth is measured along the camera's axis, as in a depth buffer, and not along the ray."""
    frame = camera_frame(scene)
    _, _, _, _, forward = frame
    for line in range(first, end):
        for column in range(integer_of(scene, CAMERA_SIZE, 0)):
            origin, direction = primary_ray(frame, float(column) + 0.5, float(line) + 0.5)
            distance, primitive = nearest_hit(scene, origin, direction, NOTHING)
            depths[line, column] = distance * dot(direction, forward)
            primitives[line, column] = primitive


@fault("IMG-2", "render_rows", "How many points has a pixel?")
def mean_over_one_too_many(scene: SceneData, samples: int, first: int, end: int, image: Table) -> None:
    """The sum over the points of a pixel is divided by one more than there are."""
    frame = camera_frame(scene)
    step = 1.0 / float(samples)
    for line in range(first, end):
        for column in range(integer_of(scene, CAMERA_SIZE, 0)):
            total = (0.0, 0.0, 0.0)
            for i in range(samples):
                for j in range(samples):
                    x = float(column) + (float(i) + 0.5) * step
                    y = float(line) + (float(j) + 0.5) * step
                    total = add(total, radiance_at(scene, frame, x, y))
            mean = scale(total, 1.0 / float(samples * samples + 1))
            image[line, column, 0] = mean[0]
            image[line, column, 1] = mean[1]
            image[line, column, 2] = mean[2]
