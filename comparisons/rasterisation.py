"""What a rasteriser with a z-buffer may make of a pixel, in terms of rays.

A rasteriser moves the corners of a triangle: float32 rounds them in space, and their places in the image are snapped
to a grid. Then it asks whether a pixel's centre c is in the moved triangle. Let P be the triangle in the image and P'
the moved one, each corner by δ at most in x and in y. If c is in P', it is Σ λᵢ Pᵢ' with weights λᵢ >= 0 of sum 1, and
Σ λᵢ Pᵢ is a point of P that is within δ of c. If c is not in P', not all of the square of half width δ around c is
inside P: on the way from P to P' no point of the boundary moves by more than δ, so it would never meet c, around which
it winds once. So whatever the rasteriser decides, some ray through that square decides, and meets the triangle where
the moved one has its depth at c. The same holds in space, for rays moved to the side by as much as the corners are.
So a pixel is a bundle of rays, and only an edge that goes through the bundle leaves open what it shows.

The depth is interpolated in the window, where it is linear, and kept in so many bits: depth_interpolation.py bounds
what is lost on the way. The functions here that say so are overrides, as in ray_offsets.py.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any

from flint import arb

from comparisons.depth_interpolation import depth_errors, movement_in_space, window_error
from comparisons.triangle_tests import moeller_trumbore_distance
from comparisons.view_volume import view_volume
from reference_tracer.bounding_volume import certainly_less, clip
from reference_tracer.features import PERSPECTIVE
from reference_tracer.scene_data import TRIANGLE_A, TRIANGLE_B, TRIANGLE_C, vector_of
from reference_tracer.triangle import triangle_distance
from reference_tracer.vector import add, along, normalize, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

    from comparisons.error_model import ErrorModel
    from reference_tracer.camera import Frame
    from reference_tracer.numbers import Scalar, Vector
    from reference_tracer.scene_data import SceneData
    from scenes.scene import Scene

image_spread: list[Scalar] = [0.0, 0.0]
"""In pixels, to the right and down."""
origin_spread: list[Scalar] = [0.0, 0.0, 0.0]
depth_error: list[Scalar] = []
"""Of each triangle: of the distance, or with perspective of its inverse."""


def rasterisation_overrides(error_model: ErrorModel) -> dict[str, Callable[..., Any]]:
    """The functions of the tracer's source that a rasteriser's way replaces."""
    if error_model.depth_bits is None:
        return {}
    return {
        "primary_ray": bundle_of_rays,
        "distance_to_triangle": interpolated_distance,
        "box_is_missed": box_is_missed_at_any_distance,
        # The truth's own test keeps the distance between those of the corners, and a rasteriser does not.
        "triangle_distance": moeller_trumbore_distance,
    }


def rasterisation_constants(error_model: ErrorModel, scene: Scene) -> dict[str, Any]:
    """The constants of the overrides by name, as lists of balls about 0."""
    if error_model.depth_bits is None:
        return {}
    volume = view_volume(scene)
    # Depth in the window, from 0 to 1, is linear in the distance, or with perspective in its inverse; times the cosine
    # between the ray and the forward direction, which is at most 1.
    is_perspective = scene.camera.projection == "perspective"
    unit = 1 / volume.near - 1 / volume.far if is_perspective else volume.far - volume.near
    errors = depth_errors(scene, volume, error_model.image_radius) + 2.0**-error_model.depth_bits
    return {
        "image_spread": [arb(0, window_error(scene))] * 2,
        "origin_spread": [arb(0, movement_in_space(scene, volume))] * 3,
        "depth_error": [arb(0, float(error) * unit) for error in errors],
    }


def bundle_of_rays(frame: Frame, x: Scalar, y: Scalar) -> tuple[Vector, Vector]:
    """All rays that a pixel stands for."""
    position, corner, pixel_right, pixel_down, forward = frame
    on_image = along(along(corner, pixel_right, x + image_spread[0]), pixel_down, y + image_spread[1])
    start = add(position, (origin_spread[0], origin_spread[1], origin_spread[2]))
    if PERSPECTIVE:
        return start, normalize(on_image)
    return add(start, on_image), forward


def interpolated_distance(scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int) -> Scalar:
    """The distance to a triangle, as it comes out of the z-buffer."""
    if triangle == left:
        return inf
    distance = triangle_distance(
        origin,
        direction,
        vector_of(scene, TRIANGLE_A, triangle),
        vector_of(scene, TRIANGLE_B, triangle),
        vector_of(scene, TRIANGLE_C, triangle),
    )
    if distance < inf:
        if PERSPECTIVE:
            return 1.0 / (1.0 / distance + depth_error[triangle])
        return distance + depth_error[triangle]
    return inf


def box_is_missed_at_any_distance(origin: Vector, direction: Vector, low: Vector, high: Vector, end: Scalar) -> bool:  # noqa: ARG001 - the signature of the function it stands for
    """Whether no ray of the bundle meets the box, however far away: what is in it may yet win by its error of depth."""
    to_low = subtract(low, origin)
    to_high = subtract(high, origin)
    entry = 0.0
    leave = inf
    for axis in range(3):
        if certainly_less(0.0, direction[axis]):
            entry, leave = clip(entry, leave, direction[axis], to_low[axis], to_high[axis])
        elif certainly_less(direction[axis], 0.0):
            entry, leave = clip(entry, leave, direction[axis], to_high[axis], to_low[axis])
    return certainly_less(leave, entry)
