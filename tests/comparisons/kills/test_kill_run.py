from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.faults.variants import all_variants
from raytruth.comparisons.kills import kill_run
from raytruth.comparisons.kills.kill_matrix import KillCell, SceneKills
from raytruth.comparisons.kills.kill_run import kill_results, run_kills, write_kill_results
from raytruth.comparisons.records.kill_results import read_kill_results
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("VER-12", "RES-3")

FAULT, OTHER = list(all_faults())[:2]
VARIANT = next(iter(all_variants()))
KILLS = [
    SceneKills("two", (KillCell(FAULT, 0.5), KillCell(VARIANT, 1.5)), 1.0),
    SceneKills("one", (KillCell(FAULT, np.inf, "it raised", ("mean ±2.5 %",)),), 3.0),
]


def test_scenes_are_put_together_by_subject() -> None:
    results = kill_results(KILLS, 7.0)
    fault = next(fault for fault in results.faults if fault.name == FAULT)
    assert (fault.killed, fault.killed_by, fault.margin) == (True, ("one",), None)
    assert fault.margins == {"one": None, "two": 0.5}
    assert fault.errors == {"one": "it raised"}
    assert fault.gates == ("mean ±2.5 %",)
    assert fault.clause == all_faults()[FAULT].clause
    assert OTHER in results.survivors
    assert results.false_alarms == [VARIANT]
    assert results.quick == ("one",)
    assert results.scenes == {"one": 3.0, "two": 1.0}


def test_results_are_written_and_read_again(tmp_path: Path) -> None:
    results = kill_results(KILLS, 7.0)
    write_kill_results(tmp_path, results)
    assert read_kill_results(tmp_path) == results
    assert [path.name for path in tmp_path.iterdir()] == ["faults.json"]
    document = json.loads((tmp_path / "faults.json").read_text(encoding="utf-8"))
    assert {"name", "clause", "killed", "killed_by", "margin"} <= document["faults"][0].keys()
    assert {"name", "flagged"} <= document["variants"][0].keys()


def test_a_scene_is_taken_over_until_something_changes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kills = SceneKills("ambient-sphere", KILLS[1].cells, 3.0)
    scene = open_scene("ambient-sphere")
    kill_run._keep(tmp_path, scene, kills)
    assert list(run_kills([scene], tmp_path, 1, fresh=False)) == [kills]
    assert kill_run._kept(tmp_path, open_scene("single-sphere")) is None
    monkeypatch.setattr(kill_run, "source_digest", lambda *_: "other code")
    assert kill_run._kept(tmp_path, scene) is None
    (tmp_path / "kills" / "ambient-sphere.json").write_text("{", encoding="utf-8")
    assert kill_run._kept(tmp_path, scene) is None
