from __future__ import annotations

import json
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import pytest

from raytruth import run_progress
from raytruth.comparisons.matrix import run as matrix_run
from raytruth.comparisons.renderers import catalogue
from raytruth.run_progress import in_words
from tests.comparisons.matrix.pretending import Pretender, truthful
from tests.comparisons.matrix.scene_files import scene_file
from tests.raytruth.running import run

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rendering
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("RES-6")


class Witness(Pretender):
    """Tells on standard error when it is tried."""

    def version(self) -> str | None:
        print("TRIED", file=sys.stderr)
        return super().version()


@pytest.fixture(autouse=True)
def renderers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, Pretender]:
    """All that there are, which are tried and render in this process; the working directory and cache are empty."""
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(matrix_run, "ProcessPoolExecutor", lambda jobs, *_: ThreadPoolExecutor(jobs))
    monkeypatch.setattr("raytruth.run_command.with_metrics", lambda _out, cells: cells)
    monkeypatch.chdir(tmp_path)
    known: dict[str, Pretender] = {name: Witness(name=name) for name in ("one", "two")}
    monkeypatch.setattr(catalogue, "all_renderers", lambda: known)
    return known


def told_by(capsys: pytest.CaptureFixture[str], scenes: list[str]) -> list[str]:
    """What a run tells line by line."""
    return run(capsys, "run", *scenes, "--jobs", "1")[2].splitlines()


def test_what_a_run_will_do_is_told_before_any_renderer_is_tried(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    scenes = [scene_file(tmp_path, name) for name in ("small", "another")]
    told = told_by(capsys, scenes)
    (intention,) = [line for line in told if "scenes ×" in line]
    assert "2 scenes × 2 renderers: 4 cells to judge, 0 kept, 0 not comparable; " in intention
    assert told.index(intention) < told.index("TRIED")
    (intention,) = [line for line in told_by(capsys, scenes) if "scenes ×" in line]
    assert "0 cells to judge, 4 kept, 0 not comparable; nothing to do." in intention


def test_what_cannot_run_here_is_told_when_that_is_known(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, renderers: dict[str, Pretender]
) -> None:
    renderers["two"].installed = None
    told = told_by(capsys, [scene_file(tmp_path)])
    (change,) = [line for line in told if "without two" in line]
    assert change.startswith("raytruth: 1 cell to judge without two; ")
    assert told.index(change) > told.index("TRIED")


def test_in_a_log_nothing_is_written_over(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert all(line.isprintable() for line in told_by(capsys, [scene_file(tmp_path)]))


def test_a_program_that_reads_the_results_finds_nothing_else(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, out, err = run(capsys, "run", scene_file(tmp_path), "--json")
    assert status == 0
    assert len(json.loads(out)["cells"]) == 2
    assert "2 cells to judge" in err


def test_the_report_is_there_before_all_cells_are(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, renderers: dict[str, Pretender], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_progress, "SECONDS_BETWEEN_LINES", 0.0)
    monkeypatch.setattr(run_progress, "SHARE_FOR_REPORTS", float("inf"))
    found = []

    def looking(scene: Scene, folder: Path) -> Rendering:
        found.append((tmp_path / "results" / "report.html").exists())
        return truthful(scene, folder)

    renderers["one"].answer = renderers["two"].answer = looking
    scenes = [scene_file(tmp_path, name) for name in ("small", "another")]
    assert run(capsys, "run", *scenes, "--jobs", "1")[0] == 0
    assert found == [False, False, True, True]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0, "a few seconds"),
        (12, "about 20 seconds"),
        (89, "about 90 seconds"),
        (91, "about 2 minutes"),
        (550, "about 10 minutes"),
    ],
)
def test_times_are_told_no_more_exactly_than_they_are_known(seconds: float, words: str) -> None:
    assert in_words(seconds) == words
