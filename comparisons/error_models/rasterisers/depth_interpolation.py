"""What float32 may do to depths on their way into a z-buffer, with VTK and Mesa's llvmpipe (drawn_pieces.py)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.rasterisers.drawn_pieces import ROUNDOFF, extent_of, of_each_triangle

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.rasterisers.drawn_pieces import DrawnPieces
    from raytruth.comparisons.error_models.rasterisers.view_volume import Array, ViewVolume
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class DepthErrors:
    """How far depths may be off at any pixel that a triangle may cover, shape (n,); infinite for one nearly edge on."""

    bounds: Array
    """Bounds on the error of the depth in the window, in units of the range from near to far."""
    beyond: Array
    """Bounds on the sum of a pixel centre's absolute barycentric coordinates: 1, and more where it is outside."""


def depth_errors(scene: Scene, volume: ViewVolume, snapping: float) -> DepthErrors:
    """Bounds on the depths of all triangles of a scene, whose corners are snapped by up to `snapping` pixels."""
    near, far = volume.near, volume.far
    is_perspective = scene.camera.projection == "perspective"
    # z in clip coordinates is α·depth - β, half of which over w is the depth in the window, shifted by 1/2.
    alpha, beta = 2 / (far - near), (far + near) / (far - near)
    if is_perspective:
        alpha, beta = beta, 2 * far * near / (far - near)

    def errors(pieces: DrawnPieces, corner_roundoffs: int) -> Array:
        depth = pieces.corners[..., 3]
        # From 0 on the near plane to 1 on the far one.
        depths = (depth - near) / (far - near) * (far / depth if is_perspective else 1.0)
        # By how much one roundoff of the clip coordinates changes a corner's depth. Twice α, since w may stand for
        # another depth than the corner's own.
        corner_roundoff = ROUNDOFF * (2 * alpha * extent_of(scene) + beta) / (2 * pieces.corners[..., 2].min(axis=1))
        beyond = pieces.beyond(snapping)
        # Three operations from clip coordinates to the window.
        of_corners = beyond * (corner_roundoffs * corner_roundoff + 4 * ROUNDOFF)
        return np.where(pieces.is_bounded, [pieces.plane_error(depths, beyond) + of_corners, beyond], np.inf)

    # Of a triangle outside of everything nothing is drawn.
    return DepthErrors(*of_each_triangle(scene, volume, errors, [0.0, 1.0]))
