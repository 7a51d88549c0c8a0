from __future__ import annotations

import json
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth import run_command
from raytruth.comparisons.matrix import estimate, waivers
from raytruth.comparisons.matrix import run as matrix_run
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.records.results import RESULTS_FILE, Cell, Results, Verdict
from raytruth.comparisons.renderers import catalogue
from tests.comparisons.matrix.pretending import Pretender, truthful
from tests.comparisons.matrix.scene_files import scene_file
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rendering
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("CMD-1", "CMD-2", "CMD-4")

WIDTH, HEIGHT = 16, 12


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working directory, with a tiny scene in it; scenes are rendered in this process."""
    monkeypatch.setattr(matrix_run, "ProcessPoolExecutor", lambda jobs, *_: ThreadPoolExecutor(jobs))
    # How long tiny scenes take tells nothing of others.
    monkeypatch.setattr(estimate, "cache_folder", lambda: tmp_path / "cache")
    monkeypatch.chdir(tmp_path)
    scene_file(tmp_path, width=WIDTH, height=HEIGHT)
    return tmp_path


@pytest.fixture
def pretender(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Pretender:  # noqa: ARG001 - its working directory is needed
    """One renderer that is here, and one that is not."""
    renderer = Pretender()
    known = {"pretender": renderer, "ghost": Pretender(name="ghost", installed=None, install="pip install ghost")}
    monkeypatch.setattr(catalogue, "all_renderers", lambda: known)
    # The waivers that raytruth has itself are of other renderers.
    every = waivers.all_renderers() | known
    monkeypatch.setattr(waivers, "all_renderers", lambda: every)
    # Global metrics are measured in the tests of closed_form; each process that measures them takes a second to start.
    monkeypatch.setattr(run_command, "with_metrics", lambda _out, cells: cells)
    return renderer


def black(scene: Scene, folder: Path) -> Rendering:
    rendering = truthful(scene, folder)
    rendering.image[...] = 0
    return rendering


def broken(_scene: Scene, _folder: Path) -> Rendering:
    raise RendererError("it ended with signal 11")


def results_in(directory: Path) -> Results:
    return Results.model_validate_json((directory / RESULTS_FILE).read_text(encoding="utf-8"))


def test_a_run_whose_cells_all_pass_ends_with_0_and_a_report(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, "run", "small.json", "--renderer", "closed_form")
    assert status == 0
    assert "small" in out
    assert "[1/1] small closed_form local: pass" in err
    assert [cell.verdict for cell in results_in(folder / "results").cells] == ["pass"]
    assert list((folder / "results").glob("*.html"))


@pytest.mark.clause("REP-9")
def test_a_run_writes_junit_xml_and_a_summary(
    pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pretender.answer = black
    options = ("--junit", "junit.xml", "--summary", "summary.md")
    assert run(capsys, "run", "small.json", "--renderer", "pretender", *options)[0] == 1
    assert 'failures="1"' in (folder / "junit.xml").read_text(encoding="utf-8")
    assert "| ✗ fail | small | pretender/whitted |" in (folder / "summary.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(("answer", "verdict"), [(black, "fail"), (broken, "error")])
def test_a_cell_that_fails_or_errs_gives_1(
    answer: Any, verdict: str, pretender: Pretender, capsys: pytest.CaptureFixture[str]
) -> None:
    pretender.answer = answer
    status, out, err = run(capsys, "run", "small.json", "--renderer", "pretender")
    assert status == 1
    assert verdict in err
    assert "Traceback" not in out + err


def test_a_failure_is_not_forgotten_by_the_next_run(pretender: Pretender, capsys: pytest.CaptureFixture[str]) -> None:
    pretender.answer = black
    for _ in range(2):
        assert run(capsys, "run", "small.json", "--renderer", "pretender")[0] == 1
    assert pretender.calls == 1
    pretender.answer = truthful
    assert run(capsys, "run", "small.json", "--renderer", "pretender", "--fresh")[0] == 0


def waiver_file(folder: Path, **changes: Any) -> str:
    """A waiver of what the pretender does when it answers in black."""
    waiver = {
        "renderer": "pretender",
        "version": "pretender *",
        "scene": "small",
        "integrator": "whitted",
        "most_failing_pixels": WIDTH * HEIGHT,
        "reason": "It is out of paint.",
        "link": "https://example.org/paint",
    }
    path = folder / "waivers.json"
    path.write_text(json.dumps([waiver | changes]), encoding="utf-8")
    return str(path)


def test_a_waived_failure_gives_0_and_is_told_apart(
    pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pretender.answer = black
    for _ in range(2):  # the second run takes the cell over, and its waiver with it only if that is given again
        status, out, _ = run(capsys, "run", "small.json", "--renderer", "pretender", "--waivers", waiver_file(folder))
        assert status == 0
        assert "1 cell: 0 passed, 0 as declared, not as due, 0 failed, 1 failed as waived" in out
        (cell,) = results_in(folder / "results").cells
        assert cell.verdict == "fail"
        assert cell.waived is not None
        assert cell.waived.reason == "It is out of paint."
    assert run(capsys, "run", "small.json", "--renderer", "pretender")[0] == 1
    assert pretender.calls == 1


def test_a_waiver_that_matches_nothing_gives_1(
    pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert pretender.answer is truthful
    waivers = waiver_file(folder)
    status, _, err = run(capsys, "run", "small.json", "--renderer", "pretender", "--waivers", waivers)
    assert status == 1
    assert "The waiver of pretender/whitted on small matches nothing, since the verdict is pass: remove it." in err
    waivers = waiver_file(folder, scene="large")
    assert run(capsys, "run", "small.json", "--renderer", "pretender", "--waivers", waivers)[0] == 0


@pytest.mark.parametrize("changes", [{"renderer": "pretence"}, {"most_failing_pixels": "all"}])
def test_a_bad_file_of_waivers_is_one_sentence_before_any_work(
    changes: dict[str, Any], pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    told = refusal(capsys, "run", "small.json", "--waivers", waiver_file(folder, **changes))
    assert f"{folder / 'waivers.json'}: [0].{next(iter(changes))}: " in told
    assert pretender.calls == 0


def test_what_is_unavailable_or_incomparable_is_shown_and_fails_nothing(
    pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pretender.refusal = "it has no taste for spheres"
    assert run(capsys, "run", "small.json")[0] == 0
    assert {cell.renderer: cell.verdict for cell in results_in(folder / "results").cells} == {
        "pretender": "incomparable",
        "ghost": "unavailable",
    }


def test_a_required_renderer_that_is_missing_gives_1_and_says_how_to_install_it(
    pretender: Pretender, capsys: pytest.CaptureFixture[str]
) -> None:
    status, _, err = run(capsys, "run", "small.json", "--renderer", "pretender", "--require", "ghost")
    assert status == 1
    assert "raytruth: ghost is required and not installed: pip install ghost" in err
    assert pretender.calls == 1
    status, _, err = run(capsys, "run", "small.json", "--require", "pretender")
    assert status == 0
    assert "required" not in err


@pytest.mark.clause("REN-7")
def test_a_required_renderer_of_another_version_than_its_error_model_gives_1(
    pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pretender.derived_for = "pretender 0.*"
    for arguments, status in [((), 0), (("--require", "pretender"), 1)]:
        told = run(capsys, "run", "small.json", "--renderer", "pretender", *arguments)
        assert told[0] == status
        assert ("pretender is required and not judged in this version: pretender 1 is installed" in told[2]) == status
    assert pretender.calls == 0
    assert {cell.verdict for cell in results_in(folder / "results").cells} == {"unavailable"}


def test_names_of_renderers_may_be_separated_by_commas(
    pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(capsys, "run", "small.json", "--renderer", "pretender, ghost", "--out", "there")[0] == 0
    assert {cell.renderer for cell in results_in(folder / "there").cells} == {pretender.name, "ghost"}


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["--renderer", "mitsuva"], "There is no renderer 'mitsuva': did you mean 'mitsuba'"),
        (["--require", "povary"], "There is no renderer 'povary'"),
        (["singel-sphere"], "did you mean 'single-sphere'"),
        (["missing.json"], "missing.json"),
        (["small.json", "elsewhere/small.json"], "two scenes called 'small'"),
        (["small.json", "small.json"], "two scenes called 'small'"),
        (["--jobs", "0"], "--jobs: expected 1 or more, found 0"),
        (["--jobs", "-3"], "--jobs: expected 1 or more, found -3"),
        (["--jobs", "many"], "into int"),
        (["--nonsense"], "--nonsense"),
    ],
)
def test_bad_usage_is_one_sentence_before_any_work(
    arguments: list[str], expected: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene_file(folder / "elsewhere")
    assert expected in refusal(capsys, "run", *arguments)
    assert not (folder / "results").exists()


def test_a_file_in_the_place_of_the_results_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "results").write_text("mine")
    status, _, err = run(capsys, "run", "small.json", "--renderer", "closed_form")
    assert status != 0
    assert "Traceback" not in err
    assert (folder / "results").read_text() == "mine"


@pytest.mark.clause("CMD-3")
def test_json_is_one_document_that_follows_the_format(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    told = document(capsys, "run", "small.json", "--renderer", "closed_form")
    assert next(iter(told)) == "schema_version"
    assert told["schema_version"] == 1
    (cell,) = told["cells"]
    assert (cell["scene"], cell["renderer"], cell["integrator"], cell["verdict"]) == (
        "small",
        "closed_form",
        "local",
        "pass",
    )
    assert cell["metrics"]["rmse"] is not None
    assert Results.model_validate(told) == results_in(folder / "results")


def test_json_of_an_infinite_error_is_still_json(pretender: Pretender, capsys: pytest.CaptureFixture[str]) -> None:
    def nothing(scene: Scene, folder: Path) -> Rendering:
        rendering = truthful(scene, folder)
        rendering.image[...] = np.inf
        return rendering

    pretender.answer = nothing
    status, out, _ = run(capsys, "run", "small.json", "--renderer", "pretender", "--json")
    assert status == 1
    (cell,) = json.loads(out, parse_constant=pytest.fail)["cells"]
    assert cell["largest_error"] == "Infinity"


@pytest.mark.clause("RES-4")
def test_runs_into_one_directory_add_up(pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene_file(folder, "other")
    for scene in ("small.json", "other.json"):
        assert run(capsys, "run", scene, "--renderer", "pretender")[0] == 0
    assert [cell.scene for cell in results_in(folder / "results").cells] == ["other", "small"]
    assert pretender.calls == 2


@pytest.mark.clause("RES-3")
def test_an_interrupted_run_can_be_resumed(
    pretender: Pretender, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = ("a", "b", "c")
    sources = [scene_file(folder, name) for name in names]
    assert run(capsys, "run", sources[0], "--renderer", "pretender")[0] == 0
    before = results_in(folder / "results")

    def interrupted(scene: Scene, folder: Path) -> Rendering:
        ident = threading.main_thread().ident
        assert ident is not None
        signal.pthread_kill(ident, signal.SIGINT)  # as Ctrl-C does
        # Until the main thread has heard of it where it waits: elsewhere, as in a callback, Python may drop it.
        time.sleep(0.2)
        return truthful(scene, folder)

    pretender.answer = interrupted
    status, out, err = run(capsys, "run", *sources, "--renderer", "pretender", "--jobs", "1")
    assert status == 130
    assert "interrupted" in err
    assert "Traceback" not in out + err
    # What was there is still valid, what was begun is finished, and nothing else is left.
    kept = {path.parent.parent.name for path in (folder / "results").rglob("cell.json")}
    assert {"a", "b"} <= kept
    cells = {cell.scene: cell for cell in results_in(folder / "results").cells}
    assert set(cells) == kept
    assert cells["a"] == before.cells[0]
    assert not list((folder / "results").rglob(".*"))
    pretender.answer = truthful
    assert run(capsys, "run", *sources, "--renderer", "pretender")[0] == 0
    assert pretender.calls == len(names)  # each scene was rendered once in all three runs
    assert [cell.scene for cell in results_in(folder / "results").cells] == list(names)


@pytest.mark.clause("VER-14")
@pytest.mark.parametrize(("strict", "status"), [(False, 0), (True, 1)])
def test_a_cell_that_is_as_declared_fails_a_strict_run_only(strict: bool, status: int) -> None:
    cell = Cell(scene="a", renderer="b", integrator="c", verdict=Verdict.DECLARED, reason="by its offset", command="")
    assert run_command._status([cell], {}, [], strict=strict) == status


@pytest.mark.usefixtures("pretender")
def test_families_are_scenes_that_a_seed_draws_and_repeats(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ("run", "--families", "3", "--renderer", "pretender")
    assert run(capsys, *arguments, "--seed", "5", "--out", "five")[0] == 0
    assert run(capsys, *arguments, "--seed", "5", "--out", "again")[0] == 0
    assert run(capsys, *arguments, "--out", "other")[0] == 0
    drawn = {out: [cell.scene for cell in results_in(folder / out).cells] for out in ("five", "again", "other")}
    assert len(set(drawn["five"])) == 3
    assert drawn["five"] == drawn["again"] != drawn["other"]
    texts = [(folder / out / "drawn-scenes" / f"{drawn['five'][0]}.json").read_text() for out in ("five", "again")]
    assert texts[0] == texts[1]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["--families", "0"], "expected 1 scene or more"),
        (["--families", "3", "small.json"], "expected neither scenes nor --quick"),
        (["--families", "3", "--quick"], "expected neither scenes nor --quick"),
        (["--seed", "3"], "expected --families beside it"),
    ],
)
def test_ways_to_name_scenes_that_exclude_one_another_are_refused(
    arguments: list[str], expected: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert expected in refusal(capsys, "run", *arguments)
    assert not (folder / "results").exists()
