"""Fields of view along other sides of the image, as programs are told them."""

from __future__ import annotations

from math import pi, radians, tan
from typing import Any, get_args

import numpy as np
import pytest
from flint import arb
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.error_models.departures import NONE
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.handed_cameras import FieldOfView, handed_camera
from raytruth.comparisons.records.results import Verdict
from raytruth.reference_tracer.arithmetics.balls import Decisions, rounded_ball_arithmetic
from raytruth.reference_tracer.rendering import prepare
from raytruth.scenes.camera import PerspectiveCamera
from tests.comparisons.departing_tracers import image_of, judged, model_of
from tests.reference_tracer.small_scenes import library_scene, small_scene

pytestmark = pytest.mark.clause("VER-17", "CAM-3")

# An angle of 2^-10 degrees or within that of 180 is no picture any more.
ANGLES = st.floats(2.0**-10, 180 - 2.0**-10)
# Products, tangents and arcs round four times each way, by 2^-53 each.
ROUNDINGS = 2.0**-50


def camera_of(angle: float, width: int, height: int) -> PerspectiveCamera:
    camera = small_scene(projection="perspective", width=width, height=height, extent=angle).camera
    assert isinstance(camera, PerspectiveCamera)
    return camera


@given(ANGLES, st.integers(1, 100), st.integers(1, 100))
def test_the_angle_told_shows_as_much_along_its_side(angle: float, width: int, height: int) -> None:
    camera = camera_of(angle, width, height)
    told = handed_camera("horizontal", camera)
    assert isinstance(told, PerspectiveCamera)
    half_width, half_height = (tan(radians(it.vertical_field_of_view) / 2) for it in (told, camera))
    # Near 180 degrees a tangent magnifies what its angle is off by.
    magnified = 1 + 180 / (180 - max(angle, told.vertical_field_of_view))
    assert half_width * height == pytest.approx(half_height * width, rel=ROUNDINGS * magnified)


@given(ANGLES, st.integers(1, 100), st.integers(1, 100))
def test_the_larger_and_the_smaller_side_are_one_of_both(angle: float, width: int, height: int) -> None:
    camera = camera_of(angle, width, height)
    larger, smaller = handed_camera("larger side", camera), handed_camera("smaller side", camera)
    horizontal = handed_camera("horizontal", camera)
    assert larger == (horizontal if width > height else camera)
    assert smaller == (horizontal if width < height else camera)
    assert handed_camera("vertical", camera) == camera


def test_parallel_rays_have_no_angle() -> None:
    camera = small_scene(width=6, height=4).camera
    for field_of_view in get_args(FieldOfView):
        assert handed_camera(field_of_view, camera) is camera


def frame_by_height(angle: float, field_of_view: FieldOfView) -> Any:
    """One pixel to the right, in balls of float32, of a camera 16 times as wide as it is high."""
    camera = {"width": 16, "height": 1}
    scene = small_scene(projection="perspective", extent=angle, **camera)
    model = ErrorModel("", 24, field_of_view=field_of_view)
    arithmetic = rounded_ball_arithmetic(24, Decisions())
    with arithmetic.in_force():
        prepared = prepare(scene, arithmetic, behaviour_of(model, scene))
        return prepared.kernel.camera_frame(prepared.data)[2][0]


def test_what_rounding_does_is_found_from_the_angle_told() -> None:
    """Near 180 degrees a tangent magnifies what float32 makes of the angle of the width, more than of the height."""
    outside = 0
    for step in range(64):
        angle = 146.0 + step / 8
        told = handed_camera("horizontal", camera_of(angle, 16, 1))
        assert isinstance(told, PerspectiveCamera)
        half = np.float32(told.vertical_field_of_view) * np.float32(pi) / np.float32(360)
        pixel = arb(float(np.float32(2) * np.tan(half) / np.float32(16)))
        assert frame_by_height(angle, "horizontal").contains(pixel)
        outside += not frame_by_height(angle, "vertical").contains(pixel)
    assert outside


@pytest.mark.parametrize("numbers", ["float64", "float32"])
def test_a_tracer_that_takes_the_angle_told_for_that_of_the_width_passes(numbers: str) -> None:
    scene = library_scene("sphere-over-floor")
    image = image_of(scene, model_of(NONE, numbers, field_of_view="horizontal"), numbers)
    verdict, reason = judged(image, scene, model_of(NONE, numbers, field_of_view="horizontal"))
    assert verdict == Verdict.PASS, reason
