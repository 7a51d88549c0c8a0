"""The example tracers on every scene of the library, by their own declarations, as `raytruth run` judges them.

Those in float64 declare the same, and so are held to one feasible set a scene, in its own size: that set costs most.
Those in float32 have a set each, of which each pixel costs more: their pictures are small, and they take turns.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.matrix.plan import plan_run
from raytruth.comparisons.matrix.run import make_truth, run_cells
from raytruth.comparisons.records.results import Cell, Verdict
from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
from raytruth.comparisons.renderers.program.declaration_file import load_declaration
from raytruth.scenes.library import library_names, open_scene
from tests.meta.example_tracers import TOOLS, built, copies, is_here, needs
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("PRJ-8")

__all__ = ["copies"]  # a fixture, which tests ask for by its name

IN_FLOAT32 = ("tracer-float32", "tracer-float32-fast", "tracer-float32-epsilon")


def judged(scene: Scene, declarations: list[Path], out: Path) -> list[Cell]:
    """The cells of programs that declare the same arithmetic."""
    programs = [
        ProgramRenderer(load_declaration(path), path.parent, f"--renderer-file {path}") for path in declarations
    ]
    plan = plan_run({scene.name: scene}, programs, out, fresh=True)
    assert plan.settled == ()
    (planned,) = plan.by_scene.values()
    (_,) = {cell.error_model for cell in planned}
    make_truth(scene, out)
    return run_cells(planned, out)


@pytest.mark.parametrize("scene_name", library_names())
def test_all_tracers_in_float64_pass(copies: Path, scene_name: str, tmp_path: Path) -> None:
    languages = [language for language in TOOLS if is_here(language)]
    for language in languages:
        built(copies, language)
    cells = judged(open_scene(scene_name), [copies / language / "tracer.toml" for language in languages], tmp_path)
    assert [(cell.renderer, cell.reason) for cell in cells if cell.verdict != Verdict.PASS] == []
    assert len(cells) == len(languages)


IN_TURNS = [(scene_name, IN_FLOAT32[turn % len(IN_FLOAT32)]) for turn, scene_name in enumerate(library_names())]
"""Each scene with one of them: three sets of each would take three times as long, and tell little more."""


@needs("cpp")
@pytest.mark.parametrize(("scene_name", "name"), IN_TURNS)
def test_those_in_float32_pass_or_are_as_declared(copies: Path, scene_name: str, name: str, tmp_path: Path) -> None:
    built(copies, "cpp")
    scene = library_scene(scene_name)
    (cell,) = judged(scene, [copies / "cpp" / f"{name}.toml"], tmp_path)
    assert cell.verdict in {Verdict.PASS, Verdict.DECLARED}, cell.reason
