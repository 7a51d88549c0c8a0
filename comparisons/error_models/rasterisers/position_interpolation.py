"""What float32 may do to the position in space that a fragment is lit at, with VTK and Mesa's llvmpipe.

Corners have view coordinates aᵢ, which llvmpipe divides by wᵢ, interpolates in the window, and divides by what 1/w is
interpolated to (lp_state_setup.c, apply_perspective_corr; lp_bld_interp.c). Let λᵢ be the barycentric coordinates of a
pixel's centre in the window. In exact arithmetic the fragment is at Σ μᵢ aᵢ with μᵢ = (λᵢ/wᵢ) / Σ (λⱼ/wⱼ). If qᵢ are
the points that the clip coordinates stand for, Σ μᵢ qᵢ is where the ray through the centre meets the triangle of these,
but for the rounding of places in the window, of which counts Σ |λᵢ| times what a corner's is. And Σ μᵢ aᵢ is from there
by Σ |μᵢ| times what aᵢ and qᵢ are from each other, two movements in space (drawn_pieces.py). Then come the roundings of
the interpolation itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.rasterisers.drawn_pieces import ROUNDOFF, movement_in_space, of_each_triangle
from raytruth.comparisons.error_models.rasterisers.view_volume import half_extent

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.rasterisers.drawn_pieces import DrawnPieces
    from raytruth.comparisons.error_models.rasterisers.view_volume import Array, ViewVolume
    from raytruth.scenes.scene import Scene

# 1/w, and its product with a coordinate.
QUOTIENT_ROUNDOFFS = 2
# The inverse of the interpolated 1/w, its product with a coordinate, and one of second order.
PERSPECTIVE_ROUNDOFFS = 3


@dataclass(frozen=True)
class PositionErrors:
    """How far lit positions may be off at any pixel of a triangle, shape (n,); infinite for one nearly edge on."""

    bounds: Array
    """How far along each axis a fragment may be from where its ray meets the triangle that float32 makes of this."""
    in_window: Array
    """How many times the rounding of a corner's place in the window counts."""
    in_space: Array
    """How many times the movement of a corner in space counts."""
    either_side: Array
    """1 where snapping may turn the triangle, so that its back is taken for its front; else 0."""


def position_errors(scene: Scene, volume: ViewVolume, snapping: float) -> PositionErrors:
    """Bounds on lit positions for all triangles of a scene, whose corners are snapped by up to `snapping` pixels."""
    moved = movement_in_space(scene, volume)
    scale = np.array([*half_extent(scene), 1.0])

    def errors(pieces: DrawnPieces, _: int) -> Array:
        beyond = pieces.beyond(snapping)
        inverse = 1 / pieces.corners[..., 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            least, in_space = _of_weights(inverse, beyond)
            view = pieces.corners[..., [0, 1, 3]] * scale
            rounded = _interpolation_error(pieces, view, inverse, beyond, least, in_space)
        bounds = 2 * moved * in_space + rounded
        known = pieces.is_bounded & (least > 0) & np.isfinite(bounds)
        values = np.where(known, [bounds, beyond, in_space], np.inf)
        return np.concatenate([values, [_may_turn(pieces, snapping)]])

    return PositionErrors(*of_each_triangle(scene, volume, errors, [0.0, 1.0, 1.0, 0.0]))


def _of_weights(inverse: Array, beyond: Array) -> tuple[Array, Array]:
    """The least Σ λᵢ/wᵢ, and the largest Σ |μᵢ|; shape (m,).

    The λᵢ that are negative sum up to -ν at least, 1 + 2ν = `beyond`, so that the former is no less than
    (1 + ν)·min 1/w - ν·max 1/w, and no more than -ν·max 1/w over that is negative of the μᵢ, whose sum is 1.
    """
    outside = (beyond - 1) / 2
    least, largest = inverse.min(axis=1), inverse.max(axis=1)
    sums: Array = (1 + outside) * least - outside * largest
    return sums, 1 + 2 * outside * largest / sums


def _interpolation_error(
    pieces: DrawnPieces, view: Array, inverse: Array, beyond: Array, least: Array, in_space: Array
) -> Array:
    """The error by interpolating a/w and 1/w and by the division, along the worst axis; shape (m,)."""
    of_inverse = _quotient_error(pieces, inverse, beyond)
    farthest = np.abs(view).max(axis=(1, 2)) * in_space
    of_quotients = np.max([_quotient_error(pieces, view[..., axis] * inverse, beyond) for axis in range(3)], axis=0)
    divided = (of_quotients + farthest * of_inverse) / np.maximum(least - of_inverse, 0.0)
    error: Array = divided + PERSPECTIVE_ROUNDOFFS * ROUNDOFF * farthest
    return error


def _quotient_error(pieces: DrawnPieces, values: Array, beyond: Array) -> Array:
    """The error of a value that is rounded at the corners and then interpolated."""
    rounded_before: Array = QUOTIENT_ROUNDOFFS * ROUNDOFF * beyond * np.abs(values).max(axis=1)
    return pieces.plane_error(values, beyond) + rounded_before


def _may_turn(pieces: DrawnPieces, snapping: float) -> Array:
    """1 where the corners' movements may change the sign of the area in the window, from which llvmpipe tells sides.

    Each coordinate of an edge changes by 2δ at most, so that twice the area changes by 4δ(X + Y) + 8δ² at most.
    """
    change = snapping + pieces.moved
    largest: Array = 4 * change * pieces.extent.sum(axis=1) + 8 * change**2
    return np.where(pieces.exact_double_area > largest, 0.0, 1.0)
