"""Tracers with the conventions of public ones: what is right passes or is declared, what is wrong fails."""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.matrix.plan import PlannedCell
from raytruth.comparisons.matrix.run import make_truth, run_cells
from raytruth.comparisons.records.image_files import read_image
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
from raytruth.comparisons.renderers.program.declaration_file import checked_declaration
from tests.comparisons.matrix.cell_places import place_of
from tests.comparisons.renderers.program.public_tracers import TRACERS
from tests.reference_tracer.small_scenes import lamp, small_scene, sphere

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import Cell
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-8", "VER-17", "VER-16")

ROOT = Path(__file__).parents[4]
COMMAND = [sys.executable, "-m", "tests.comparisons.renderers.program.public_tracers"]


@cache
def room() -> Scene:
    """A shiny, a mirroring and a glass sphere above a checkered one that is the floor; two lights, and a sky."""
    shiny = {"reflectance": (0.5, 0.5, 0.5), "exponent": 9.0, "model": "phong"}
    board = {"even": (0.8, 0.7, 0.6), "odd": (0.2, 0.3, 0.4), "size": 0.71, "plane": "xz", "offset": (0.13, 0.29)}
    return small_scene(
        projection="perspective",
        width=14,
        height=10,
        extent=38.0,
        camera={"position": (0.31, 1.73, 6.1), "look_at": (0.07, 0.21, 0.0)},
        max_depth=2,
        background={"bottom": (0.11, 0.13, 0.17), "top": (0.31, 0.43, 0.61)},
        materials={
            "shiny": {"diffuse": {"reflectance": (0.7, 0.3, 0.2)}, "specular": shiny},
            "mirror": {"mirror": {"reflectance": (0.7, 0.8, 0.9)}},
            "glass": {"dielectric": {"index_of_refraction": 1.5}},
            "floor": {"diffuse": {"reflectance": {"checkerboard": board}}, "specular": shiny},
        },
        objects=[
            sphere("shiny", (-1.45, 0.13, 0.23), 0.71),
            sphere("mirror", (0.07, 0.31, -0.59), 0.83),
            sphere("glass", (1.37, 0.11, 0.71), 0.67),
            sphere("floor", (0.03, -9.1, -0.2), 8.6),
        ],
        lights=[lamp((2.3, 4.1, 3.7), 0.71), lamp((-3.1, 3.3, 2.9), 0.61)],
    )


def cell_of(name: str, folder: Path, *, mended: bool, **declared: Any) -> Cell:
    words = [*COMMAND, name, "mended" if mended else "wrong", "{scene}", "{output}"]
    environment = {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
    data = {"name": name, "command": words, "writes": "pfm", "environment": environment} | TRACERS[name].declares
    data = data | declared
    renderer = ProgramRenderer(checked_declaration(data, f"{name}.toml"), folder, f"--renderer-file {name}.toml")
    folder.mkdir(exist_ok=True)
    scene = room()
    assert renderer.refuses(scene) is None
    place = place_of(scene, renderer, "whitted")
    make_truth(place.scene, folder / "results")
    ((_, error_model),) = renderer.error_models
    planned = PlannedCell(place, scene.max_depth, error_model)
    (cell,) = run_cells([planned], folder / "results")
    return cell


MENDED = {
    "tiny": Verdict.DECLARED,
    "lesson": Verdict.PASS,
    "literate": Verdict.DECLARED,
    "go": Verdict.DECLARED,
    "challenge": Verdict.DECLARED,
}


@pytest.mark.parametrize("name", MENDED)
def test_without_its_mistakes_each_passes_or_is_declared(name: str, tmp_path: Path) -> None:
    cell = cell_of(name, tmp_path, mended=True)
    assert cell.verdict == MENDED[name], cell.reason


@pytest.mark.parametrize("name", ["lesson", "literate", "go", "challenge"])
def test_each_wrong_one_fails(name: str, tmp_path: Path) -> None:
    cell = cell_of(name, tmp_path, mended=False)
    assert cell.verdict == Verdict.FAIL, cell.reason


def test_highlights_in_shadows_are_no_mistake_of_who_declares_them(tmp_path: Path) -> None:
    cell = cell_of("lesson", tmp_path, mended=False, model={"highlights": "shadowed"})
    assert cell.verdict == Verdict.DECLARED, cell.reason


def test_who_tests_the_surface_that_a_ray_leaves_is_not_excused_for_a_mistake(tmp_path: Path) -> None:
    mended = cell_of("java", tmp_path / "mended", mended=True)
    assert mended.verdict == Verdict.DECLARED
    # The truth of rays through corners lies in the cell's own folder, and is none of the scene's.
    assert mended.images is not None
    own, of_scene = (
        read_image(tmp_path / "mended" / "results" / path) for path in (mended.images.truth, "cells/small/truth.exr")
    )
    assert (own != of_scene).any()
    cell = cell_of("java", tmp_path / "wrong", mended=False)
    assert cell.verdict == Verdict.FAIL, cell.reason


@pytest.mark.clause("VER-4")
def test_a_declaration_that_leaves_too_much_open_is_incomparable_and_names_its_line(tmp_path: Path) -> None:
    cell = cell_of("lesson", tmp_path, mended=True, arithmetic={"bits": 9})
    assert cell.verdict == Verdict.INCOMPARABLE, cell.reason
    assert "cannot be judged" in cell.reason
    assert "; what costs most is [arithmetic]: without it" in cell.reason


LITERATE = TRACERS["literate"].declares["conventions"]
UNTOLD: list[tuple[str, dict[str, Any]]] = [
    ("literate", {"conventions": {**LITERATE, "scale": 1.0}}),
    ("literate", {"conventions": {**LITERATE, "field_of_view": "vertical"}}),
    ("challenge", {"conventions": {"field_of_view": "larger side"}}),
    ("java", {"conventions": {}}),
    ("tiny", {"model": {}}),
]


@pytest.mark.parametrize(("name", "declared"), UNTOLD)
def test_a_convention_or_a_model_that_is_not_told_fails(name: str, declared: dict[str, Any], tmp_path: Path) -> None:
    cell = cell_of(name, tmp_path, mended=True, **declared)
    assert cell.verdict == Verdict.FAIL, cell.reason
