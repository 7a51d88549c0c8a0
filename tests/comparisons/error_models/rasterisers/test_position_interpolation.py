"""Float32's positions are off by no more than the bounds say, and the bounds are not idle."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.rasterisers.drawn_pieces import movement_in_space, window_error
from raytruth.comparisons.error_models.rasterisers.position_interpolation import position_errors
from raytruth.comparisons.error_models.rasterisers.view_volume import camera_axes, half_extent, view_volume
from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.exporters.triangle_soup import triangles_of_scene
from tests.comparisons.drawn_triangles import (
    ORTHOGRAPHIC,
    PERSPECTIVE,
    F,
    covered,
    drawn_positions,
    triangle_scene,
    window_corners,
)
from tests.scenes.exporter_scenes import build

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2")

SNAPPING = 2.0**-9
PROJECTIONS = pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC], ids=["perspective", "orthographic"])


def exact_positions(scene: Scene, triangle: int) -> NDArray[np.float64]:
    """Where the rays meet the triangle's plane, in view coordinates."""
    origins, directions = primary_rays(scene)
    a, b, c = triangles_of_scene(scene)[triangle]
    normal = np.cross(b - a, c - a)
    distance = ((a - origins) @ normal) / (directions @ normal)
    points = origins + distance[..., np.newaxis] * directions
    return np.asarray((points - np.array(scene.camera.position)) @ np.array(camera_axes(scene)).T)


def in_plane(scene: Scene, triangle: int) -> float:
    """How far a position moves where its ray, and the triangle, are moved in space by one, at most."""
    a, b, c = triangles_of_scene(scene)[triangle]
    normal = np.cross(b - a, c - a)
    _, directions = primary_rays(scene)
    return float((1 / np.abs(directions @ (normal / np.linalg.norm(normal)))).max() * math.sqrt(3))


@PROJECTIONS
@pytest.mark.parametrize("seed", range(8))
def test_float32_positions_are_off_by_no_more_than_the_bound(projection: dict[str, Any], seed: int) -> None:
    scene = triangle_scene(seed, projection)
    volume = view_volume(scene)
    errors = position_errors(scene, volume, SNAPPING)
    xs, ys = np.meshgrid(*(np.arange(side, dtype=F) for side in (scene.camera.width, scene.camera.height)))
    moved = movement_in_space(scene, volume)
    pixel = 2 * half_extent(scene)[1] / scene.camera.height
    used = []
    for triangle, corners in enumerate(window_corners(scene)):
        inside = covered(corners, xs, ys, 8)
        if not inside.any() or not np.isfinite(errors.bounds[triangle]):
            continue
        exact = exact_positions(scene, triangle)[inside]
        farthest = np.abs(exact).max() if scene.camera.projection == "perspective" else 1.0
        by_rays = window_error(scene) * pixel * errors.in_window[triangle] * farthest
        by_corners = moved * errors.in_space[triangle]
        allowed = errors.bounds[triangle] + 2 * (by_rays + by_corners) * in_plane(scene, triangle)
        off = np.abs(drawn_positions(scene, triangle, xs, ys)[inside] - exact).max()
        used.append(off / allowed)
    assert 1e-3 < max(used) < 1


@PROJECTIONS
def test_a_triangle_seen_edge_on_has_no_bound_and_one_across_the_view_a_small_one(projection: dict[str, Any]) -> None:
    camera = {"position": (0.0, 0.0, 5.0), "look_at": (0.0, 0.0, 0.0), "width": 24, "height": 18} | projection
    across = {"shape": "triangle", "vertices": ((-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (0.0, 1.0, 0.0)), "material": "m"}
    edge_on = {"shape": "triangle", "vertices": ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)), "material": "m"}
    scene = build(objects=[across, edge_on], camera=camera)
    errors = position_errors(scene, view_volume(scene), SNAPPING)
    assert errors.bounds[0] < 1e-4
    assert 1 < errors.in_window[0] < 1.01
    assert 1 < errors.in_space[0] < 1.01
    assert errors.either_side.tolist() == [0, 1]
    assert np.isinf(errors.bounds[1])


@PROJECTIONS
@pytest.mark.parametrize("seed", range(8))
def test_snapping_turns_no_triangle_but_those_that_it_may(projection: dict[str, Any], seed: int) -> None:
    scene = triangle_scene(seed, projection)
    may_turn = position_errors(scene, view_volume(scene), SNAPPING).either_side
    window = window_corners(scene)[..., :2].astype(np.float64)
    snapped = np.rint(window * 256) / 256

    def area(corners: Any) -> Any:
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]

    assert (np.sign(area(window)) == np.sign(area(snapped)))[may_turn == 0].all()
    assert may_turn.mean() < 0.5


def test_a_coarser_grid_reaches_farther_beyond_an_edge() -> None:
    scene = triangle_scene(0, PERSPECTIVE)
    fine, coarse = (position_errors(scene, view_volume(scene), snapping) for snapping in (SNAPPING, 8 * SNAPPING))
    assert (coarse.in_window > fine.in_window).any()
    assert (coarse.bounds >= fine.bounds).all()
    assert (coarse.either_side >= fine.either_side).all()
