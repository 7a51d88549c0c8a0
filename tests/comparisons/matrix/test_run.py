from __future__ import annotations

from collections.abc import Generator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.feasible_sets import kept_feasible_sets
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.matrix import cell_key, run
from raytruth.comparisons.matrix.plan import plan_run
from raytruth.comparisons.matrix.run import run_plan
from raytruth.comparisons.matrix.whole_cells import CELL_FILE
from raytruth.comparisons.records.image_files import read_image
from raytruth.comparisons.records.renderings import Rays, RendererError, Rendering
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.closed_form.adapter import ClosedFormRenderer
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.light_paths import WHITTED
from tests.comparisons.matrix.pretending import Pretender, truthful
from tests.comparisons.matrix.runs import forget_version, opened, plan, ran
from tests.comparisons.matrix.scene_files import scene_file

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("RES-3")

FIRST_HITS = (Integrator("first-hits", "E", gives="first hits"),)


def test_a_scene_is_rendered_judged_and_its_truth_written(pretender: Pretender, tmp_path: Path) -> None:
    source = scene_file(tmp_path)
    (cell,) = ran(pretender, [source], tmp_path / "out")
    assert (cell.scene, cell.renderer, cell.integrator, cell.verdict) == ("small", "pretender", "whitted", Verdict.PASS)
    assert cell.images is not None
    assert read_image(tmp_path / "out" / cell.images.truth).shape == (3, 4, 3)
    assert source in cell.command
    assert pretender.calls == 1


def test_a_second_run_has_nothing_to_do_and_tells_the_same(pretender: Pretender, tmp_path: Path) -> None:
    source, out = scene_file(tmp_path), tmp_path / "out"
    first = ran(pretender, [source], out)
    assert plan(pretender, [source], out).by_scene == {}
    assert ran(pretender, [source], out) == first
    assert pretender.calls == 1


def test_fresh_renders_again(pretender: Pretender, tmp_path: Path) -> None:
    source, out = scene_file(tmp_path), tmp_path / "out"
    ran(pretender, [source], out)
    ran(pretender, [source], out, fresh=True)
    assert pretender.calls == 2


