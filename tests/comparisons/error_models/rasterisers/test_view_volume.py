"""The planes hold what is seen, tightly; a cut polygon is what lies in the half-spaces."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.rasterisers.view_volume import (
    IN_PICTURE,
    MARGIN,
    ViewVolume,
    camera_axes,
    clipped,
    homogeneous_corners,
    is_inside,
    view_volume,
)
from raytruth.reference_tracer.rendering import first_hits, prepare, primary_rays
from tests.comparisons.drawn_triangles import ORTHOGRAPHIC, PERSPECTIVE, triangle_scene
from tests.scenes.exporter_scenes import FLOOR, build

pytestmark = pytest.mark.clause("VER-2")

PROJECTIONS = pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC], ids=["perspective", "orthographic"])


@PROJECTIONS
@pytest.mark.parametrize("seed", range(3))
def test_all_that_rays_meet_lies_between_near_and_far(projection: dict[str, Any], seed: int) -> None:
    scene = triangle_scene(seed, projection)
    distance, primitive = first_hits(prepare(scene))
    depth = (distance * (primary_rays(scene)[1] @ camera_axes(scene)[2]))[primitive >= 0]
    volume = view_volume(scene)
    assert volume.near < depth.min() <= depth.max() < volume.far


def test_the_planes_are_tight_around_a_surface_across_the_view() -> None:
    wall = {"shape": "triangle", "vertices": ((-9.0, -9.0, 0.0), (9.0, -9.0, 0.0), (0.0, 9.0, 0.0)), "material": "m"}
    camera = {"position": (0.0, 0.0, 4.0), "look_at": (0.0, 0.0, 0.0), "width": 8, "height": 8, **ORTHOGRAPHIC}
    volume = view_volume(build(objects=[wall], camera=camera))
    assert volume.near == pytest.approx(4 * (1 - MARGIN))
    assert volume.far == pytest.approx(4 * (1 + MARGIN))


def test_where_nothing_is_seen_the_planes_are_somewhere() -> None:
    behind = {"shape": "triangle", "vertices": ((0.0, 0.0, 9.0), (1.0, 0.0, 9.0), (0.0, 1.0, 9.0)), "material": "m"}
    assert view_volume(build(objects=[behind])) == ViewVolume(1.0, 2.0)


def test_a_polygon_is_cut_at_the_picture_and_kept_inside() -> None:
    (triangle,) = homogeneous_corners(build(objects=[FLOOR]))
    assert not is_inside(triangle[np.newaxis], IN_PICTURE).any()
    polygon = clipped(triangle, IN_PICTURE)
    assert len(polygon) >= 3
    assert (polygon @ IN_PICTURE.T > -1e-12).all()
    # Still in the triangle's plane.
    assert np.linalg.matrix_rank(np.concatenate([triangle, polygon]), tol=1e-9) == 3
    np.testing.assert_array_equal(clipped(polygon * [1, 1, 2, 1, 1], IN_PICTURE), polygon * [1, 1, 2, 1, 1])
    assert len(clipped(triangle * [1, 1, -1, -1, 1], IN_PICTURE)) == 0
