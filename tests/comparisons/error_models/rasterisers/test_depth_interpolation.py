"""Float32's depths are off by no more than the bounds say, and the bounds are not idle."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.rasterisers.depth_interpolation import depth_errors
from raytruth.comparisons.error_models.rasterisers.drawn_pieces import movement_in_space, window_error
from raytruth.comparisons.error_models.rasterisers.view_volume import half_extent, view_volume
from tests.comparisons.drawn_triangles import (
    ORTHOGRAPHIC,
    PERSPECTIVE,
    covered,
    depth_plane,
    exact_corners,
    triangle_scene,
    window_corners,
)
from tests.scenes.exporter_scenes import build

pytestmark = pytest.mark.clause("VER-2")

SNAPPING = 2.0**-9
PROJECTIONS = pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC], ids=["perspective", "orthographic"])


@PROJECTIONS
@pytest.mark.parametrize("seed", range(8))
def test_float32_depths_are_off_by_no_more_than_the_bound(projection: dict[str, Any], seed: int) -> None:
    scene = triangle_scene(seed, projection)
    size = (scene.camera.width, scene.camera.height)
    xs, ys = np.meshgrid(*(np.arange(side, dtype=np.float32) for side in size))
    errors = depth_errors(scene, view_volume(scene), SNAPPING)
    moved = movement_in_space(scene, view_volume(scene))
    used = []
    for rounded, exact, bound, beyond in zip(
        window_corners(scene), exact_corners(scene), errors.bounds, errors.beyond, strict=True
    ):
        inside = covered(rounded, xs, ys, 8)
        if not inside.any() or not np.isfinite(bound):
            continue
        plane = np.linalg.solve(np.column_stack([exact[:, :2], np.ones(3)]), exact[:, 2])
        truth = plane[0] * (xs + 0.5) + plane[1] * (ys + 0.5) + plane[2]
        # What corners move across the image changes the depth, too, by the slope; it is counted as a movement in space.
        pixels = window_error(scene) + moved * 3 * scene.camera.height / (2 * half_extent(scene)[1])
        allowed = bound + np.abs(plane[:2]).sum() * pixels * beyond
        used.append(np.abs(depth_plane(rounded, xs, ys) - truth)[inside].max() / allowed)
    assert 1e-4 < max(used) < 1


@PROJECTIONS
def test_a_triangle_seen_edge_on_has_no_bound_and_one_across_the_view_a_small_one(projection: dict[str, Any]) -> None:
    camera = {"position": (0.0, 0.0, 5.0), "look_at": (0.0, 0.0, 0.0), "width": 24, "height": 18} | projection
    across = {"shape": "triangle", "vertices": ((-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (0.0, 1.0, 0.0)), "material": "m"}
    edge_on = {"shape": "triangle", "vertices": ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)), "material": "m"}
    scene = build(objects=[across, edge_on], camera=camera)
    errors = depth_errors(scene, view_volume(scene), SNAPPING)
    assert errors.bounds[0] < 1e-5
    assert 1 < errors.beyond[0] < 1.01
    assert np.isinf(errors.bounds[1])


def test_a_coarser_grid_reaches_farther_beyond_an_edge() -> None:
    scene = triangle_scene(0, PERSPECTIVE)
    fine, coarse = (depth_errors(scene, view_volume(scene), snapping) for snapping in (SNAPPING, 8 * SNAPPING))
    assert (coarse.beyond > fine.beyond).any()
    assert (coarse.bounds >= fine.bounds).all()
