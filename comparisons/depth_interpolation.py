"""What float32 may do to corners of triangles and to depths on their way into a z-buffer, with VTK and Mesa's llvmpipe.

Corners are transformed to clip coordinates by one matrix, cut where they reach beyond the guard band or the near and
far planes, divided by w, and put into the window; depths are interpolated there. Everything in units of u, the
roundoff. Bounds are of first order in u, and rounded up to hold those of higher order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comparisons.view_volume import (
    IN_GUARD_BAND,
    Array,
    clipped,
    half_extent,
    homogeneous_corners,
    is_inside,
)
from scenes.exporters.triangle_soup import triangles_of_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from comparisons.view_volume import ViewVolume
    from scenes.scene import Scene

ROUNDOFF = 2.0**-24
# A clip coordinate is Σ mᵢ vᵢ: m, v and their product are rounded, and three sums. Rounded up from six.
TRANSFORM_ROUNDOFFS = 8
# Where a triangle is cut, up to six planes each interpolate new corners: a difference, a product, a sum, of numbers
# that are no larger than those of the corners.
CLIPPING_ROUNDOFFS = 32
# x · (1/w) · W/2 + W/2 - 1/2: five operations, whose results in a guard band of twice the picture are below 3/2 W.
WINDOW_ROUNDOFFS = 8
# Times the extents over the area, beyond which bounds of first order in u do not hold.
LARGEST_SHAPE = 2.0**18


def window_error(scene: Scene) -> float:
    """How far rounding may move a corner in the window, in pixels."""
    return WINDOW_ROUNDOFFS * ROUNDOFF * max(scene.camera.width, scene.camera.height)


def movement_in_space(scene: Scene, volume: ViewVolume) -> float:
    """How far from each corner, along each axis, the point may be that its clip coordinates x, y and w stand for.

    A row of the view matrix is a unit vector r and its product with the camera's position p. So γ roundoffs move what
    the point has along r by γu·(|v| + |p|) at most, and each of its coordinates by √3 times that.
    """
    is_cut = _cut(homogeneous_corners(scene), volume).any()
    roundoffs = CLIPPING_ROUNDOFFS if is_cut else TRANSFORM_ROUNDOFFS
    return roundoffs * ROUNDOFF * _extent(scene) * math.sqrt(3)


@dataclass(frozen=True)
class DepthErrors:
    """Of each triangle, at any pixel that it may cover; shape (n,). Infinity for one seen too nearly edge on."""

    bounds: Array
    """On the error of the depth in the window, in units of the range from near to far."""
    beyond: Array
    """On the sum of absolute values of a pixel centre's barycentric coordinates: 1, and more where it is outside."""


def depth_errors(scene: Scene, volume: ViewVolume, snapping: float) -> DepthErrors:
    """Bounds for all triangles of a scene, whose corners are snapped by up to so many pixels."""
    corners = homogeneous_corners(scene)
    cut = _cut(corners, volume)
    moved = movement_in_space(scene, volume)
    # Of a triangle outside of everything nothing is drawn.
    errors = np.stack([np.zeros(len(corners)), np.ones(len(corners))])
    errors[:, ~cut] = _Pieces.of(corners[~cut], scene, volume, moved).errors(TRANSFORM_ROUNDOFFS, snapping)
    for triangle in np.flatnonzero(cut):
        polygon = clipped(corners[triangle], _kept(volume))
        if len(polygon) > 2:
            pieces = _Pieces.of(_fans(polygon), scene, volume, moved)
            errors[:, triangle] = pieces.errors(CLIPPING_ROUNDOFFS, snapping).max(axis=1)
    return DepthErrors(*errors)


def _fans(polygon: Array) -> Array:
    """All triangles that a cut one may be drawn as: fans from each corner of what is left, shape (m, 3, 5)."""
    rolled = [np.roll(polygon, -first, axis=0) for first in range(len(polygon))]
    return np.array([[fan[0], fan[i], fan[i + 1]] for fan in rolled for i in range(1, len(fan) - 1)])


