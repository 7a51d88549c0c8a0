from __future__ import annotations

import sys
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.grading import grade as grade_module
from raytruth.comparisons.grading.assignment import Assignment
from raytruth.comparisons.grading.faulty_tracers import FaultyTracer
from raytruth.comparisons.grading.feedback import for_student
from raytruth.comparisons.grading.grade import Occasion, grade_submission
from raytruth.comparisons.grading.submission import as_graded
from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
from raytruth.comparisons.renderers.program.declaration_file import checked_declaration
from tests.comparisons.grading.small_scenes import ASSIGNMENT, AtOnce, picture, small_scene

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.records.grade_results import Grade

NAMES = ("three-coloured-lights", "single-sphere")
SCENES = {"shadows": (small_scene(NAMES[0]),), "shading": (small_scene(NAMES[1]),)}
ASKED = Assignment.model_validate(
    ASSIGNMENT.model_dump()
    | {
        "limits": {"seconds": 1.0},
        "topics": [
            {"id": "shadows", "title": "Shadows", "weight": 1.0, "scenes": ["-"]},
            {"id": "shading", "title": "Shading", "weight": 3.0, "scenes": ["-"]},
        ],
    }
)
# Hands out pictures that lie beside it, by the scene's name.
PROGRAM = """
import pathlib, shutil, sys, time
name = pathlib.Path(sys.argv[1]).stem
{misdeed}
shutil.copy(pathlib.Path(__file__).with_name(name + ".pfm"), sys.argv[2])
"""


def program(folder: Path, misdeed: str = "", **images: np.ndarray) -> ProgramRenderer:
    """A program that knows the scenes' pictures."""
    for name in NAMES:
        scene = small_scene(name)
        image = images.get(name.replace("-", "_"), picture(scene)).astype("<f4")
        header = f"PF\n{image.shape[1]} {image.shape[0]}\n-1.0\n".encode()
        (folder / f"{scene.name}.pfm").write_bytes(header + image[::-1].tobytes())
    (folder / "copies.py").write_text(PROGRAM.format(misdeed=misdeed))
    data = {"name": "copies", "command": [sys.executable, "copies.py", "{scene}", "{output}"], "writes": "pfm"}
    return ProgramRenderer(checked_declaration(data, "copies.toml"), folder, "--renderer-file copies.toml")


def graded(renderer: ProgramRenderer, pool: AtOnce | None = None) -> Grade:
    return grade_submission(renderer, ASKED, SCENES, Occasion(), pool or AtOnce())


@pytest.fixture(autouse=True)
def some_of_the_catalogue(monkeypatch: pytest.MonkeyPatch) -> None:
    """All of it takes longer."""
    known = [FaultyTracer((name,)) for name in ("no_pi", "no_shadow_rays", "first_light_only")]
    monkeypatch.setattr(grade_module, "single_faults", lambda: known)


def points(grade: Grade) -> dict[str, float]:
    return {topic.id: topic.points for topic in grade.clauses}


@pytest.mark.clause("GRD-2")
def test_right_pictures_get_all_points(tmp_path: Path) -> None:
    grade = graded(program(tmp_path))
    assert (grade.score, grade.maximum, grade.status) == (100.0, 100.0, "graded")
    assert points(grade) == {"shadows": 25.0, "shading": 75.0}
    assert (grade.mistakes, grade.diagnosis, grade.unexplained) == ((), (), "")


@pytest.mark.clause("GRD-2")
@pytest.mark.parametrize("misdeed", ["time.sleep(60)", "raise SystemExit('no picture')"])
def test_a_hang_or_a_crash_on_one_scene_costs_that_scene_and_no_more(tmp_path: Path, misdeed: str) -> None:
    grade = graded(program(tmp_path, f"if 'lights' in name: {misdeed}"))
    assert points(grade) == {"shadows": 0.0, "shading": 75.0}
    assert {it.name: it.verdict for it in grade.scenes} == {
        "small-three-coloured-lights": "error",
        "small-single-sphere": "right",
    }


@pytest.mark.clause("GRD-3")
def test_a_mirrored_submission_is_charged_once_and_what_else_is_wrong_is_graded_on_the_turned_pictures(
    tmp_path: Path,
) -> None:
    wrong = picture(SCENES["shadows"][0])
    wrong[2, 3] += 0.25
    images = {"three_coloured_lights": wrong[:, ::-1], "single_sphere": picture(SCENES["shading"][0])[:, ::-1]}
    grade = graded(program(tmp_path, **images))
    (mistake,) = grade.mistakes
    assert mistake.name == "mirrored"
    assert points(grade)["shading"] == 75.0
    assert 0.0 < points(grade)["shadows"] <= 12.5
    assert grade.score == pytest.approx(sum(points(grade).values()) - mistake.charge)
    assert mistake.charge == pytest.approx(0.1 * sum(points(grade).values()))
    assert [it.region for it in grade.scenes if it.region] == [(3, 3, 2, 2)]


class FailsOn(AtOnce):
    """As a pool one of whose processes fails on a scene."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """The result, or an error for the scene with the lights."""
        if SCENES["shadows"][0] in args:
            future: Future[Any] = Future()
            future.set_exception(MemoryError("no room"))
            return future
        return super().submit(fn, *args, **kwargs)


@pytest.mark.clause("GRD-5")
def test_what_raytruth_itself_gets_wrong_is_told_and_is_no_zero(tmp_path: Path) -> None:
    grade = graded(program(tmp_path), FailsOn())
    assert grade.status == "grader_error"
    assert {it.name: it.verdict for it in grade.scenes} == {
        "small-three-coloured-lights": "grader_error",
        "small-single-sphere": "right",
    }
    assert grade.score == grade.maximum


@pytest.mark.clause("GRD-2")
def test_a_program_cannot_declare_itself_right(tmp_path: Path) -> None:
    renderer = program(tmp_path)
    generous = {"arithmetic": {"bits": 8}, "conventions": {"flip_x": True}, "limits": {"seconds": 3600.0}}
    data = renderer.declaration.model_dump(exclude_defaults=True) | generous
    lenient = ProgramRenderer(checked_declaration(data, "copies.toml"), tmp_path, "")
    assert as_graded(lenient, ASKED).declaration == as_graded(renderer, ASKED).declaration
    assert as_graded(lenient, ASKED).declaration.limits.seconds == 1.0


@pytest.mark.clause("GRD-6")
def test_a_student_is_told_hints_and_no_solutions_and_no_more_than_the_assignment_allows(tmp_path: Path) -> None:
    wrong = picture(SCENES["shadows"][0]) * np.pi
    whole = graded(program(tmp_path, three_coloured_lights=wrong, single_sphere=picture(SCENES["shading"][0]) * np.pi))
    assert whole.diagnosis[0].fault == "no_pi"
    told = for_student(whole).model_dump_json()
    assert whole.diagnosis[0].hint in for_student(whole).diagnosis[0].hint
    assert "no_pi" not in told
    assert whole.diagnosis[0].words not in told
    levels = {level: for_student(whole.model_copy(update={"told": level})) for level in ("score", "topics", "scenes")}
    assert [len(levels[level].clauses) for level in levels] == [0, 2, 2]
    assert [len(levels[level].scenes) for level in levels] == [0, 0, 2]
    assert all(not it.diagnosis and all(scene.region is None for scene in it.scenes) for it in levels.values())
    assert all(it.score == whole.score for it in levels.values())
