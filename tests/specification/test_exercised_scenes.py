from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.records.kill_results import KILLS_FILE, FaultResult, KillResults
from raytruth.scenes.library import library_names
from raytruth.specification.exercised_scenes import scenes_by_fault, scenes_by_function

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("PRJ-6")


def test_a_function_stands_beside_the_scenes_that_need_it() -> None:
    scenes = scenes_by_function()
    assert scenes[None] == scenes["camera_frame"] == library_names()
    assert "glass-slab" in scenes["fresnel_reflectance"]
    assert "ambient-sphere" not in scenes["fresnel_reflectance"]
    assert scenes["blinn"] == tuple(name for name in library_names() if name in scenes["blinn"])


def test_a_fault_stands_beside_the_scenes_that_killed_it(tmp_path: Path) -> None:
    assert scenes_by_fault(tmp_path) == {}
    known = {"words": "", "margins": {}, "errors": {}, "gates": (), "clause": "A-1", "hint": "", "margin": None}
    fault = FaultResult.model_validate({"name": "one", "killed": True, "killed_by": ("x", "y"), **known})
    results = KillResults(faults=(fault,), variants=(), seconds=0.0, scenes={}, gates=(), quick=())
    (tmp_path / KILLS_FILE).write_text(results.model_dump_json(), encoding="utf-8")
    assert scenes_by_fault(tmp_path) == {"one": ("x", "y")}
