from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.attacks import ladder
from raytruth.comparisons.grading.assignment_file import READY_FOLDER
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-1", "CMD-2", "GRD-7")

ASSIGNMENT = """
name = "one-sphere"
title = "One sphere"
models = [{ arithmetic = { precision = "float64", slack_bits = 14 } }]
stages = [{ id = "never", without = ["spheres"] }]

[[topics]]
id = "sphere"
title = "A sphere"
scenes = ["single-sphere"]
"""
# Writes black.
PROGRAM = """
import json, sys
camera = json.load(open(sys.argv[1]))["camera"]
width, height = camera["width"], camera["height"]
open(sys.argv[2], "wb").write(f"PF\\n{width} {height}\\n-1.0\\n".encode() + bytes(12 * width * height))
"""


@pytest.fixture
def command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[str, ...]:
    """The arguments that grade a program which writes black."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "one.toml").write_text(ASSIGNMENT)
    (tmp_path / "black.py").write_text(PROGRAM)
    return "--assignment", "one.toml", "--jobs", "1", "--", sys.executable, "black.py", "{scene}", "{output}.pfm"


def test_a_wrong_program_is_graded_and_all_files_are_written(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = ("--out", "graded", "--gradescope", "results.json", "--junit", "junit.xml")
    status, out, _ = run(capsys, "grade", *files, *command)
    assert status == 1
    assert out.startswith("One sphere: ")
    graded = json.loads((tmp_path / "graded" / "grade.json").read_text())
    assert list(graded["clauses"][0])[:4] == ["id", "title", "points", "maximum"]
    assert (graded["score"], graded["maximum"]) == (0, 100)
    assert {path.name for path in (tmp_path / "graded").iterdir()} == {"grade.json", "student.html", "teacher.html"}
    assert json.loads((tmp_path / "results.json").read_text())["score"] == graded["score"]
    assert b"<testsuites" in (tmp_path / "junit.xml").read_bytes()


def test_bad_usage_is_one_sentence(command: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert "expected a command after -- or --renderer-file FILE, found neither" in refusal(capsys, "grade")
    assert "expected 1 or more, found 0" in refusal(capsys, "grade", "--attempt", "0", *command)
    assert "has no stage 'nevr'" in refusal(capsys, "grade", "--stage", "nevr", *command)
    assert "nothing is due at the stage 'never'" in refusal(capsys, "grade", "--stage", "never", *command)
    assert "did you mean 'glass'" in refusal(capsys, "grade", "--assignment", "glas", *command[2:])


@pytest.mark.clause("GRD-1")
def test_one_starts_from_a_commented_assignment_and_the_schema_is_printed(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    del command
    status, out, _ = run(capsys, "grade", "--init", "mine.toml")
    assert status == 0
    assert "raytruth grade --assignment mine.toml" in out
    assert (tmp_path / "mine.toml").read_text() == (READY_FOLDER / "whitted.toml").read_text()
    assert "is there already" in refusal(capsys, "grade", "--init", "mine.toml")
    assert document(capsys, "grade", "--schema")["title"] == "raytruth assignment"


@pytest.mark.clause("SBX-5")
def test_the_sandbox_is_told_kept_in_the_grade_and_refused_where_there_is_none(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    _, _, err = run(capsys, "grade", "--out", "graded", *command)
    held = json.loads((tmp_path / "graded" / "grade.json").read_text())["sandbox"]
    assert f"The program runs in {'no sandbox' if held['rung'] == 'none' else 'the sandbox ' + held['rung']}" in err
    assert "<h2>Sandbox</h2>" in (tmp_path / "graded" / "teacher.html").read_text()
    assert "andbox" not in (tmp_path / "graded" / "student.html").read_text()
    monkeypatch.setattr(ladder, "missing_for", lambda rung: f"{rung} is switched off")
    monkeypatch.setattr(ladder, "_machine", lambda: "another")
    refused = refusal(capsys, "grade", "--sandbox", "landlock", *command)
    assert "--sandbox landlock: no sandbox works here" in refused
    assert "landlock is switched off" in refused


@pytest.mark.clause("SBX-3")
def test_a_program_that_reads_its_assignment_in_a_sandbox_gets_nothing(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "black.py").write_text("print(open('one.toml').read())".replace("one.toml", str(tmp_path / "one.toml")))
    _, out, err = run(capsys, "grade", *command)
    assert ("the sandbox" in err) == ("title = " not in out)


@pytest.mark.clause("GRD-5", "GRD-7")
def test_a_run_that_raytruth_fails_in_leaves_a_result_without_a_score_and_never_replaces_a_grade(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise MemoryError("no room")

    files = ("--out", "graded", "--gradescope", "results.json")
    with monkeypatch.context() as broken:
        broken.setattr("raytruth.grade_command.grade_submission", fail)
        assert run(capsys, "grade", *files, *command)[0] == 3
    assert "score" not in json.loads((tmp_path / "results.json").read_text())
    assert run(capsys, "grade", *files, *command)[0] == 1
    kept = {path: path.read_bytes() for path in (tmp_path / "results.json", tmp_path / "graded" / "grade.json")}
    monkeypatch.setattr("raytruth.comparisons.grading.grade.graded_picture", int)  # of a program: an error
    assert run(capsys, "grade", *files, *command)[0] == 3
    assert {path: path.read_bytes() for path in kept} == kept


PRIVATE = """deadline = 2026-12-01T00:00:00Z
drawn = "anew"
"""
DRAWN = """private_scenes = ["single-plane"]
[[topics.families]]
family = "scale"
parameter = 1.0
seeds = [1]
"""


@pytest.mark.clause("GRD-8")
def test_private_scenes_are_told_after_the_deadline_and_a_submission_keeps_its_scenes(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "one.toml").write_text(ASSIGNMENT.replace("models", f"{PRIVATE}models", 1) + DRAWN)
    (tmp_path / "black.py").write_text("raise SystemExit('no picture')")  # which is quickly judged
    (tmp_path / "metadata.json").write_text(json.dumps({"id": 12, "previous_submissions": [{"results": {"score": 1}}]}))
    told = {}
    for month in ("11", "12"):
        options = ("--date", f"2026-{month}-30T00:00:00Z", "--submission-metadata", "metadata.json")
        files = ("--out", month, "--gradescope", f"{month}.json")
        status, told[month], _ = run(capsys, "grade", *options, *files, *command)
        assert status == 1
    first, second = (json.loads((tmp_path / month / "grade.json").read_text()) for month in told)
    assert first["attempt"] == 2
    assert first["seed"] == second["seed"] != 0
    assert [it["name"] for it in first["scenes"]] == [it["name"] for it in second["scenes"]]
    assert "33.33 more are decided by scenes that are told after the deadline" in told["11"]
    assert "single-plane" not in told["11"]
    assert "single-plane" not in (tmp_path / "11" / "student.html").read_text()
    assert "single-plane" not in (tmp_path / "11.json").read_text()
    assert "single-plane" in told["12"]
    assert "single-plane" in (tmp_path / "11" / "teacher.html").read_text()


@pytest.mark.clause("CMD-2")
def test_a_wrong_date_or_metadata_is_one_sentence(command: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert "--date: expected a date with time and offset" in refusal(capsys, "grade", "--date", "today", *command)
    told = refusal(capsys, "grade", "--submission-metadata", "none.json", *command)
    assert "--submission-metadata: none.json: expected Gradescope's submission_metadata.json" in told
