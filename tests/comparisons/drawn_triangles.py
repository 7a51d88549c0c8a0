"""A rasteriser in float32 as llvmpipe is one, without clipping; and scenes of triangles that need none."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.error_models.rasterisers.view_volume import (
    camera_axes,
    half_extent,
    homogeneous_corners,
    view_volume,
)
from raytruth.comparisons.records.renderings import FirstHits, Rays
from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.exporters.triangle_soup import triangles_of_scene
from tests.scenes.exporter_scenes import build

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

F = np.float32
PERSPECTIVE = {"projection": "perspective", "vertical_field_of_view": 50.0}
ORTHOGRAPHIC = {"projection": "orthographic", "view_height": 4.5}


def triangle_scene(seed: int, projection: dict[str, Any], triangles: int = 16) -> Scene:
    """Random triangles of all sizes between depths 3 and 7, the camera far from the origin."""
    numbers = random.Random(seed)
    away = np.array([numbers.uniform(-20, 20) for _ in range(3)])
    objects = []
    for _ in range(triangles):
        middle = away + [numbers.uniform(-1, 1) for _ in range(3)]
        size = 2.0 ** numbers.uniform(0.5, 1.5)
        corners = [tuple(middle + [size * numbers.uniform(-0.5, 0.5) for _ in range(3)]) for _ in range(3)]
        objects.append({"shape": "triangle", "vertices": corners, "material": "m"})
    camera = {"position": tuple(away + np.array([0.3, 0.4, 5.0])), "look_at": tuple(away), "width": 24, "height": 18}
    return build(objects=objects, camera=camera | projection)


def drawn(scene: Scene, subpixel_bits: int = 8) -> FirstHits:
    """First hits from float32's transform, snapped corners, planes of depth and a z-buffer."""
    camera = scene.camera
    corners = window_corners(scene)
    xs, ys = np.meshgrid(np.arange(camera.width, dtype=F), np.arange(camera.height, dtype=F))
    buffer = np.ones((camera.height, camera.width), dtype=F)
    primitive = np.full(buffer.shape, -1)
    for number, triangle in enumerate(corners):
        z = depth_plane(triangle, xs, ys)
        nearer = covered(triangle, xs, ys, subpixel_bits) & (z < buffer)
        buffer[nearer], primitive[nearer] = z[nearer], number
    return first_hits_of(scene, buffer, primitive)


def window_corners(scene: Scene) -> NDArray[np.float32]:
    """Places of all corners in the window, y down, and their depths there; shape (n, 3, 3)."""
    camera = scene.camera
    volume = view_volume(scene)
    right, up, forward = camera_axes(scene)
    half_width, half_height = half_extent(scene)
    rows = np.array([right / half_width, -up / half_height, forward])
    view = np.column_stack([rows, -rows @ np.array(camera.position)])
    near, far = volume.near, volume.far
    if camera.projection == "perspective":
        z = (far + near) / (far - near) * view[2] - [0, 0, 0, 2 * far * near / (far - near)]
        w = view[2]
    else:
        z = 2 / (far - near) * view[2] - [0, 0, 0, (far + near) / (far - near)]
        w = np.array([0.0, 0.0, 0.0, 1.0])
    matrix = np.array([view[0], view[1], z, w]).astype(F)
    points = triangles_of_scene(scene).astype(F)
    clip = matrix[:, 0] * points[..., :1] + matrix[:, 1] * points[..., 1:2]
    clip = (clip + matrix[:, 2] * points[..., 2:]) + matrix[:, 3]
    half = np.array([camera.width / 2, camera.height / 2, 0.5], dtype=F)
    window: NDArray[np.float32] = clip[..., :3] * (F(1) / clip[..., 3:]) * half + half
    assert window.dtype == F
    return window


def exact_corners(scene: Scene) -> NDArray[np.float64]:
    """Places in the window and depths there, in float64."""
    corners, volume = homogeneous_corners(scene), view_volume(scene)
    size = np.array([scene.camera.width, scene.camera.height])
    places = (corners[..., :2] / corners[..., 2:3] * [1, -1] + 1) * size / 2
    depth = (corners[..., 3] - volume.near) / (volume.far - volume.near)
    if scene.camera.projection == "perspective":
        depth *= volume.far / corners[..., 3]
    return np.asarray(np.concatenate([places, depth[..., np.newaxis]], axis=-1))


