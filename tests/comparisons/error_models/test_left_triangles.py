"""Whether a ray may meet the triangle again that it has left, from its offset."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.left_triangles import left_triangle_behaviour
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.ray_offsets import offset_behaviour
from raytruth.comparisons.error_models.shortcuts import without_shortcuts
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import merged
from raytruth.reference_tracer.source.scene_data import TRIANGLE_A, TRIANGLE_B, TRIANGLE_C
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import kept_precision, put_in_force, scene_data

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

OFFSET = RayOffset(1500 * 2.0**-24, 1500 * 2.0**-24)
MODEL = ErrorModel("", 24, OFFSET, triangle_test="moeller-trumbore", triangle_points="barycentric")


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


@pytest.mark.parametrize(
    ("extent", "slope", "may_meet_it"),
    [(5.0, 0.3, {False}), (1e3, 0.0, {False}), (2e4, 0.3, {True, False})],
)
def test_only_a_large_and_slanting_triangle_may_be_met_again(extent: float, slope: float, may_meet_it: Any) -> None:
    decisions = Decisions()
    behaviour = merged(HELPERS, offset_behaviour(MODEL), left_triangle_behaviour(MODEL))
    kernel = make_kernel(put_in_force(rounded_ball_arithmetic(24, decisions)), set(Feature), behaviour)
    places = ((-extent, extent), (extent, extent), (0.0, -extent))
    corners = [tuple(map(arb, (x, slope * x, z))) for x, z in places]
    data = scene_data({table: [c] for table, c in zip((TRIANGLE_A, TRIANGLE_B, TRIANGLE_C), corners, strict=True)})
    # As near to the plane as what rounding leaves of the offset lets it be.
    origin = (arb(0, 1e-4), arb(0, 1e-3 if extent > 1e3 else 1e-5) + OFFSET.absolute, arb(0, 1e-4))
    up = (arb(0), arb(1), arb(0))
    outcomes = every_outcome(lambda: kernel.distance_to_triangle(data, origin, up, 0, 0), decisions, 16)
    assert {float(distance.mid()) < math.inf for distance in outcomes} == may_meet_it


def test_only_who_takes_points_and_test_from_the_corners_is_given_it() -> None:
    assert set(left_triangle_behaviour(MODEL).functions) == {"distance_to_triangle"}
    bound = replace(MODEL, ray_offset=replace(OFFSET, is_bound=True))
    for other in (replace(MODEL, triangle_points="along the ray"), without_shortcuts(MODEL), bound):
        assert left_triangle_behaviour(other).names == ()