def test_another_version_or_scene_or_code_of_ours_is_rendered_again(
    pretender: Pretender, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source, out = scene_file(tmp_path), tmp_path / "out"
    ran(pretender, [source], out)
    pretender.installed = "pretender 2"
    forget_version(tmp_path)
    assert ran(pretender, [source], out)[0].version == "pretender 2"
    assert pretender.calls == 2
    scene_file(tmp_path, materials={"m": {"diffuse": {"reflectance": [1, 0.5, 0.5]}}})
    ran(pretender, [source], out)
    assert pretender.calls == 3
    monkeypatch.setattr(cell_key, "source_digest", lambda *_, **__: "another")
    ran(pretender, [source], out)
    assert pretender.calls == 4
    ran(pretender, [source], out)
    assert pretender.calls == 4


def test_an_error_is_tried_again_and_a_failure_is_not(pretender: Pretender, tmp_path: Path) -> None:
    def failing(_scene: Scene, _folder: Path) -> Rendering:
        raise RendererError("the machine was busy")

    def black(scene: Scene, folder: Path) -> Rendering:
        rendering = truthful(scene, folder)
        rendering.image[...] = 0
        return rendering

    source, out = scene_file(tmp_path), tmp_path / "out"
    for answer, verdict in [(failing, Verdict.ERROR), (black, Verdict.FAIL), (truthful, Verdict.FAIL)]:
        pretender.answer = answer
        assert ran(pretender, [source], out)[0].verdict == verdict
    assert pretender.calls == 2


def test_a_scene_in_which_we_fail_ourselves_is_an_error_and_the_others_go_on(
    pretender: Pretender, tmp_path: Path
) -> None:
    def sometimes(scene: Scene, folder: Path) -> Rendering:
        if scene.name == "bad":
            raise ZeroDivisionError("float division by zero")
        return truthful(scene, folder)

    pretender.answer = sometimes
    sources = [scene_file(tmp_path, name) for name in ("bad", "good", "better")]
    out = tmp_path / "out"
    cells = {cell.scene: cell for cell in ran(pretender, sources, out)}
    assert {name: cell.verdict for name, cell in cells.items()} == {
        "bad": Verdict.ERROR,
        "good": Verdict.PASS,
        "better": Verdict.PASS,
    }
    assert "ZeroDivisionError: float division by zero" in cells["bad"].reason
    assert not (out / cells["bad"].scene / CELL_FILE).exists()
    assert set(plan(pretender, sources, out).by_scene) == {sources[0]}


def test_when_the_caller_stops_what_is_finished_stays(pretender: Pretender, tmp_path: Path) -> None:
    sources = [scene_file(tmp_path, name) for name in "abcdef"]
    out = tmp_path / "out"
    cells = run_plan(plan(pretender, sources, out), out, jobs=1)
    first = next(cells)
    assert isinstance(cells, Generator)
    cells.close()
    assert pretender.calls < len(sources)
    left = plan(pretender, sources, out)
    assert first in left.settled
    assert len(left.settled) == pretender.calls
    assert len(left.by_scene) == len(sources) - pretender.calls
    assert len(ran(pretender, sources, out)) == len(sources)
    assert pretender.calls == len(sources)


def image_and_first_hits(scene: Scene, folder: Path) -> Rendering:
    return replace(truthful(scene, folder), first_hits=first_hits(scene, folder).first_hits)


def first_hits(scene: Scene, folder: Path) -> Rendering:
    exact = ClosedFormRenderer().render(scene, "local", 0, Rays(*primary_rays(scene)), folder)
    return Rendering(None, 0.5, exact.first_hits)


def test_the_feasible_set_is_made_once_for_renderers_of_one_error_model(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = []

    def recorded(scene: Scene, model: ErrorModel, **options: bool) -> FeasibleSet:
        made.append((model, options))
        return feasible_set(scene, model, **options)

    monkeypatch.setattr(kept_feasible_sets, "feasible_set", recorded)
    monkeypatch.setattr(kept_feasible_sets, "cache_folder", lambda: tmp_path / "cache")
    other, third = (ErrorModel("float32", precision_bits=bits) for bits in (24, 23))
    both = (Integrator("whitted", WHITTED, has_depth=True, gives="image and first hits"),)
    renderers = [
        Pretender(name="one", integrators=both, answer=image_and_first_hits),
        Pretender(name="two", error_model=other, integrators=FIRST_HITS, answer=first_hits),
        Pretender(name="three"),
        Pretender(name="four", error_model=third, integrators=both, answer=image_and_first_hits),
    ]
    monkeypatch.setattr(run, "ProcessPoolExecutor", lambda jobs, *_: ThreadPoolExecutor(jobs))
    planned = plan_run(opened([scene_file(tmp_path)]), renderers, tmp_path, fresh=False)
    cells = list(run_plan(planned, tmp_path, jobs=1))
    assert [(cell.renderer, cell.verdict) for cell in cells] == [
        ("two", Verdict.PASS),
        ("four", Verdict.PASS),
        ("one", Verdict.PASS),
        ("three", Verdict.PASS),
    ]
    # Where only first hits are given, no colours are worked out.
    assert [(model.precision_bits, options["with_colors"]) for model, options in made] == [
        (24, False),
        (23, True),
        (51, True),
    ]


def test_scenes_run_in_processes_of_their_own(tmp_path: Path) -> None:
    sources = [scene_file(tmp_path, name) for name in ("one", "two")]
    out = tmp_path / "out"
    planned = plan_run(opened(sources), [ClosedFormRenderer()], out, fresh=False)
    cells = list(run_plan(planned, out, jobs=2))
    assert sorted((cell.scene, cell.verdict) for cell in cells) == [("one", Verdict.PASS), ("two", Verdict.PASS)]
