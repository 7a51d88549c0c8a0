"""The triangles that VTK and Mesa's llvmpipe draw: those of the scene, or what is left where they are cut.

Corners are transformed to clip coordinates by one matrix, cut where they reach beyond the guard band or the near and
far planes, divided by w, and put into the window; there all else is interpolated. Everything in units of u, the
roundoff. Bounds are of first order in u, and rounded up to hold those of higher order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.rasterisers.view_volume import (
    IN_GUARD_BAND,
    Array,
    clipped,
    half_extent,
    homogeneous_corners,
    is_inside,
)
from raytruth.scenes.exporters.triangle_soup import triangles_of_scene

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.rasterisers.view_volume import ViewVolume
    from raytruth.scenes.scene import Scene

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
    is_cut = cut_triangles(homogeneous_corners(scene), volume).any()
    roundoffs = CLIPPING_ROUNDOFFS if is_cut else TRANSFORM_ROUNDOFFS
    return roundoffs * ROUNDOFF * extent_of(scene) * math.sqrt(3)


def extent_of(scene: Scene) -> float:
    """The bound |v| + |p| on coordinates: v is the corner that is farthest from the origin, p the camera's position."""
    farthest = np.linalg.norm(triangles_of_scene(scene), axis=2).max(initial=0.0)
    return float(farthest + np.linalg.norm(scene.camera.position))


def cut_triangles(corners: Array, volume: ViewVolume) -> NDArray[np.bool_]:
    """Which of the triangles, shape (n, 3, 5), are cut at a border of the view and so not drawn whole; shape (n,)."""
    return ~is_inside(corners, _kept(volume))


def of_each_triangle(
    scene: Scene, volume: ViewVolume, largest: Callable[[DrawnPieces, int], Array], nothing: list[float]
) -> Array:
    """The largest of some values over all pieces that a triangle is drawn in, for each triangle; shape (k, n).

    `largest` gives k values for each of m pieces, shape (k, m), from these and the roundoffs of their clip coordinates.
    `nothing` has the k values of a triangle of which nothing is drawn.

    `largest` gives it for each of m pieces, shape (k, m), from these and the roundoffs of their clip coordinates.
    """
    corners = homogeneous_corners(scene)
    cut = cut_triangles(corners, volume)
    moved = movement_in_space(scene, volume)
    values = np.repeat(np.array(nothing)[:, np.newaxis], len(corners), axis=1)
    values[:, ~cut] = largest(DrawnPieces.of(corners[~cut], scene, moved), TRANSFORM_ROUNDOFFS)
    for triangle in np.flatnonzero(cut):
        polygon = clipped(corners[triangle], _kept(volume))
        if len(polygon) > 2:
            pieces = DrawnPieces.of(_fans(polygon), scene, moved)
            values[:, triangle] = largest(pieces, CLIPPING_ROUNDOFFS).max(axis=1)
    return values


def _fans(polygon: Array) -> Array:
    """All triangles that a cut one may be drawn as: fans from each corner of what is left, shape (m, 3, 5)."""
    rolled = [np.roll(polygon, -first, axis=0) for first in range(len(polygon))]
    return np.array([[fan[0], fan[i], fan[i + 1]] for fan in rolled for i in range(1, len(fan) - 1)])


