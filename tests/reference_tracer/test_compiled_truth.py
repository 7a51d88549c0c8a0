"""What compiled balls prove is what Arb proves, and what they leave open they say."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.camera_rays import CameraRays
from raytruth.reference_tracer.certification import Certifier
from raytruth.reference_tracer.compiled_truth import CompiledTruth, EnclosedRows, enclosures
from raytruth.scenes.families.drawn import drawn
from raytruth.scenes.library import library_names
from tests.reference_tracer.small_scenes import library_scene, small_scene, sphere

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("ARI-5", "ARI-11", "ARI-12")


def compiled(scene: Scene, camera_rays: CameraRays | None = None) -> tuple[Certifier, EnclosedRows]:
    certifier = Certifier(scene, camera_rays) if camera_rays else Certifier(scene)
    return certifier, CompiledTruth(scene, certifier.frame()).rows(0, scene.camera.height)


def assert_as_arb(certifier: Certifier, rows: EnclosedRows) -> None:
    """Both enclosures hold the truth, so they touch; and both are as narrow as the rounding to float64 lets them be."""
    for row, column in np.argwhere(rows.decided).tolist():
        pixel = certifier.pixel(column, row)
        for channel in range(3):
            middle, radius = rows.middle[row, column, channel], rows.radius[row, column, channel]
            assert middle == pixel.middle[channel]
            assert radius == pytest.approx(pixel.radius[channel], rel=2.0**-10, abs=1e-25)


@pytest.mark.parametrize("name", library_names())
def test_each_scene_of_the_library_has_the_same_truth(name: str) -> None:
    certifier, rows = compiled(library_scene(name, 6, 4))
    assert_as_arb(certifier, rows)
    assert rows.decided.mean() > (0.5 if name == "coincident-spheres" else 0.999)


@pytest.mark.parametrize("seed", range(8))
def test_drawn_scenes_have_the_same_truth(seed: int) -> None:
    certifier, rows = compiled(drawn(10.0 ** (seed - 4), seed).resized(6, 4))
    assert_as_arb(certifier, rows)
    assert rows.decided.mean() > 0.9


def test_rays_through_other_points_of_pixels_have_the_same_truth() -> None:
    certifier, rows = compiled(library_scene("glass-sphere", 6, 4), CameraRays(0.0, 0.0, edge_to_edge=True))
    assert_as_arb(certifier, rows)
    _, centres = compiled(library_scene("glass-sphere", 6, 4))
    assert (rows.middle != centres.middle).any()


def test_a_tie_is_left_open() -> None:
    touching = small_scene(
        projection="perspective",
        extent=60.0,
        width=3,
        height=3,
        camera={"position": (0.0, 1.0, 2.0)},
        materials={"a": {"emission": {"radiance": (1.0, 0.5, 0.25)}}},
        objects=[sphere("a", (1.0, 0.0, 0.0))],
    )
    _, rows = compiled(touching)
    assert not rows.decided[1, 1]
    assert rows.decided.sum() == 8


def test_rows_are_those_that_are_asked_for() -> None:
    scene = library_scene("whitted-1980", 6, 5)
    certifier, whole = compiled(scene)
    part = CompiledTruth(scene, certifier.frame()).rows(2, 4)
    np.testing.assert_array_equal(part.middle, whole.middle[2:4])
    np.testing.assert_array_equal(part.radius, whole.radius[2:4])
    np.testing.assert_array_equal(part.decided, whole.decided[2:4])


@given(st.floats(-1e300, 1e300), st.floats(-1e10, 1e10), st.floats(0.0, 1e10))
def test_an_enclosure_holds_the_ball(high: float, low: float, radius: float) -> None:
    middle, found = enclosures(np.array([high, low, radius]))
    assert middle == high
    assert math.fsum([abs(low), radius, -float(found)]) <= 0.0
    assert low != 0.0 or found == radius
