"""How wide shapes are in the picture: what is narrower than the points lie apart can hide between them."""

from __future__ import annotations

from math import inf, radians, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.noise.splat_bound import GRID
from raytruth.reference_tracer.tables import triangles_of
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

    Array = NDArray[np.float64]

# In pixels. A disc wider than the diagonal of a square grid's cell holds a point of the grid, wherever it lies. The
# grid is that of the bound on splats, which is coarser than that of the means over pixels.
LEAST_WIDTH = sqrt(2) / GRID


def narrowest_width(scene: Scene) -> float:
    """Of all shapes that reach before the camera, in pixels; infinite without any.

    A sphere is as wide as its diameter, a triangle as the circle inscribed in it, both seen from the front at the
    farthest that they reach along the camera's axis. For a perspective camera.
    """
    camera = scene.camera
    assert camera.projection == "perspective", "other cameras see no light that is traced forward"
    axis = np.subtract(camera.look_at, camera.position)
    axis /= np.linalg.norm(axis)
    pixel = 2 * tan(radians(camera.vertical_field_of_view) / 2) / camera.height
    widths, farthest = (
        np.concatenate(both) for both in zip(_of_spheres(scene, axis), _of_triangles(scene, axis), strict=True)
    )
    before = farthest > 0
    return float((widths[before] / (farthest[before] * pixel)).min(initial=inf))


def _of_spheres(scene: Scene, axis: Array) -> tuple[Array, Array]:
    """Diameters, and the farthest along the axis; shape (spheres,) each."""
    spheres = [shape for shape in scene.objects if isinstance(shape, Sphere)]
    radii = np.array([sphere.radius for sphere in spheres])
    centers = np.array([sphere.center for sphere in spheres]).reshape(-1, 3)
    return 2 * radii, (centers - np.array(scene.camera.position)) @ axis + radii


def _of_triangles(scene: Scene, axis: Array) -> tuple[Array, Array]:
    """Diameters of inscribed circles, and the farthest along the axis; shape (triangles,) each."""
    corners, _ = triangles_of(scene)
    a, b, c = corners.transpose(1, 0, 2)
    # The circle inscribed in a triangle has twice the area over the perimeter as its radius (Euclid, Elements IV.4).
    doubled_areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    perimeters = sum(np.linalg.norm(side, axis=1) for side in (b - a, c - b, a - c))
    return 2 * doubled_areas / perimeters, ((corners - np.array(scene.camera.position)) @ axis).max(axis=1)