@dataclass(frozen=True)
class DrawnPieces:
    """m pieces of triangles that are each drawn whole: triangles, or what is left of cut ones."""

    corners: Array
    """Homogeneous coordinates (x, y, w, depth, 1), shape (m, 3, 5)."""
    places: Array
    """Their corners in the window, in pixels from its middle, shape (m, 3, 2)."""
    moved: Array
    """How far rounding may move their corners in the window, shape (m,)."""
    size: Array
    """Width and height of the window."""

    @classmethod
    def of(cls, corners: Array, scene: Scene, moved: float) -> DrawnPieces:
        """Pieces with these homogeneous corners, shape (m, 3, 5); rounding may move them in space by `moved`."""
        size = np.array([scene.camera.width, scene.camera.height])
        w = corners[..., 2]
        # A movement in space changes x/w by itself over w, and by x/w times as much of w, where |x/w| is at most 2.
        pixels = size / 2 * (1 / np.array(half_extent(scene)) + 2)
        return cls(
            corners=corners,
            places=corners[..., :2] / w[..., np.newaxis] * size / 2,
            moved=window_error(scene) + moved * pixels.max() / w.min(axis=1),
            size=size,
        )

    @cached_property
    def extent(self) -> Array:
        """The width and the height of each piece in the window, in pixels, movements included; shape (m, 2)."""
        extent: Array = np.abs(_edges(self.places)).max(axis=1) + 2 * self.moved[:, np.newaxis]
        return extent

    @cached_property
    def exact_double_area(self) -> Array:
        """Twice the area in the window, without regard to movements."""
        edges = _edges(self.places)
        return np.abs(_cross(edges[..., 0], edges[..., 1]))

    @cached_property
    def double_area(self) -> Array:
        """Twice the least area in the window, in square pixels; not above 0 where nothing is known of it."""
        least: Array = self.exact_double_area - 4 * self.moved * self.extent.sum(axis=1)
        return least

    @cached_property
    def shape(self) -> Array:
        """κ, twice a piece's width times height over twice its least area: 2 at least, and large for a sliver."""
        with np.errstate(divide="ignore"):
            shape: Array = 2 * self.extent.prod(axis=1) / self.double_area
        return shape

    @cached_property
    def is_bounded(self) -> NDArray[np.bool_]:
        """Whether error bounds of first order hold for a piece, which is not too thin for them; shape (m,)."""
        return (self.double_area > 0) & (self.shape < LARGEST_SHAPE)

    def beyond(self, snapping: float) -> Array:
        """The largest sum of absolute barycentric coordinates of pixels' centres that count: 1, and more outside."""
        with np.errstate(divide="ignore"):
            beyond: Array = 1 + 6 * (snapping + self.moved) * self.extent.sum(axis=1) / self.double_area
        return beyond

    def plane_error(self, values: Array, beyond: Array) -> Array:
        """How far what is interpolated from the corners' values, of shape (m, 3), may be off.

        llvmpipe (lp_state_setup.c) computes z = a + x ∂z/∂x + y ∂z/∂y with ∂z/∂x = (Δz₀₁ Δy₂₀ - Δz₂₀ Δy₀₁) / D and
        D = Δx₀₁ Δy₂₀ - Δx₂₀ Δy₀₁. With extents X, Y, Z of the triangle and κ = 2XY/|D|, that is 2 at least: 1/D has a
        relative error of (3κ + 2)u, at most 4κu, which counts for the rise from a corner; the products of the numerator
        one of 5u, of 2ZY/|D|, at a distance of X, and so in y, in all 10κu·Z. Then a, of which terms have 10u and are
        below 3/2 of the window, with its guard band, times the slopes, and 4u of the value itself.
        """
        rises = _edges(values)
        rise = np.abs(rises).max(axis=1)
        edges = _edges(self.places)
        unsure = 4 * self.moved
        numerators = [np.abs(_cross(rises, edges[..., axis])) + unsure * rise for axis in (1, 0)]
        with np.errstate(divide="ignore", invalid="ignore"):
            across = (np.stack(numerators, axis=1) * self.size).sum(axis=1) / self.double_area
            largest = np.abs(values).max(axis=1) * beyond
            error: Array = ROUNDOFF * (16 * self.shape * rise * beyond + 16 * across + 4 * largest)
        return error


def _edges(values: Array) -> Array:
    return values - np.roll(values, 1, axis=1)


def _cross(first: Array, second: Array) -> Array:
    """The cross product of two edges, in the plane of two coordinates of theirs, shape (m, 3) each."""
    product: Array = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return product


def _kept(volume: ViewVolume) -> Array:
    return np.concatenate([IN_GUARD_BAND, volume.half_spaces()])
