from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.records.renderings import Rays
from raytruth.comparisons.renderers.own_tracer import ReferenceTracer
from raytruth.reference_tracer.explanation import explain
from raytruth.reference_tracer.rendering import primary_rays, render
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rendering
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-4")

SCENE = "facing-mirrors-depth-2"  # one for both tests, since each scene takes seconds to compile


def small(name: str) -> Scene:
    scene = open_scene(name)
    return scene.resized(12, 9)


def rendered(scene: Scene, depth: int, folder: Path) -> Rendering:
    return ReferenceTracer().render(scene, "whitted", depth, Rays(*primary_rays(scene)), folder)


def test_the_image_is_the_tracers_at_the_depth_asked_for(tmp_path: Path) -> None:
    scene = small(SCENE)
    for depth in (1, 2):
        image = rendered(scene, depth, tmp_path).image
        expected = render(scene.model_copy(update={"max_depth": depth})).astype(np.float32)
        np.testing.assert_array_equal(image, expected)
    assert (tmp_path / "log.txt").read_text().startswith("raytruth ")


def test_first_hits_agree_with_the_explanation_of_each_pixel(tmp_path: Path) -> None:
    scene = small(SCENE)
    hits = rendered(scene, 0, tmp_path).first_hits
    assert hits is not None
    assert hits.primitive.max() > 0
    for row, column in ((0, 0), (4, 6), (7, 3), (8, 11)):
        hit = explain(scene, column, row).rays[0].hit
        if hit is None:
            assert hits.primitive[row, column] == -1
            assert np.isinf(hits.depth[row, column])
            assert np.isnan(hits.position[row, column]).all()
            continue
        assert hits.primitive[row, column] == hit.primitive
        # Compiled and interpreted code round alike up to the last place.
        assert hits.depth[row, column] == pytest.approx(hit.distance, rel=4 * np.finfo(float).eps)
        outward = np.array(hit.normal) * (1 if hit.entering else -1)
        assert np.abs(hits.normal[row, column] - outward).max() <= 2**-48  # a few roundoffs of unit vectors


def test_it_refuses_nothing_and_is_never_stochastic() -> None:
    for name in ("whitted-1980", "tinted-glass", "trefoil-knot"):
        scene = open_scene(name)
        assert ReferenceTracer().refuses(scene) is None
        assert not ReferenceTracer().is_stochastic(scene, "whitted")
