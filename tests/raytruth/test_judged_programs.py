from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth import judged_programs
from raytruth.comparisons.matrix import waivers
from raytruth.comparisons.matrix.waivers import Waiver
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.records.results import Verdict
from raytruth.judged_programs import JudgedPrograms
from raytruth.options import open_scenes
from raytruth.reports.loading import load_results
from tests.comparisons.matrix.pretending import Pretender, truthful
from tests.comparisons.matrix.scene_files import scene_file

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rendering
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("CMD-5")

PLACE = ("small", "pretender", "whitted")


def black(scene: Scene, folder: Path) -> Rendering:
    rendering = truthful(scene, folder)
    rendering.image[...] = 0  # type: ignore[index]  # it has one
    return rendering


def broken(_scene: Scene, _folder: Path) -> Rendering:
    raise RendererError("it ended with signal 11")


@pytest.fixture
def judged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> JudgedPrograms:
    """A pretender on two small scenes."""
    # Processes that measure take a second to start.
    monkeypatch.setattr(judged_programs, "with_metrics", lambda _out, cells: cells)
    scenes = open_scenes([scene_file(tmp_path), scene_file(tmp_path, "other")])
    return JudgedPrograms({"pretender": Pretender()}, scenes, (), tmp_path / "results")


def again(judged: JudgedPrograms, **changes: object) -> JudgedPrograms:
    """The same in another run."""
    renderer = Pretender(**changes)  # type: ignore[arg-type]  # of Pretender's fields
    return JudgedPrograms({"pretender": renderer}, judged.scenes, judged.waivers, judged.out)


def pretender(judged: JudgedPrograms) -> Pretender:
    renderer = judged.programs["pretender"]
    assert isinstance(renderer, Pretender)
    return renderer


@pytest.mark.parametrize(
    ("answer", "verdict"), [(truthful, Verdict.PASS), (black, Verdict.FAIL), (broken, Verdict.ERROR)]
)
def test_a_cell_is_judged_as_the_matrix_judges_it(
    answer: Callable[[Scene, Path], Rendering], verdict: Verdict, judged: JudgedPrograms
) -> None:
    pretender(judged).answer = answer
    cell, unmatched = judged.judged(PLACE)
    assert cell.verdict == verdict
    assert unmatched == []
    assert list(judged.places) == [PLACE, ("other", "pretender", "whitted")]


@pytest.mark.clause("REN-5")
def test_a_program_that_cannot_run_is_unavailable(judged: JudgedPrograms) -> None:
    cell, _ = again(judged, installed=None).judged(PLACE)
    assert cell.verdict == Verdict.UNAVAILABLE


@pytest.mark.clause("RES-3")
def test_what_has_not_changed_is_not_rendered_again(judged: JudgedPrograms) -> None:
    first, _ = judged.judged(PLACE)
    second = again(judged)
    cell, _ = second.judged(PLACE)
    assert cell == first
    assert pretender(second).calls == 0
    changed = again(judged, installed="pretender 2")
    changed.judged(PLACE)
    assert pretender(changed).calls == 1


@pytest.mark.clause("VER-13")
@pytest.mark.parametrize(("answer", "is_waived"), [(black, True), (truthful, False)])
def test_a_waiver_excuses_a_failure_or_is_told_to_match_nothing(
    answer: Callable[[Scene, Path], Rendering], is_waived: bool, judged: JudgedPrograms, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(waivers, "all_renderers", lambda: {"pretender": Pretender()})
    waiver = Waiver(
        renderer="pretender",
        version="pretender *",
        scene="small",
        integrator="whitted",
        most_failing_pixels=12,
        reason="It is out of paint.",
        link="https://example.org/paint",
    )
    judged.waivers = (waiver,)
    pretender(judged).answer = answer
    cell, unmatched = judged.judged(PLACE)
    assert (cell.waived is not None) == is_waived
    assert len(unmatched) == (not is_waived)


@pytest.mark.clause("RES-4")
def test_the_report_holds_what_was_judged_here_or_in_other_processes_and_nothing_else(judged: JudgedPrograms) -> None:
    judged.judged(PLACE)
    again(judged).write_report({PLACE})
    assert {cell.verdict for cell in load_results(judged.out).cells} == {Verdict.PASS}
    changed = again(judged, installed="pretender 2", answer=broken)
    changed.judged(PLACE)
    refusing = Pretender(name="refusing", refusal="it is tired")
    both = {**again(judged, installed="pretender 2").programs, "refusing": refusing}
    report = JudgedPrograms(both, judged.scenes, (), judged.out).write_report({PLACE})
    assert report.is_file()
    results = load_results(judged.out)
    assert [(cell.renderer, cell.scene, cell.verdict) for cell in results.cells] == [("pretender", "small", "error")]
    assert [scene.name for scene in results.scenes] == ["small"]
