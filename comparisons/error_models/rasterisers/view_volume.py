"""What a rasteriser sees: the near and far planes drawn tight around a scene of triangles, and what it cuts off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from raytruth.scenes.exporters.triangle_soup import triangles_of_scene

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

Array = NDArray[np.float64]

# So that no rounding cuts what is seen off at the planes, and yet little of the z-buffer's range is lost.
MARGIN = 2.0**-10

# Half-spaces a·p >= 0 of homogeneous points p = (x, y, w, depth, 1), where the picture is |x| <= w, |y| <= w.
IN_PICTURE = np.array([[1.0, 0, 1, 0, 0], [-1.0, 0, 1, 0, 0], [0, 1.0, 1, 0, 0], [0, -1.0, 1, 0, 0], [0, 0, 0, 1.0, 0]])
# Mesa's draw module cuts at twice the picture (draw_cliptest_tmp.h, DO_CLIP_XY_GUARD_BAND).
IN_GUARD_BAND = np.array([[0.5, 0, 1, 0, 0], [-0.5, 0, 1, 0, 0], [0, 0.5, 1, 0, 0], [0, -0.5, 1, 0, 0]])


@dataclass(frozen=True)
class ViewVolume:
    """The part of space that is drawn: between depths near and far, measured along the camera's forward direction."""

    near: float
    far: float

    def half_spaces(self) -> Array:
        """The two half-spaces between which depths are seen, as factors of homogeneous corners; shape (2, 5)."""
        return np.array([[0, 0, 0, 1.0, -self.near], [0, 0, 0, -1.0, self.far]])


def homogeneous_corners(scene: Scene) -> Array:
    """The corners of all triangles as (x, y, w, depth, 1), shape (n, 3, 5); w is the depth, or 1 for parallel rays."""
    right, up, forward = camera_axes(scene)
    half_width, half_height = half_extent(scene)
    from_camera = triangles_of_scene(scene) - np.array(scene.camera.position)
    depth = from_camera @ forward
    one = np.ones_like(depth)
    w = depth if scene.camera.projection == "perspective" else one
    return np.stack([from_camera @ right / half_width, from_camera @ up / half_height, w, depth, one], axis=-1)


def camera_axes(scene: Scene) -> tuple[Array, Array, Array]:
    """The camera's axes: unit vectors to the right, up and forward, shape (3,) each."""
    forward = np.subtract(scene.camera.look_at, scene.camera.position)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, scene.camera.up)
    right /= np.linalg.norm(right)
    return right, np.cross(right, forward), forward


def half_extent(scene: Scene) -> tuple[float, float]:
    """Half the width and the height of the picture, at depth 1 of a perspective camera."""
    camera = scene.camera
    if camera.projection == "perspective":
        half_height = float(np.tan(np.radians(camera.vertical_field_of_view) / 2))
    else:
        half_height = camera.view_height / 2
    return half_height * camera.width / camera.height, half_height


def view_volume(scene: Scene) -> ViewVolume:
    """The least volume that holds all that is in the picture; depths from 1 to 2 where nothing is."""
    corners = homogeneous_corners(scene)
    whole = is_inside(corners, IN_PICTURE)
    seen = [corners[whole].reshape(-1, 5), *(clipped(triangle, IN_PICTURE) for triangle in corners[~whole])]
    depths = np.concatenate(seen)[:, 3]
    if not len(depths):
        return ViewVolume(1.0, 2.0)
    return ViewVolume(float(depths.min()) * (1 - MARGIN), float(depths.max()) * (1 + MARGIN))


def is_inside(corners: Array, half_spaces: Array) -> NDArray[np.bool_]:
    """Which of the triangles, shape (n, 3, 5), lie in all half-spaces."""
    return np.asarray((corners @ half_spaces.T >= 0).all(axis=(1, 2)))


def clipped(polygon: Array, half_spaces: Array) -> Array:
    """The part of a convex polygon, shape (k, 5), in all half-spaces, k = 0 if none is (Sutherland, Hodgman 1974)."""
    for half_space in half_spaces:
        heights = polygon @ half_space
        kept = []
        for here, height, there, next_height in zip(
            polygon, heights, np.roll(polygon, -1, axis=0), np.roll(heights, -1), strict=True
        ):
            if height >= 0:
                kept.append(here)
            if (height >= 0) != (next_height >= 0):
                kept.append(here + (there - here) * height / (height - next_height))
        polygon = np.array(kept).reshape(-1, 5)
    return polygon
