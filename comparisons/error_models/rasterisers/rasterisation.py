"""What a rasteriser with a z-buffer may make of a pixel, in terms of rays.

A rasteriser moves the corners of a triangle: float32 rounds them in space, and their places in the image are snapped
to a grid. Then it asks whether a pixel's centre c is in the moved triangle. Let P be the triangle in the image and P'
the moved one, each corner by δ at most in x and in y. If c is in P', it is Σ λᵢ Pᵢ' with weights λᵢ >= 0 of sum 1, and
Σ λᵢ Pᵢ is a point of P that is within δ of c. If c is not in P', not all of the square of half width δ around c is
inside P: on the way from P to P' no point of the boundary moves by more than δ, so it would never meet c, around which
it winds once. So whatever the rasteriser decides, some ray through that square decides. The same holds in space, for
rays moved to the side by as much as the corners are. So a pixel is a bundle of rays, and only where an edge goes
through the bundle is it open what it shows.

The depth is that of the plane through the corners, which float32 has rounded but nothing snapped, at c. How it is
interpolated and kept loses a little more (depth_interpolation.py). What is drawn is lit, as rasterised_light.py says.
The functions here are source of the tracer, as those of ray_offsets.py.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import numpy as np
from flint import arb

from raytruth.comparisons.error_models.helpers import corners_of
from raytruth.comparisons.error_models.rasterisers.depth_interpolation import depth_errors
from raytruth.comparisons.error_models.rasterisers.drawn_pieces import movement_in_space, window_error
from raytruth.comparisons.error_models.rasterisers.rasterised_light import about_zero, light_behaviour
from raytruth.comparisons.error_models.rasterisers.view_volume import camera_axes, half_extent, view_volume
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour, merged
from raytruth.reference_tracer.source.bounding_volume import certainly_less, certainly_zero, clip
from raytruth.reference_tracer.source.features import PERSPECTIVE
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import add, cross, dot, scale, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData
    from raytruth.scenes.scene import Scene

origin_spread: Vector = (0.0, 0.0, 0.0)
"""How far from a camera ray's origin those of its bundle are, along each axis."""
direction_spread: Vector = (0.0, 0.0, 0.0)
corner_spread: Vector = (0.0, 0.0, 0.0)
"""How far float32 may move a corner in space, along each axis."""
beyond: list[Scalar] = []
"""For each triangle: how many times that counts at a pixel's centre a little outside of it."""
depth_error: list[Scalar] = []
"""For each triangle: the error of the distance, or with perspective of its inverse."""


def rasterisation_behaviour(rasterisation: Rasterisation | None, scene: Scene) -> Behaviour:
    """What a rasteriser does otherwise, nothing for who traces rays; to be merged with HELPERS.

    The constants are balls and lists of balls.
    """
    if rasterisation is None:
        return IDEAL
    volume = view_volume(scene)
    snapping = 2.0 ** -(rasterisation.subpixel_bits + 1)
    errors = depth_errors(scene, volume, snapping)
    movement = movement_in_space(scene, volume)
    moved = [movement] * 3
    right, up, _ = camera_axes(scene)
    pixel = 2 * half_extent(scene)[1] / scene.camera.height
    of_a_pixel = pixel * (np.abs(right) + np.abs(up))
    in_image = (snapping + window_error(scene)) * of_a_pixel
    # A direction has length 1 and its point of the image plane is no nearer than that, so that this is enough.
    is_perspective = scene.camera.projection == "perspective"
    origin, direction = (moved, in_image) if is_perspective else (np.add(moved, in_image), np.zeros(3))
    # Depth in the window, from 0 to 1, is linear in the distance, or with perspective in its inverse; times the cosine
    # between the ray and the forward direction, which is at most 1.
    unit = 1 / volume.near - 1 / volume.far if is_perspective else volume.far - volume.near
    constants = {
        "origin_spread": about_zero(origin),
        "direction_spread": about_zero(direction),
        "corner_spread": about_zero(moved),
        "beyond": [arb(float(factor)) for factor in errors.beyond],
        "depth_error": about_zero((errors.bounds + 2.0**-rasterisation.depth_bits) * unit),
    }
    drawing = Behaviour(
        {"distance_to_triangle": drawn_distance, "box_is_missed": box_is_missed_by_bundle},
        constants=constants,
        name="rasterisation",
    )
    return merged(drawing, light_behaviour(scene, snapping, window_error(scene) * of_a_pixel, movement))


def drawn_distance(scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int) -> Scalar:
    """The distance to a triangle that the bundle meets, as it comes out of the z-buffer."""
    if triangle == left:
        return inf
    a, b, c = corners_of(scene, triangle)
    if triangle_distance(add(origin, origin_spread), add(direction, direction_spread), a, b, c) == inf:
        return inf
    moved = add(a, scale(corner_spread, beyond[triangle]))
    normal = cross(subtract(b, a), subtract(c, a))
    distance = dot(subtract(moved, origin), normal) / dot(direction, normal)
    if PERSPECTIVE:
        return 1.0 / (1.0 / distance + depth_error[triangle])
    return distance + depth_error[triangle]


def box_is_missed_by_bundle(origin: Vector, direction: Vector, low: Vector, high: Vector, end: Scalar) -> bool:  # noqa: ARG001 - the signature of the function it stands for
    """Whether no ray of the bundle meets the box, however far away: what is in it may yet win by its error of depth."""
    start = add(origin, origin_spread)
    toward = add(direction, direction_spread)
    to_low = subtract(low, start)
    to_high = subtract(high, start)
    entry = 0.0
    leave = inf
    for axis in range(3):
        if certainly_less(0.0, toward[axis]):
            entry, leave = clip(entry, leave, toward[axis], to_low[axis], to_high[axis])
        elif certainly_less(toward[axis], 0.0):
            entry, leave = clip(entry, leave, toward[axis], to_high[axis], to_low[axis])
        elif certainly_zero(toward[axis]) and (certainly_less(0.0, to_low[axis]) or certainly_less(to_high[axis], 0.0)):
            return True
    return certainly_less(leave, entry)
