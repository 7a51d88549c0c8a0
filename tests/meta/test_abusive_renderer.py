"""Every misdeed of a renderer becomes an error cell, and nothing of it is left: no process, no file, no zombie."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.matrix.cell import LOG_FILE, TRUTH_FILE
from raytruth.comparisons.matrix.plan import PlannedCell
from raytruth.comparisons.matrix.run import make_truth, run_cells
from raytruth.comparisons.matrix.whole_cells import CELL_FILE
from raytruth.comparisons.records.results import Verdict
from tests.comparisons.matrix.cell_places import place_of
from tests.comparisons.processes.test_isolation import assert_ends, children
from tests.meta.abusive_renderer import LOG_LIMIT, MISDEEDS, AbusiveRenderer
from tests.reference_tracer.small_scenes import small_scene

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import Cell

pytestmark = pytest.mark.clause("REN-1")

GREY = {"color": (0.5, 0.5, 0.5)}


@dataclass(frozen=True)
class Aftermath:
    directory: Path
    cells: dict[str, Cell]
    temporary: set[Path]
    """What is new in the folder of temporary files, named as Python names such files."""
    children: set[str]
    """Of this process, zombies included."""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Aftermath:
    """All misdeeds one after the other on a grey scene, as the matrix runs them, and what they left around."""
    directory = tmp_path_factory.mktemp("results")
    emission = {"white": {"emission": {"radiance": GREY["color"]}}}
    scene = small_scene(name="small", width=6, height=4, materials=emission, background=GREY)
    renderer = AbusiveRenderer()
    ((_, error_model),) = renderer.error_models
    planned = [PlannedCell(place_of(scene, renderer, name), scene.max_depth, error_model) for name in MISDEEDS]
    temporary_before, children_before = set(Path(tempfile.gettempdir()).glob("tmp*")), children()
    make_truth(scene, directory)
    cells = {cell.integrator: cell for cell in run_cells(planned, directory)}
    temporary = set(Path(tempfile.gettempdir()).glob("tmp*")) - temporary_before
    return Aftermath(directory, cells, temporary, children() - children_before)


def test_one_that_behaves_passes_beside_the_others(run: Aftermath) -> None:
    assert run.cells["behaves"].verdict == Verdict.PASS
    assert list(run.cells) == list(MISDEEDS)


@pytest.mark.parametrize("name", [name for name in MISDEEDS if name != "behaves"])
def test_a_misdeed_is_an_error_with_the_end_of_its_log_and_leaves_nothing_but_the_log(
    name: str, run: Aftermath
) -> None:
    directory, cells = run.directory, run.cells
    cell = cells[name]
    assert cell.verdict == Verdict.ERROR
    assert MISDEEDS[name][1] in cell.reason
    assert "\n" not in cell.reason
    assert len(cell.reason) < 1000
    assert cell.log is not None
    assert "last words" in (directory / cell.log).read_text()
    assert (directory / cell.log).stat().st_size <= LOG_LIMIT
    folder = directory / "cells" / "small" / f"abusive-{name}"
    assert {path.name for path in folder.iterdir()} == {CELL_FILE, LOG_FILE}


def test_what_ends_the_program_quotes_the_end_of_its_log(
    run: Aftermath,
) -> None:
    for name in ("aborts", "segmentation fault"):
        assert run.cells[name].reason.endswith("its log ends: last words")


def test_no_process_no_zombie_and_no_file_is_left_anywhere(
    run: Aftermath,
) -> None:
    directory, cells = run.directory, run.cells
    left = []
    for name in ("hangs", "leaves children"):
        log = (directory / str(cells[name].log)).read_text().splitlines()
        left += [int(line.split()[1]) for line in log if line.startswith("child")]
    assert len(left) == 4
    for process in left:
        assert_ends(process)
    assert run.children == set()
    assert run.temporary == set()
    places = {path.name for path in (directory / "cells" / "small").iterdir()}
    assert places == {TRUTH_FILE, *(f"abusive-{name}" for name in MISDEEDS)}
