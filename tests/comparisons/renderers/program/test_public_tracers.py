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


TRIANGLE = ((-2.6, -0.43, -1.9), (0.6, -0.39, -2.3), (-0.9, 1.9, -2.1))


@cache
def room(*, sky: bool = True) -> Scene:
    """A shiny, a mirroring and a glass sphere and a triangle above a checkered plane; two lights, and a sky or none."""
    shiny = {"reflectance": (0.5, 0.5, 0.5), "exponent": 9.0, "model": "phong"}
    board = {"even": (0.8, 0.7, 0.6), "odd": (0.2, 0.3, 0.4), "size": 0.71, "plane": "xz", "offset": (0.13, 0.29)}
    return small_scene(
        projection="perspective",
        width=18,
        height=13,
        extent=38.0,
        camera={"position": (0.31, 1.73, 6.1), "look_at": (0.07, 0.21, 0.0)},
        max_depth=2,
        background={"bottom": (0.11, 0.13, 0.17), "top": (0.31, 0.43, 0.61)} if sky else {"color": (0.0, 0.0, 0.0)},
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
            {"shape": "mesh", "vertices": TRIANGLE, "faces": ((0, 1, 2),), "material": "shiny"},
            {"shape": "plane", "point": (0.03, -0.61, -0.2), "normal": (0.02, 1.0, 0.03), "material": "floor"},
        ],
        lights=[lamp((2.3, 4.1, 3.7), 0.71), lamp((-3.1, 3.3, 2.9), 0.61)],
    )


def cell_of(name: str, folder: Path, mistake: str = "mended", *, scene: Scene | None = None, **declared: Any) -> Cell:
    """The tracer with one of its mistakes or none, by what it declares and what is declared otherwise."""
    words = [*COMMAND, name, mistake, "{scene}", "{output}"]
    environment = {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
    data = {"name": name, "command": words, "writes": "pfm", "environment": environment} | TRACERS[name].declares
    data = data | declared
    renderer = ProgramRenderer(checked_declaration(data, f"{name}.toml"), folder, f"--renderer-file {name}.toml")
    folder.mkdir(exist_ok=True)
    scene = scene or room()
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
    "java": Verdict.PASS,
}


@pytest.mark.parametrize("name", MENDED)
def test_without_its_mistakes_each_passes_or_is_declared(name: str, tmp_path: Path) -> None:
    cell = cell_of(name, tmp_path)
    assert cell.verdict == MENDED[name], cell.reason


def test_what_shows_nowhere_is_a_pass(tmp_path: Path) -> None:
    """Where rays leave and nothing is around, the background of those that may not be traced any more is black."""
    cell = cell_of("tiny", tmp_path, scene=room(sky=False))
    assert cell.verdict == Verdict.PASS, cell.reason


def test_bytes_that_are_cut_off_instead_of_rounded_pass_for_who_says_so(tmp_path: Path) -> None:
    cut = {"writes": "ppm", "rounding": "truncated"}
    cell = cell_of("lesson", tmp_path / "told", **cut)
    assert cell.verdict == Verdict.PASS, cell.reason
    cell = cell_of("lesson", tmp_path / "untold", **cut | {"rounding": "nearest"})
    assert cell.verdict == Verdict.FAIL, cell.reason


MISTAKES = [(name, mistake) for name, tracer in TRACERS.items() for mistake in tracer.mistakes]


@pytest.mark.parametrize(("name", "mistake"), MISTAKES)
def test_each_mistake_fails_by_itself(name: str, mistake: str, tmp_path: Path) -> None:
    """It is the cause: without it the same tracer with the same declaration fails nowhere."""
    cell = cell_of(name, tmp_path, mistake)
    assert cell.verdict == Verdict.FAIL, cell.reason


def test_highlights_in_shadows_are_no_mistake_of_who_declares_them(tmp_path: Path) -> None:
    cell = cell_of("lesson", tmp_path, "highlights in shadows", model={"highlights": "shadowed"})
    assert cell.verdict == Verdict.DECLARED, cell.reason


def test_the_truth_of_rays_through_corners_is_the_cells_own(tmp_path: Path) -> None:
    cell = cell_of("java", tmp_path)
    assert cell.images is not None
    own, of_scene = (read_image(tmp_path / "results" / path) for path in (cell.images.truth, "cells/small/truth.exr"))
    assert (own != of_scene).any()


@pytest.mark.clause("VER-4")
def test_a_declaration_that_leaves_too_much_open_is_incomparable_and_names_its_line(tmp_path: Path) -> None:
    cell = cell_of("lesson", tmp_path, scene=room().resized(4, 3), arithmetic={"bits": 9})
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
    cell = cell_of(name, tmp_path, **declared)
    assert cell.verdict == Verdict.FAIL, cell.reason
