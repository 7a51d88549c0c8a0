"""Ten misdeeds of a user's program, each of which is an error cell with its last words, and leaves nothing behind."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.matrix.cell import LOG_FILE
from raytruth.comparisons.matrix.plan import PlannedCell
from raytruth.comparisons.matrix.run import make_truth, run_cells
from raytruth.comparisons.matrix.whole_cells import CELL_FILE
from raytruth.comparisons.records.results import Verdict
from tests.comparisons.matrix.cell_places import place_of
from tests.comparisons.processes.test_isolation import assert_ends, children
from tests.comparisons.renderers.program.scripts import grey_scene, program

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import Cell

pytestmark = pytest.mark.clause("REN-1", "REN-8")

# Long enough to start a small program on a busy machine; only those that never end take it all.
HANGING = {"seconds": 5, "output_mib": 1}

SLEEPER = """
if os.fork() == 0:
    os.setsid()
    print("child", os.getpid(), flush=True)
    time.sleep(600)
time.sleep(0.2)
"""

MISDEEDS: dict[str, tuple[str, str]] = {
    "crash": ("write(); os.abort()", "was ended by signal SIGABRT"),
    "hang": (SLEEPER + "write()\nwhile True: pass", "did not end within its time limit of 5 s"),
    "fork bomb": ("write()\nwhile True: os.fork()", "had more than 512 processes at once"),
    "wrong size": ("write(width=width + 1)", "its output.pfm has 7x4 pixels, expected 6x4 pixels"),
    "not a number": ("write(color=(0.5, float('nan'), 0.5))", "24 pixels of its image are not a number"),
    "truncated file": ("write(); os.truncate(output, 100)", "its output.pfm is damaged or incomplete"),
    "nothing": ("", "it wrote no output.pfm"),
    "log of 10 GB": (
        "write()\nfor _ in range(10 * 1024): print('garbage' * 150_000 + '\\nlast words', flush=True)",
        "printed more than 1048576 bytes",
    ),
    "writes elsewhere": ("write(path='../picture.pfm'); write(path='picture.pfm')", "it wrote no output.pfm"),
    "ignores SIGTERM": (
        SLEEPER + "signal.signal(signal.SIGTERM, signal.SIG_IGN)\nwrite()\nwhile True: time.sleep(1)",
        "did not end within its time limit of 5 s",
    ),
}
"""By name: what the program does, and a part of the reason that the cell must give."""


@dataclass(frozen=True)
class Aftermath:
    directory: Path
    cells: dict[str, Cell]
    temporary: set[Path]
    children: set[str]


def judged(name: str, code: str, directory: Path, **declared: Any) -> Cell:
    """The cell of a program that does this, in a folder of its own."""
    folder = directory / "programs" / name
    folder.mkdir(parents=True)
    renderer = program(folder, code, limits=HANGING if "limit" in MISDEEDS.get(name, ("", ""))[1] else {}, **declared)
    scene = grey_scene()
    place = place_of(scene, renderer, "whitted")
    ((_, error_model),) = renderer.error_models
    (cell,) = run_cells([PlannedCell(place, scene.max_depth, error_model)], directory / "results" / name)
    return cell


@pytest.fixture(scope="module")
def aftermath(tmp_path_factory: pytest.TempPathFactory) -> Aftermath:
    directory = tmp_path_factory.mktemp("misdeeds")
    temporary, of_ours = set(Path(tempfile.gettempdir()).glob("tmp*")), children()
    for name in MISDEEDS:
        make_truth(grey_scene(), directory / "results" / name)
    cells = {name: judged(name, code, directory) for name, (code, _) in MISDEEDS.items()}
    return Aftermath(directory, cells, set(Path(tempfile.gettempdir()).glob("tmp*")) - temporary, children() - of_ours)


@pytest.mark.parametrize("name", MISDEEDS)
def test_a_misdeed_is_an_error_with_the_end_of_its_log_and_leaves_only_the_log(name: str, aftermath: Aftermath) -> None:
    cell = aftermath.cells[name]
    results = aftermath.directory / "results" / name
    assert cell.verdict == Verdict.ERROR
    assert MISDEEDS[name][1] in cell.reason
    assert "\n" not in cell.reason
    assert cell.log is not None
    assert "last words" in (results / cell.log).read_text()
    left = {path.name for path in (results / "cells" / "small" / "mine-whitted").iterdir()}
    assert left - {"output.pfm"} == {CELL_FILE, LOG_FILE}


def test_what_has_no_picture_is_told_with_the_last_words(aftermath: Aftermath) -> None:
    for name in ("crash", "nothing", "truncated file", "writes elsewhere"):
        assert aftermath.cells[name].reason.endswith("its log ends: last words")


def test_no_process_and_no_file_of_a_misdeed_is_left(aftermath: Aftermath) -> None:
    for name in ("hang", "ignores SIGTERM"):
        log = (aftermath.directory / "results" / name / str(aftermath.cells[name].log)).read_text().splitlines()
        (child,) = [int(line.split()[1]) for line in log if line.startswith("child")]
        assert_ends(child)
    assert aftermath.children == set()
    assert aftermath.temporary == set()
    assert list(aftermath.directory.rglob("picture.pfm")) == []


def test_one_that_behaves_passes(tmp_path: Path) -> None:
    make_truth(grey_scene(), tmp_path / "results" / "behaves")
    cell = judged("behaves", "write()", tmp_path)
    assert cell.verdict == Verdict.PASS, cell.reason
    assert {path.name for path in (tmp_path / "results" / "behaves" / cell.folder).iterdir()} == {
        *(CELL_FILE, LOG_FILE, "output.pfm"),
        *("render.exr", "tolerances.exr", "feasible.exr"),
    }
