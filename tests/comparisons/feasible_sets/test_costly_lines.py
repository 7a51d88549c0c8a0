"""Which line of a declaration costs the power of a test."""

from __future__ import annotations

import numpy as np
import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.feasible_sets.costly_lines import costliest_line, without_each_line
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from tests.reference_tracer.small_scenes import library_scene

pytestmark = pytest.mark.clause("VER-4")


def told(scene_name: str, model: ErrorModel) -> str:
    scene = library_scene(scene_name)
    unjudged = np.argwhere(feasible_set(scene, model).outcomes == 0).tolist()
    assert unjudged
    return costliest_line(scene, model, [(column, row) for row, column in unjudged])


def test_too_few_bits_are_what_costs_the_power() -> None:
    reason = told("coloured-mirrors", ErrorModel("", 13))
    assert reason.startswith("what costs most is [arithmetic]: without it ")
    assert reason.endswith(" of these could be judged")


def test_a_surface_tested_as_all_others_is_what_costs_the_power() -> None:
    tested = RayOffset(minimum_distance=1e-6, excludes_surface=False)
    assert "own_surface" in told("coloured-mirrors", ErrorModel("", 24, tested))


def test_each_line_that_is_declared_is_left_out_once_and_what_is_not_declared_never() -> None:
    assert list(without_each_line(ErrorModel("", 53))) == []
    model = ErrorModel("", 24, RayOffset(absolute=1e-4, relative=1e-5), shadow_shortening=0.25)
    lines = dict(without_each_line(model))
    assert list(lines) == ["offset", "relative_offset", "shadow_shortening", "all of [rays]", "[arithmetic]"]
    assert lines["offset"].ray_offset == RayOffset(relative=1e-5)
    assert lines["shadow_shortening"].ray_offset == model.ray_offset
    assert lines["[arithmetic]"].precision_bits == 53
    assert all(left_out != model for left_out in lines.values())
