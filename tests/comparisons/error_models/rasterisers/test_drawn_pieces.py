"""Float32's corners are off by no more than the bounds say; pieces of cut triangles are what is left of these."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.rasterisers.drawn_pieces import (
    CLIPPING_ROUNDOFFS,
    LARGEST_SHAPE,
    ROUNDOFF,
    TRANSFORM_ROUNDOFFS,
    DrawnPieces,
    cut_triangles,
    movement_in_space,
    of_each_triangle,
    window_error,
)
from raytruth.comparisons.error_models.rasterisers.view_volume import half_extent, homogeneous_corners, view_volume
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

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.rasterisers.view_volume import Array

pytestmark = pytest.mark.clause("VER-2")

PROJECTIONS = pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC], ids=["perspective", "orthographic"])
CAMERA = {"position": (0.0, 0.0, 5.0), "look_at": (0.0, 0.0, 0.0), "width": 24, "height": 18}
WHOLE = ((-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (0.0, 1.0, 0.0))
# Far out of the guard band.
WIDE = ((-90.0, -1.0, -1.0), (90.0, -1.0, -1.0), (0.0, 1.0, -1.0))
BESIDE = ((-90.0, -1.0, -1.0), (-80.0, -1.0, -1.0), (-85.0, 1.0, -1.0))


def scene_of(*triangles: Any, projection: dict[str, Any] = PERSPECTIVE) -> Any:
    objects = [{"shape": "triangle", "vertices": vertices, "material": "m"} for vertices in triangles]
    return build(objects=objects, camera=CAMERA | projection)


@PROJECTIONS
@pytest.mark.parametrize("seed", range(8))
def test_float32_corners_move_no_more_than_the_bound(projection: dict[str, Any], seed: int) -> None:
    scene = triangle_scene(seed, projection)
    moved = np.abs(window_corners(scene) - exact_corners(scene))[..., :2].max()
    corners = homogeneous_corners(scene)
    in_image = scene.camera.height / (2 * half_extent(scene)[1]) / corners[..., 2].min() * 3
    bound = window_error(scene) + movement_in_space(scene, view_volume(scene)) * in_image
    assert bound / 1000 < moved < bound


@PROJECTIONS
def test_a_cut_triangle_is_drawn_in_pieces_and_one_outside_not_at_all(projection: dict[str, Any]) -> None:
    scene = scene_of(WHOLE, WIDE, BESIDE, projection=projection)
    volume = view_volume(scene)
    assert cut_triangles(homogeneous_corners(scene), volume).tolist() == [False, True, True]
    seen: list[tuple[int, int]] = []

    def largest(pieces: DrawnPieces, roundoffs: int) -> Array:
        seen.append((len(pieces.corners), roundoffs))
        return pieces.extent.max(axis=1)[np.newaxis]

    (extents,) = of_each_triangle(scene, volume, largest, [-1.0])
    # Cut at both sides it has five corners, and so five fans of three triangles.
    assert seen == [(1, TRANSFORM_ROUNDOFFS), (15, CLIPPING_ROUNDOFFS)]
    assert 0 < extents[0] < CAMERA["width"]
    assert extents[1] == pytest.approx(2 * CAMERA["width"], rel=1e-3)  # of the guard band
    assert extents[2] == -1


@PROJECTIONS
@pytest.mark.parametrize("seed", range(8))
def test_what_is_interpolated_is_off_by_no_more_than_the_bound(projection: dict[str, Any], seed: int) -> None:
    """Of corners that are exact: those that float32 has made, and values of theirs."""
    scene = triangle_scene(seed, projection)
    corners, window = homogeneous_corners(scene), window_corners(scene)
    pieces = DrawnPieces.of(corners, scene, movement_in_space(scene, view_volume(scene)))
    values = np.random.default_rng(seed).uniform(-3, 3, (len(corners), 3)).astype(np.float32)
    beyond = pieces.beyond(2.0**-9)
    bounds = pieces.plane_error(values.astype(np.float64), beyond)
    xs, ys = np.meshgrid(*(np.arange(side, dtype=np.float32) for side in (scene.camera.width, scene.camera.height)))
    used = []
    for triangle in np.flatnonzero(pieces.is_bounded):
        rounded = np.column_stack([window[triangle][:, :2], values[triangle]])
        inside = covered(rounded, xs, ys, 8)
        if inside.any():
            exact = rounded.astype(np.float64)
            plane = np.linalg.solve(np.column_stack([exact[:, :2], np.ones(3)]), exact[:, 2])
            truth = plane[0] * (xs + 0.5) + plane[1] * (ys + 0.5) + plane[2]
            used.append(np.abs(depth_plane(rounded, xs, ys) - truth)[inside].max() / bounds[triangle])
    assert 1e-3 < max(used) < 1


def test_a_triangle_seen_edge_on_has_no_bound() -> None:
    edge_on = ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0))
    scene = scene_of(WHOLE, edge_on)
    pieces = DrawnPieces.of(homogeneous_corners(scene), scene, movement_in_space(scene, view_volume(scene)))
    assert pieces.is_bounded.tolist() == [True, False]
    assert 2 <= pieces.shape[0] < 3 < LARGEST_SHAPE
    assert 1 < pieces.beyond(2.0**-9)[0] < 1.01
    assert pieces.double_area[1] <= 0
    assert (pieces.moved > ROUNDOFF).all()
