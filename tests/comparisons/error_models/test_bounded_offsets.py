"""Renderers that move the start of some rays only: their starts lie in the box, and only near edges it counts."""

from __future__ import annotations

import math
import random
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.bounded_offsets import (
    bounded_offset_behaviour,
    departure_within_bound,
    is_shadowed_from_within_bound,
)
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.ray_offsets import offset_behaviour
from raytruth.comparisons.renderers.cycles.adapter import Cycles
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import merged
from raytruth.reference_tracer.source.scene_data import TRIANGLE_A, TRIANGLE_B, TRIANGLE_C, TRIANGLE_MATERIAL
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import kept_precision, put_in_force, scene_data

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

OFFSET = 2.0**-10


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def kernel_of(model: ErrorModel, decisions: Decisions) -> Any:
    behaviour = merged(HELPERS, offset_behaviour(model), bounded_offset_behaviour(model))
    arithmetic = put_in_force(rounded_ball_arithmetic(model.precision_bits, decisions))
    return make_kernel(arithmetic, set(Feature) - {Feature.BOUNDING_VOLUMES}, behaviour)


def balls(vector: Any) -> Any:
    return tuple(arb(float(part)) for part in vector)


def moved_by_units_in_the_last_place(point: Any, normal: Any) -> Any:
    """What Cycles does to a float32 point (ray_offset): whole units away from 0 or toward it, or a bit if near 0."""
    moved = []
    for p, n in zip(point, normal, strict=True):
        if abs(p) < 1 / 32:
            moved.append(np.float32(p + np.float32(n / 65536)))
            continue
        steps = math.trunc(256 * float(n)) * (1 if p > 0 else -1)
        moved.append(np.array(p.view(np.int32) + np.int32(steps), dtype=np.int32).view(np.float32))
    return moved


def test_the_box_of_starts_holds_where_cycles_moves_a_ray_to_whichever_side_the_ray_goes_to() -> None:
    kernel = kernel_of(Cycles.error_model, Decisions())
    numbers = random.Random(8)
    for _ in range(300):
        scale = 2.0 ** numbers.randint(-12, 20)
        point = np.array([scale * numbers.uniform(-1, 1) * numbers.choice((1, 1e-4)) for _ in range(3)], np.float32)
        normal = np.array([numbers.uniform(-1, 1) for _ in range(3)])
        normal = (normal / np.linalg.norm(normal)).astype(np.float32)
        moved = moved_by_units_in_the_last_place(point, normal)
        for side in (1, -1):
            start, left = kernel.departure(3, balls(point), balls(side * normal), balls((1, 0, 0)))
            assert left == 3
            for ball, value, unmoved in zip(start, moved, point, strict=True):
                assert ball.contains(arb(float(value)))
                assert ball.contains(arb(float(unmoved)))


# A floor, and a roof over it that rises from its edge at y = 0 half as steeply as the light's rays.
CORNERS = {
    TRIANGLE_A: [(-8.0, 0.0, 0.0), (-8.0, 0.0, 0.0)],
    TRIANGLE_B: [(8.0, 0.0, 0.0), (8.0, 0.0, 0.0)],
    TRIANGLE_C: [(0.0, 8.0, 0.0), (0.0, 4.0, 8.0)],
}
FLOOR_AND_ROOF = scene_data(
    {**{table: [balls(corner) for corner in corners] for table, corners in CORNERS.items()}, TRIANGLE_MATERIAL: [0, 0]}
)
BOUND = ErrorModel("", 23, RayOffset(absolute=OFFSET, is_bound=True))


@pytest.mark.parametrize(("y", "outcomes"), [(0.5, {True}), (OFFSET / 4, {True}), (2.0**-24, {False, True})])
def test_only_at_an_edge_a_neighbour_may_shadow_or_not(y: float, outcomes: set[bool]) -> None:
    """Moved by the whole offset, all but the first would start above the roof; but the second stays on its floor."""
    decisions = Decisions()
    kernel = kernel_of(BOUND, decisions)
    found = every_outcome(
        lambda: kernel.is_shadowed(
            FLOOR_AND_ROOF, 0, balls((0.5, y, 0.0)), balls((0, 0, 1)), balls((0.0, 1.0, 4.0)), True
        ),
        decisions,
        16,
    )
    assert set(found) == outcomes


def test_a_bound_is_told_in_words_and_overrides_where_rays_start() -> None:
    offset = RayOffset(absolute=0.25, is_bound=True)
    assert offset.in_words() == "up to 0.25 along the normal, to either side; the surface cannot be hit again there"
    model = ErrorModel("", 24, offset)
    functions = merged(offset_behaviour(model), bounded_offset_behaviour(model)).functions
    assert functions == {"departure": departure_within_bound, "is_shadowed": is_shadowed_from_within_bound}
    assert bounded_offset_behaviour(ErrorModel("", 24, RayOffset(absolute=0.25))).names == ()


@pytest.mark.clause("VER-1")
def test_a_bound_of_nothing_or_on_a_surface_that_is_tested_is_refused() -> None:
    with pytest.raises(ValueError, match="bound on an offset"):
        RayOffset(is_bound=True)
    with pytest.raises(ValueError, match="bound on an offset"):
        RayOffset(absolute=OFFSET, excludes_surface=False, is_bound=True)
