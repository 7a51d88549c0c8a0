"""A whole run that is killed or interrupted in the middle leaves what it has finished, and no process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.comparisons.matrix.scene_files import LAMP, scene_file

pytestmark = pytest.mark.clause("RES-3", "RES-5")

SCENES = 9
FINISHED = 3
"""So many cells are waited for before the run is stopped."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The working directory, with some scenes."""
    for number in range(SCENES):
        light = LAMP | {"position": [1, 2, 3 + number]}
        scene_file(tmp_path, f"scene-{number}", width=32, height=24, lights=[light])
    return tmp_path


def raytruth(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "raytruth", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def run_arguments(folder: Path) -> list[str]:
    return ["run", *sorted(path.name for path in folder.glob("*.json")), "--renderer", "closed_form", "--jobs", "2"]


def stopped(folder: Path, number: int, *, whole_group: bool) -> tuple[int, str]:
    """Start a run, send it a signal when some cells are finished, and wait for the end of all its processes."""
    command = [sys.executable, "-m", "raytruth", *run_arguments(folder)]
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert process.stderr is not None
        told = ""
        while f"[{FINISHED}/{SCENES}]" not in told:
            line = process.stderr.readline()
            assert line, told
            told += line
        if whole_group:  # as a terminal does
            os.killpg(process.pid, number)
        else:
            process.send_signal(number)
        told += process.stderr.read()
        process.wait()
        while in_session(process.pid):
            time.sleep(0.05)
    return process.returncode, told


def in_session(session: int) -> list[int]:
    """The processes of a session that have not ended; nobody may have asked for how they ended."""
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, *_, its_session = path.read_text(encoding="utf-8").rpartition(")")[2].split()[:4]
        except OSError:  # it ended meanwhile
            continue
        if int(its_session) == session and state != "Z":
            found.append(int(path.parent.name))
    return found


def rendered(folder: Path) -> dict[Path, int]:
    """The cells that are finished, with the time of their images."""
    return {path: (path.parent / "render.exr").stat().st_mtime_ns for path in folder.rglob("cell.json")}


def verdicts(folder: Path) -> list[str]:
    document = json.loads((folder / "results" / "results.json").read_text(encoding="utf-8"))
    return [cell["verdict"] for cell in document["cells"]]


def test_a_run_that_was_killed_is_resumed_with_the_cells_that_it_had_finished(folder: Path) -> None:
    status, _ = stopped(folder, signal.SIGKILL, whole_group=False)
    assert status == -signal.SIGKILL
    finished = rendered(folder)
    assert FINISHED <= len(finished) < SCENES
    left_over = folder / "results/cells/scene-0/.unfinished-closed_form-local-x"
    left_over.mkdir(parents=True, exist_ok=True)
    resumed = raytruth(folder, *run_arguments(folder))
    assert resumed.returncode == 0, resumed.stderr
    assert f"[1/{SCENES - len(finished)}]" in resumed.stderr
    after = rendered(folder)
    assert len(after) == SCENES
    assert finished.items() <= after.items()
    assert verdicts(folder) == ["pass"] * SCENES
    assert list((folder / "results").rglob(".*")) == []


def test_an_interrupted_run_leaves_results_that_can_be_shown(folder: Path) -> None:
    status, told = stopped(folder, signal.SIGINT, whole_group=True)
    assert status == 130, told
    assert told.endswith("raytruth: interrupted.\n")
    assert "Traceback" not in told
    assert set(verdicts(folder)) == {"pass"}
    assert FINISHED <= len(verdicts(folder)) < SCENES
    assert raytruth(folder, "report", "results").returncode == 0
    assert raytruth(folder, *run_arguments(folder)).returncode == 0
    assert verdicts(folder) == ["pass"] * SCENES


def test_two_runs_do_not_write_into_one_directory(folder: Path) -> None:
    command = [sys.executable, "-m", "raytruth", *run_arguments(folder)]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as first:
        assert first.stderr is not None
        assert first.stderr.readline()
        second = raytruth(folder, *run_arguments(folder))
        assert second.returncode == 2
        assert "results: another run is writing there; wait for it, or give another --out." in second.stderr
        first.communicate()
    assert first.returncode == 0
