from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

import pytest

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