def covered(
    triangle: NDArray[np.float32], xs: NDArray[np.float32], ys: NDArray[np.float32], subpixel_bits: int
) -> NDArray[np.bool_]:
    """Which pixels' centres are in the snapped triangle, edges included."""
    step = 2**subpixel_bits
    x, y = np.rint((triangle[:, :2] - F(0.5)) * F(step)).astype(np.int64).T
    px, py = xs.astype(np.int64) * step, ys.astype(np.int64) * step
    sides = [(x[i] - px) * (y[(i + 1) % 3] - py) - (y[i] - py) * (x[(i + 1) % 3] - px) for i in range(3)]
    inside = np.all([side >= 0 for side in sides], axis=0) | np.all([side <= 0 for side in sides], axis=0)
    return np.asarray(inside & (sum(sides) != 0))


def depth_plane(triangle: NDArray[np.float32], xs: NDArray[np.float32], ys: NDArray[np.float32]) -> NDArray[np.float32]:
    """The depth at pixels' centres, from corners that are not snapped."""
    (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = triangle
    with np.errstate(all="ignore"):  # of triangles that nothing is seen of
        inverse = F(1) / ((x0 - x1) * (y2 - y0) - (y0 - y1) * (x2 - x0))
        slope_x = (z0 - z1) * ((y2 - y0) * inverse) - (z2 - z0) * ((y0 - y1) * inverse)
        slope_y = (z2 - z0) * ((x0 - x1) * inverse) - (z0 - z1) * ((x2 - x0) * inverse)
        at_origin = z0 - (slope_x * (x0 - F(0.5)) + slope_y * (y0 - F(0.5)))
        return np.asarray(at_origin + slope_x * xs + slope_y * ys)


def view_corners(scene: Scene) -> NDArray[np.float32]:
    """Corners in view coordinates, z forward, by a float32 matrix; shape (n, 3, 3)."""
    rows = np.array(camera_axes(scene))
    matrix = np.column_stack([rows, -rows @ np.array(scene.camera.position)]).astype(F)
    points = triangles_of_scene(scene).astype(F)
    moved = matrix[:, 0] * points[..., :1] + matrix[:, 1] * points[..., 1:2]
    return np.asarray((moved + matrix[:, 2] * points[..., 2:]) + matrix[:, 3])


def drawn_positions(
    scene: Scene, triangle: int, xs: NDArray[np.float32], ys: NDArray[np.float32]
) -> NDArray[np.float32]:
    """Where llvmpipe's formulas put the fragments of a triangle, in view coordinates, all in float32."""
    window, view = window_corners(scene)[triangle], view_corners(scene)[triangle]
    inverse = F(1) / view[:, 2] if scene.camera.projection == "perspective" else np.ones(3, dtype=F)

    def plane(values: NDArray[np.float32]) -> NDArray[np.float32]:
        return depth_plane(np.column_stack([window[:, :2], values]), xs, ys)

    w = F(1) / plane(inverse)
    positions = np.stack([plane(view[:, axis] * inverse) * w for axis in range(3)], axis=-1)
    assert positions.dtype == F
    return positions


def first_hits_of(scene: Scene, buffer: NDArray[np.float32], primitive: NDArray[np.int64]) -> FirstHits:
    """What a z-buffer and numbers of triangles tell."""
    volume = view_volume(scene)
    rays = Rays(*primary_rays(scene))
    z = buffer.astype(np.float64)
    if scene.camera.projection == "perspective":
        depth = 1 / (1 / volume.near - z * (1 / volume.near - 1 / volume.far))
    else:
        depth = volume.near + z * (volume.far - volume.near)
    distance = np.where(primitive < 0, np.inf, depth / (rays.directions @ camera_axes(scene)[2]))
    corners = triangles_of_scene(scene)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    with np.errstate(invalid="ignore"):
        position = rays.origins + distance[..., np.newaxis] * rays.directions
    return FirstHits(distance, position, normals[primitive], primitive)
