from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.faults.variants import all_variants
from raytruth.comparisons.kills import kill_run
from raytruth.comparisons.kills.kill_matrix import KillCell, SceneKills
from raytruth.comparisons.matrix.quick_suite import small
from raytruth.scenes.library import open_scene
from tests.raytruth.running import refusal, run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-1", "CMD-2", "CMD-4")


def keep(out: Path, *, survivor: str = "", flagged: str = "") -> None:
    """As if a run had judged one scene."""
    cells = [KillCell(name, 0.0 if name == survivor else 9.0) for name in all_faults()]
    cells += [KillCell(name, 9.0 if name == flagged else 0.0) for name in all_variants()]
    kill_run._keep(out, open_scene("ambient-sphere"), SceneKills("ambient-sphere", tuple(cells), 1.0))


def test_all_is_well_where_every_fault_is_killed_and_no_variant_flagged(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    keep(tmp_path)
    status, out, _ = run(capsys, "faults", "ambient-sphere", "--out", str(tmp_path), "--json")
    document = json.loads(out)
    assert status == 0
    assert all(fault["killed"] for fault in document["faults"])
    assert document["quick"] == ["ambient-sphere"]
    assert (tmp_path / "faults.html").exists()


def test_a_survivor_or_a_false_alarm_makes_the_command_fail(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    survivor, flagged = next(iter(all_faults())), next(iter(all_variants()))
    keep(tmp_path, survivor=survivor)
    status, out, _ = run(capsys, "faults", "ambient-sphere", "--out", str(tmp_path))
    assert status == 1
    assert f"{survivor}: 0 of 1 scenes" in out
    keep(tmp_path, flagged=flagged)
    status, out, _ = run(capsys, "faults", "ambient-sphere", "--out", str(tmp_path))
    assert status == 1
    assert f"variant {flagged}: on ambient-sphere" in out


def test_bad_usage_is_refused_in_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "expected 1 or more" in refusal(capsys, "faults", "--jobs", "0", "--out", str(tmp_path))
    assert "no-such-scene" in refusal(capsys, "faults", "no-such-scene", "--out", str(tmp_path))
    assert "--quick" in refusal(capsys, "run", "single-sphere", "--quick", "--out", str(tmp_path))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.clause("GRD-10")
def test_a_scene_is_scored_and_entered_into_a_board_unless_it_flags_what_is_right(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    board = tmp_path / "board.json"
    options = ("faults", "--scene", "ambient-sphere", "--out", str(tmp_path), "--leaderboard", str(board))
    survivor, flagged = next(iter(all_faults())), next(iter(all_variants()))
    keep(tmp_path, survivor=survivor, flagged=flagged)
    status, out, _ = run(capsys, *options, "--by", "Ada")
    assert status == 1
    assert f"has no place on a board: {flagged}" in out
    assert not board.exists()
    keep(tmp_path, survivor=survivor)
    status, out, _ = run(capsys, *options, "--by", "Ada")
    assert status == 0
    pixels = small(open_scene("ambient-sphere")).camera
    count = len(all_faults())
    worth = f"{count - 1} of {count} faults with {pixels.width * pixels.height} pixels"
    assert f"ambient-sphere finds {worth}." in out
    assert f"1. Ada: {worth}" in out
    keep(tmp_path)
    status, out, _ = run(capsys, *options, "--json")
    document = json.loads(out)
    assert (document["killed"], document["missed"]) == (count, [])
    assert [it["name"] for it in document["leaderboard"]] == ["ambient-sphere", "Ada"]
    assert not (tmp_path / "faults.json").exists()


@pytest.mark.clause("CMD-2")
def test_what_does_not_go_with_a_scene_to_score_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "board.json").write_text("[]")
    out = ("--out", str(tmp_path))
    assert "expected --scene FILE" in refusal(capsys, "faults", "--by", "Ada", *out)
    assert "no other scenes" in refusal(capsys, "faults", "two-lights", "--scene", "ambient-sphere", *out)
    board = ("--leaderboard", str(tmp_path / "board.json"))
    assert "expected a leaderboard" in refusal(capsys, "faults", "--scene", "ambient-sphere", *board, *out)
    assert "--by: expected a name" in refusal(capsys, "faults", "--scene", "ambient-sphere", "--by", "", *out)
