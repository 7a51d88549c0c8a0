"""The mean of the radiance over the area of each pixel: what a renderer gives that sends light to the whole pixel."""

from __future__ import annotations

from math import isqrt, radians, tan
from typing import TYPE_CHECKING

import numpy as np

from raytruth.reference_tracer.rendering import first_hits, prepare, primary_rays, render

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.ray_offset_model import RayOffset
    from raytruth.scenes.scene import Scene

    Array = NDArray[np.float64]

# Points of an image, which take some 500 MB for a while: 24 along each side of a pixel of the library's scenes. On an
# edge with n points a side the interval is about 2/n of the step across it wide. With 24, the interval of an image's
# mean is within 0.3 to 1.7 % of it.
POINTS = 1 << 22
FEWEST_POINTS_A_SIDE = 2


def area_means(scene: Scene) -> tuple[Array, Array]:
    """Bounds on each pixel's mean over its area: the least and the largest, linear RGB, shape (height, width, 3) each.

    The radiance is computed at a regular grid of points. Each stands for its cell, with the least and the largest of
    its eight neighbours. So an edge between two points may lie anywhere between them, and half a cell more is left for
    a renderer whose image is displaced by as much, as where rays start off a surface. It assumes that nothing is
    smaller than a cell; of shapes, shape_widths.py tells.
    """
    grid = _points_a_side(scene)
    points = render(enlarged(scene, grid))
    low, high = (_pixel_means(_over_neighbours(points, choose), grid) for choose in (np.minimum, np.maximum))
    return low, high


def largest_displacement(scene: Scene, offset: RayOffset) -> float:
    """How far beside a surface that is seen rays start at most, in half widths of a point's cell there; 0 for none.

    Above 1 the bounds of `area_means` do not hold for who starts rays so. For a perspective camera.
    """
    camera = scene.camera
    assert camera.projection == "perspective", "other cameras see no light that is traced forward"
    distances, primitives = first_hits(prepare(scene))
    seen = primitives >= 0
    origins, directions = (rays[seen] for rays in primary_rays(scene))
    points = origins + distances[seen][:, np.newaxis] * directions
    starts = offset.absolute + offset.relative * np.abs(points).max(axis=1, initial=0.0)
    cell = 2 * tan(radians(camera.vertical_field_of_view) / 2) / (camera.height * _points_a_side(scene))
    return float((starts / (distances[seen] * cell / 2)).max(initial=0.0))


def enlarged(scene: Scene, factor: int) -> Scene:
    """The same view with `factor` times as many pixels along each side."""
    return scene.resized(scene.camera.width * factor, scene.camera.height * factor)


def _points_a_side(scene: Scene) -> int:
    """Of each pixel."""
    return max(FEWEST_POINTS_A_SIDE, isqrt(POINTS // (scene.camera.width * scene.camera.height)))


def _over_neighbours(points: Array, choose: np.ufunc) -> Array:
    """The least or the largest value of each point and its neighbours, along one side and then along the other."""
    for axis in (0, 1):
        # Into one copy and by views: images of this size are memory traffic and little else.
        chosen = points.copy()
        along, here = (np.moveaxis(image, axis, 0) for image in (points, chosen))
        choose(here[1:], along[:-1], out=here[1:])
        choose(here[:-1], along[1:], out=here[:-1])
        points = chosen
    return points


def _pixel_means(points: Array, grid: int) -> Array:
    height, width, channels = points.shape
    cells = points.reshape(height // grid, grid, width // grid, grid, channels)
    means: Array = cells.mean(axis=(1, 3))
    return means
