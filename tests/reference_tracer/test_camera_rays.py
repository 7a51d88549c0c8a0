"""Rays through other points of the pixels than their centres."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import ctx

from raytruth.comparisons.error_models.departures import NONE
from raytruth.comparisons.records.results import Verdict
from raytruth.reference_tracer.arithmetics.balls import Decisions, ball_arithmetic
from raytruth.reference_tracer.camera_rays import CENTRES, CameraRays
from raytruth.reference_tracer.certified_image import certified_image, truth_key
from raytruth.reference_tracer.rendering import prepare, primary_rays
from tests.comparisons.departing_tracers import image_of, judged, model_of
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-16", "CAM-2")

POINTS = [
    CameraRays(x, y, edges) for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5)) for edges in (False, True)
]
BITS = 128


@cache
def scene_of(projection: str) -> Scene:
    name = "perspective-projection" if projection == "perspective" else "parallel-projection"
    return library_scene(name, 5, 4)


def ray_through(scene: Scene, rays: CameraRays, x: float, y: float) -> list[Any]:
    """In balls that hold the very ray."""
    with ctx.workprec(BITS):
        prepared = prepare(scene, ball_arithmetic(BITS, Decisions()), rays.behaviour())
        frame = prepared.kernel.camera_frame(prepared.data)
        number = prepared.arithmetic.number
        return [part for vector in prepared.kernel.primary_ray(frame, number(x), number(y)) for part in vector]


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("rays", POINTS, ids=CameraRays.in_words)
def test_the_ray_of_a_pixel_is_the_one_through_the_declared_point(rays: CameraRays, projection: str) -> None:
    scene = scene_of(projection)
    for column, row in ((0, 0), (4, 3), (2, 1)):
        # 5/4 and 4/3: what an image of 5 by 4 pixels is stretched by, edge to edge; a third is no float.
        stretched = (5 / 4, 4 / 3) if rays.edge_to_edge else (1.0, 1.0)
        point = ((column + rays.x) * stretched[0], (row + rays.y) * stretched[1])
        found = ray_through(scene, rays, column + 0.5, row + 0.5)
        expected = ray_through(scene, CENTRES, *point)
        for one, other in zip(found, expected, strict=True):
            # A third is off by 2^-54 of itself; the ray moves by no more than that times the image's size.
            assert abs(one - other) < 2.0**-50


def test_edge_to_edge_the_outermost_rays_go_through_the_corners_of_the_image() -> None:
    scene = scene_of("perspective")
    rays = CameraRays(0.0, 0.0, edge_to_edge=True)
    for column, row, corner in ((0, 0, (0.0, 0.0)), (4, 3, (5.0, 4.0))):
        pairs = zip(
            ray_through(scene, rays, column + 0.5, row + 0.5), ray_through(scene, CENTRES, *corner), strict=True
        )
        assert all(one.overlaps(other) for one, other in pairs)


def test_truth_and_rays_of_other_points_are_their_own() -> None:
    scene = library_scene("single-sphere")
    corners = CameraRays(0.0, 0.0)
    assert truth_key(scene, corners) != truth_key(scene) == truth_key(scene, CENTRES)
    assert (certified_image(scene, corners).middle != certified_image(scene).middle).any()
    assert (primary_rays(scene, corners)[1] != primary_rays(scene)[1]).any()


@pytest.mark.parametrize("numbers", ["float64", "float32"])
@pytest.mark.parametrize("rays", [rays for rays in POINTS if rays != CENTRES], ids=CameraRays.in_words)
def test_a_right_tracer_with_such_rays_passes_by_its_convention_and_fails_without(
    rays: CameraRays, numbers: str
) -> None:
    scene = library_scene("sphere-over-floor")
    image = image_of(scene, model_of(NONE, numbers, camera_rays=rays), numbers)
    assert np.isfinite(image).all()
    verdict, reason = judged(image, scene, model_of(NONE, numbers, camera_rays=rays))
    assert verdict == Verdict.PASS, reason
    assert judged(image, scene, model_of(NONE, numbers))[0] == Verdict.FAIL
