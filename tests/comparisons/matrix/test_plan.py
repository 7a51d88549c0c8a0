from __future__ import annotations

import pickle
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.matrix.plan import PlannedCell, plan_run
from raytruth.comparisons.matrix.whole_cells import CELL_FILE
from raytruth.comparisons.records.results import Cell, Verdict
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.scenes.library import open_scene
from tests.comparisons.matrix.cell_places import place_of
from tests.comparisons.matrix.pretending import Pretender
from tests.comparisons.matrix.runs import forget_version, opened, plan, ran
from tests.comparisons.matrix.scene_files import scene_file

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("RES-3")


@pytest.mark.clause("REN-5")
def test_what_is_not_installed_is_unavailable_with_how_to_install_it(pretender: Pretender, tmp_path: Path) -> None:
    pretender.installed = None
    planned = plan(pretender, [scene_file(tmp_path)], tmp_path / "out")
    assert planned.by_scene == {}
    (cell,) = planned.settled
    assert cell.verdict == Verdict.UNAVAILABLE
    assert "cannot be installed" in cell.reason


@pytest.mark.clause("REN-7")
@pytest.mark.parametrize(
    ("told", "is_known"),
    [
        ("pretender 3.9.1", True),
        ("pretender 3.9.12", True),
        ("pretender 3.9", False),
        ("pretender 3.10.0", False),
        ("pretender 13.9.1", False),
        ("another 3.9.1", False),
    ],
)
def test_a_version_that_the_error_model_was_not_derived_from_is_unavailable_in_words_that_name_both(
    told: str, is_known: bool, pretender: Pretender, tmp_path: Path
) -> None:
    pretender.installed, pretender.derived_for = told, "pretender 3.9.*"
    planned = plan(pretender, [scene_file(tmp_path)], tmp_path / "out")
    assert bool(planned.by_scene) == is_known
    assert [cell.verdict for cell in planned.settled] == ([] if is_known else [Verdict.UNAVAILABLE])
    for cell in planned.settled:
        assert f"{told} is installed" in cell.reason
        assert cell.reason.endswith("the source of pretender 3.9.*; install that")


@pytest.mark.clause("REN-7")
def test_each_version_is_judged_by_the_error_model_that_was_derived_from_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, pretender: Pretender
) -> None:
    old, new = (ErrorModel(name, precision_bits=51) for name in ("old", "new"))
    models = (("pretender 1.*", old), ("pretender 2.*", new))
    monkeypatch.setattr(Pretender, "error_models", models)
    for version, model in (("pretender 1.5", old), ("pretender 2.0", new)):
        pretender.installed = version
        ((planned,),) = plan(pretender, [scene_file(tmp_path)], tmp_path / "out", fresh=True).by_scene.values()
        assert planned.error_model == model


@pytest.mark.parametrize("name", all_renderers())
def test_what_is_planned_comes_out_of_another_process_as_it_was(name: str) -> None:
    renderer, scene = all_renderers()[name], open_scene("trefoil-knot")
    place = place_of(scene, renderer, renderer.integrators[0].name)
    sent = PlannedCell(place, 1, renderer.error_models[0][1])
    received = pickle.loads(pickle.dumps(sent))
    assert received.place.scene == sent.place.scene
    assert received.place.renderer.error_models == renderer.error_models
    assert vars(received.place.renderer) == vars(renderer)
    assert received.place.integrator == sent.place.integrator
    assert {sent.error_model: 1}[received.error_model] == 1  # cells of one error model are still one group


@pytest.mark.clause("VER-8")
def test_what_cannot_be_compared_is_settled_with_the_reason(pretender: Pretender, tmp_path: Path) -> None:
    pretender.refusal = "it has no taste for spheres"
    planned = plan(pretender, [scene_file(tmp_path)], tmp_path / "out")
    assert planned.by_scene == {}
    assert [(cell.verdict, cell.reason) for cell in planned.settled] == [
        (Verdict.INCOMPARABLE, "it has no taste for spheres")
    ]


def test_where_nothing_is_to_render_no_renderer_is_tried(pretender: Pretender, tmp_path: Path) -> None:
    source, out = scene_file(tmp_path), tmp_path / "out"
    ran(pretender, [source], out)
    assert pretender.trials == 1
    assert plan(pretender, [source], out).versions == {"pretender": "pretender 1"}
    assert pretender.trials == 1
    forget_version(tmp_path)
    assert plan(pretender, [source], out).by_scene == {}
    assert pretender.trials == 2


def test_before_anything_is_rendered_the_renderer_is_tried_again(pretender: Pretender, tmp_path: Path) -> None:
    source, out = scene_file(tmp_path), tmp_path / "out"
    ran(pretender, [source], out)
    pretender.installed = None
    more = plan(pretender, [source, scene_file(tmp_path, "more")], out)
    assert more.versions == {"pretender": None}
    assert {cell.verdict for cell in more.settled} == {Verdict.UNAVAILABLE}
    assert more.by_scene == {}


def test_a_renderer_that_has_nothing_left_to_render_is_not_tried_again(pretender: Pretender, tmp_path: Path) -> None:
    source, out, other = scene_file(tmp_path), tmp_path / "out", Pretender(name="other")
    ran(pretender, [source], out)
    planned = plan_run(opened([source]), [pretender, other], out, fresh=False)
    assert [cell.place.renderer.name for cell in planned.cells] == ["other"]
    assert (pretender.trials, other.trials) == (1, 1)


def test_fresh_tries_again(pretender: Pretender, tmp_path: Path) -> None:
    source, out = scene_file(tmp_path), tmp_path / "out"
    ran(pretender, [source], out)
    pretender.installed = None
    assert plan(pretender, [source], out, fresh=True).versions == {"pretender": None}


@pytest.mark.parametrize("text", ["", "{", "[]", '{"scene": "small"}', "null"])
def test_a_broken_cell_of_an_earlier_run_is_ignored(text: str, pretender: Pretender, tmp_path: Path) -> None:
    source, out = scene_file(tmp_path), tmp_path / "out"
    ran(pretender, [source], out)
    path = out / "cells/small/pretender-whitted" / CELL_FILE
    path.write_text(text)
    assert ran(pretender, [source], out)[0].verdict == Verdict.PASS
    assert pretender.calls == 2
    assert Cell.model_validate_json(path.read_text()).verdict == Verdict.PASS
