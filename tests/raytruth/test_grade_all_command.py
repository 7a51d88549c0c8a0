from __future__ import annotations

import contextlib
import csv
import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.comparisons.classes.small_class import written_assignment, written_submission
from tests.raytruth.running import refusal, run

pytestmark = pytest.mark.clause("CLA-2", "CLA-3", "CMD-1", "CMD-2")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    written_assignment(tmp_path)
    return tmp_path


def test_a_class_of_right_and_hostile_submissions_is_graded_and_all_files_are_written(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    export = folder / "export"
    written_submission(export / "Ada Lovelace_101_assignsubmission_file_")
    written_submission(export / "Ben_102_assignsubmission_file_", "sys.exit('no picture')")
    link = written_submission(export / "Cleo_103_assignsubmission_file_")
    (link / "passwords").symlink_to("/etc/passwd")
    nothing = export / "=Dan_104_assignsubmission_file_"
    nothing.mkdir()
    (nothing / "readme.txt").write_text("later")
    status, out, err = run(capsys, "grade-all", "export", "--assignment", "one.toml", "--results-for", "gradescope")
    assert status == 1
    assert [line.split("\t")[:2] for line in out.splitlines()[:-1]] == [
        ["=Dan", "0"],
        ["Ada Lovelace", "100"],
        ["Ben", "0"],
        ["Cleo", "0"],
    ]
    assert "4 of 4:" in err
    graded = folder / "graded"
    rows = list(csv.DictReader((graded / "moodle.csv").read_text().splitlines()))
    assert [(row["Identifier"], row["Grade"]) for row in rows][1] == ("Participant 101", "100")
    assert rows[0]["Full name"] == "'=Dan"
    folders = {
        it["student"]: graded / "students" / it["folder"]
        for it in json.loads((graded / "class.json").read_text())["rows"]
    }
    assert json.loads((folders["Ada Lovelace"] / "results.json").read_text())["score"] == 100
    assert "passwords" in (folders["Cleo"] / "student.html").read_text()
    status, _, err = run(capsys, "grade-all", "export", "--assignment", "one.toml")
    assert status == 1
    assert err == "4 of 4 submissions are graded already.\n"


@pytest.mark.clause("CLA-1")
def test_an_export_may_be_the_archive_that_it_comes_in_and_a_build_command_is_run_within_limits(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own = written_submission(folder / "export" / "ada")
    (own / "tracer.py").rename(own / "tracer.source")
    written_submission(folder / "export" / "ben")
    shutil.make_archive("class", "zip", "export")
    build = "cp tracer.source tracer.py"
    options = (
        "--assignment",
        "one.toml",
        "--build",
        build,
        "--run",
        f"{shlex.quote(sys.executable)} tracer.py {{scene}} {{output}}.pfm",
    )
    status, _, _ = run(capsys, "grade-all", "class.zip", *options)
    assert status == 1
    rows = {it["student"]: it for it in json.loads((folder / "graded" / "class.json").read_text())["rows"]}
    assert (rows["ada"]["status"], rows["ada"]["score"]) == ("graded", 100)
    assert rows["ben"]["status"] == "build_failed"
    assert "It could not be built: cp ended with exit status 1" in rows["ben"]["reason"]
    assert not list((folder / "graded").glob(".unpacked-*"))


def test_bad_usage_is_one_sentence_and_leaves_nothing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "empty").mkdir()
    (folder / "class.zip").write_bytes(b"PK")
    for sentence, *arguments in (
        ("expected 1 or more, found 0", "empty", "--workers", "0"),
        ("expected a folder or an archive for each student, found none", "empty"),
        ("'class.zip' is damaged", "class.zip"),
        ("expected a folder of submissions", "one.toml"),
        ("--run: expected words as a shell takes them", "empty", "--run", "'"),
        ("did you mean 'glass'", "empty", "--assignment", "glas"),
    ):
        assert sentence in refusal(capsys, "grade-all", *arguments)
    assert not list(folder.rglob("class.json"))


@pytest.mark.clause("SBX-3")
def test_submissions_are_built_and_run_where_they_see_no_other(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ada = written_submission(folder / "class" / "ada")
    spying = f"""
if os.path.exists({str(ada / "tracer.py")!r}) or os.path.exists({str(folder / "graded")!r}):
    open("seen", "w").close()
if len(sys.argv) == 2:
    sys.exit()
if os.path.exists("seen") or os.path.exists(os.path.join(os.path.dirname(__file__), "seen")):
    sys.exit("seen")
"""
    written_submission(folder / "class" / "ben", spying)
    build = (
        f'{shlex.quote(sys.executable)} -c \'import os, runpy, sys; sys.argv[1:] = ["b"]; runpy.run_path("tracer.py")\''
    )
    _, out, _ = run(capsys, "grade-all", "class", "--assignment", "one.toml", "--build", build, "--json")
    scores = {row["student"]: row["score"] for row in json.loads(out)["rows"]}
    grade = json.loads(next((folder / "graded" / "students").glob("ben*/grade.json")).read_text())
    assert scores["ben"] == (0 if grade["sandbox"]["rung"] == "none" else 100)


def _running(command: tuple[str, ...]) -> bool:
    """Whether a process of this machine runs just this."""
    for process in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):  # it has ended
            if process.read_bytes().split(b"\0")[: len(command)] == [word.encode() for word in command]:
                return True
    return False


def test_a_class_that_is_killed_goes_on_and_leaves_no_process(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("ada", "ben"):
        written_submission(folder / "class" / name)
    sleep = ("/bin/sleep", f"60.{os.getpid()}")  # a length that tells it from all others, also inside a sandbox
    written_submission(folder / "class" / "cleo", f"os.execv({sleep[0]!r}, {list(sleep)!r})")
    command = [sys.executable, "-m", "raytruth", "grade-all", "class", "--assignment", "one.toml"]
    first = subprocess.Popen(command, cwd=folder, stderr=subprocess.DEVNULL)
    rows = folder / "graded" / "students"
    while len(list(rows.glob("*/row.json"))) < 2 or not _running(sleep):
        assert first.poll() is None
        time.sleep(0.05)
    first.send_signal(signal.SIGKILL)
    first.wait()
    while _running(sleep):
        time.sleep(0.05)
    shutil.rmtree(folder / "class" / "cleo")
    written_submission(folder / "class" / "cleo")
    status, _, err = run(capsys, "grade-all", "class", "--assignment", "one.toml")
    assert status == 0
    assert "2 of 3 submissions are graded already." in err
    assert "1 of 1: cleo: 100 of 100 points" in err