@dataclass(frozen=True)
class _Pieces:
    """m triangles that are drawn whole."""

    places: Array
    """Their corners in the window, in pixels from its middle, shape (m, 3, 2)."""
    depths: Array
    """From 0 on the near plane to 1 on the far one, shape (m, 3)."""
    moved: Array
    """How far rounding may move their corners in the window, shape (m,)."""
    corner_roundoff: Array
    """By how much one roundoff of the clip coordinates changes a corner's depth, shape (m,)."""
    size: Array
    """Width and height of the window."""

    @classmethod
    def of(cls, corners: Array, scene: Scene, volume: ViewVolume, moved: float) -> _Pieces:
        """From homogeneous coordinates, shape (m, 3, 5)."""
        near, far = volume.near, volume.far
        size = np.array([scene.camera.width, scene.camera.height])
        w, depth = corners[..., 2], corners[..., 3]
        nearest_w = w.min(axis=1)
        depths = (depth - near) / (far - near)
        # z in clip coordinates is α·depth - β, half of which over w is the depth in the window, shifted by 1/2.
        alpha, beta = 2 / (far - near), (far + near) / (far - near)
        if scene.camera.projection == "perspective":
            depths *= far / depth
            alpha, beta = beta, 2 * far * near / (far - near)
        # A movement in space changes x/w by itself over w, and by x/w times as much of w, where |x/w| is at most 2.
        pixels = size / 2 * (1 / np.array(half_extent(scene)) + 2)
        return cls(
            places=corners[..., :2] / w[..., np.newaxis] * size / 2,
            depths=depths,
            moved=window_error(scene) + moved * pixels.max() / nearest_w,
            # Twice α, since w may stand for another depth than the corner's own.
            corner_roundoff=ROUNDOFF * (2 * alpha * _extent(scene) + beta) / (2 * nearest_w),
            size=size,
        )

    def errors(self, corner_roundoffs: int, snapping: float) -> Array:
        """Bounds as in DepthErrors, shape (2, m).

        llvmpipe (lp_state_setup.c) computes z = a + x ∂z/∂x + y ∂z/∂y with ∂z/∂x = (Δz₀₁ Δy₂₀ - Δz₂₀ Δy₀₁) / D and
        D = Δx₀₁ Δy₂₀ - Δx₂₀ Δy₀₁. With extents X, Y, Z of the triangle and κ = 2XY/|D|, that is 2 at least: 1/D has a
        relative error of (3κ + 2)u, at most 4κu, which counts for the rise from a corner; the products of the numerator
        one of 5u, of 2ZY/|D|, at a distance of X, and so in y, in all 10κu·Z. Then a, of which terms have 10u and are
        below 3/2 of the window, with its guard band, times the slopes, and 4u for the depth itself.
        """
        edges = self.places - np.roll(self.places, 1, axis=1)
        extent = np.abs(edges).max(axis=1) + 2 * self.moved[:, np.newaxis]
        rises = self.depths - np.roll(self.depths, 1, axis=1)
        rise = np.abs(rises).max(axis=1)
        unsure = 4 * self.moved
        double_area = np.abs(_cross(edges[..., 0], edges[..., 1])) - unsure * extent.sum(axis=1)
        numerators = [np.abs(_cross(rises, edges[..., axis])) + unsure * rise for axis in (1, 0)]
        with np.errstate(divide="ignore", invalid="ignore"):
            shape = 2 * extent.prod(axis=1) / double_area
            across = (np.stack(numerators, axis=1) * self.size).sum(axis=1) / double_area
            beyond = 1 + 6 * (snapping + self.moved) * extent.sum(axis=1) / double_area
            of_plane = ROUNDOFF * (16 * shape * rise * beyond + 16 * across + 4)
            # Three operations from clip coordinates to the window.
            of_corners = beyond * (corner_roundoffs * self.corner_roundoff + 4 * ROUNDOFF)
        is_bounded = (double_area > 0) & (shape < LARGEST_SHAPE)
        return np.where(is_bounded, [of_plane + of_corners, beyond], np.inf)


def _cross(first: Array, second: Array) -> Array:
    """The cross product of two edges, in the plane of two coordinates of theirs, shape (m, 3) each."""
    product: Array = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return product


def _kept(volume: ViewVolume) -> Array:
    return np.concatenate([IN_GUARD_BAND, volume.half_spaces()])


def _cut(corners: Array, volume: ViewVolume) -> NDArray[np.bool_]:
    """Which triangles are not drawn whole."""
    return ~is_inside(corners, _kept(volume))


def _extent(scene: Scene) -> float:
    """|v| + |p| of the farthest corner v from the origin."""
    farthest = np.linalg.norm(triangles_of_scene(scene), axis=2).max(initial=0.0)
    return float(farthest + np.linalg.norm(scene.camera.position))
