from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import jsonschema
import numpy as np
import pytest

from raytruth.comparisons.matrix import results_directory
from raytruth.comparisons.matrix.results_directory import with_metrics, write_results
from raytruth.comparisons.matrix.whole_cells import CELL_FILE
from raytruth.comparisons.records.image_files import write_image
from raytruth.comparisons.records.results import (
    RESULTS_FILE,
    Cell,
    Images,
    Judgement,
    Metrics,
    Results,
    Verdict,
    WorstPixel,
)
from tests.comparisons.matrix.pretending import Pretender
from tests.reference_tracer.small_scenes import small_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("RES-1")


def cell(scene: str, renderer: str = "pretender", verdict: Verdict = Verdict.PASS, **more: Any) -> Cell:
    return Cell(scene=scene, renderer=renderer, integrator="whitted", verdict=verdict, reason="", command="", **more)


def scene(name: str, purpose: str = "A test.") -> Scene:
    return small_scene(name=name, purpose=purpose)


def written(folder: Path, cells: list[Cell], scenes: list[Scene], **pretender: Any) -> Results:
    renderers = [Pretender(name=name, **pretender) for name in dict.fromkeys(cell.renderer for cell in cells)]
    return write_results(folder, "raytruth run", scenes, [(it, it.installed) for it in renderers], cells)


def read(folder: Path) -> Results:
    return Results.model_validate_json((folder / RESULTS_FILE).read_text(encoding="utf-8"))


def test_what_is_written_can_be_read_and_follows_the_schema(tmp_path: Path) -> None:
    results = written(tmp_path, [cell("a")], [scene("a")])
    assert read(tmp_path) == results
    assert results.schema_version == 1
    document = (tmp_path / RESULTS_FILE).read_text(encoding="utf-8")
    schema = Results.model_json_schema(mode="serialization")
    jsonschema.validate(json.loads(document), schema)
    (record,) = results.scenes
    assert (record.name, record.width, record.light_paths) == ("a", 1, "ES{0,0}(DL|e)")
    (renderer,) = results.renderers
    assert renderer.integrators == {"whitted": "ES{0,n}(DL|e)"}
    assert (renderer.version, renderer.install) == ("pretender 1", "cannot be installed")


def test_what_is_no_number_survives(tmp_path: Path) -> None:
    worst = WorstPixel(
        x=0,
        y=0,
        value=(math.nan, math.inf, -math.inf),
        truth=(0,) * 3,
        low=(math.nan,) * 3,
        high=(1,) * 3,
        tolerances=math.inf,
    )
    judgement = Judgement(pixels=1, failing=1, unjudged=0, capped=0, ambiguous=0, worst=worst)
    written(tmp_path, [cell("a", verdict=Verdict.FAIL, judgement=judgement, largest_error=math.nan)], [scene("a")])
    (back,) = read(tmp_path).cells
    assert back.largest_error is not None
    assert math.isnan(back.largest_error)
    assert back.judgement is not None
    assert back.judgement.worst is not None
    assert math.isnan(back.judgement.worst.value[0])
    assert back.judgement.worst.value[1:] == (math.inf, -math.inf)
    assert back.judgement.worst.tolerances == math.inf
    # No NaN or Infinity outside strings, which JSON does not know.
    json.loads((tmp_path / RESULTS_FILE).read_text(), parse_constant=pytest.fail)


@pytest.mark.clause("RES-4")
def test_results_of_partial_runs_merge(tmp_path: Path) -> None:
    written(tmp_path, [cell("a"), cell("c")], [scene("a", "Old."), scene("c")], installed="pretender 1")
    written(
        tmp_path,
        [cell("b"), cell("a", verdict=Verdict.FAIL)],
        [scene("b"), scene("a", "New.")],
        installed="pretender 2",
    )
    results = read(tmp_path)
    assert [(c.scene, c.verdict) for c in results.cells] == [
        ("a", Verdict.FAIL),
        ("b", Verdict.PASS),
        ("c", Verdict.PASS),
    ]
    assert sorted((s.name, s.purpose) for s in results.scenes) == [("a", "New."), ("b", "A test."), ("c", "A test.")]
    assert [r.version for r in results.renderers] == ["pretender 2"]


@pytest.mark.clause("RES-4")
def test_cells_of_other_renderers_stay(tmp_path: Path) -> None:
    written(tmp_path, [cell("a", "one"), cell("a", "two")], [scene("a")])
    written(tmp_path, [cell("a", "two", Verdict.FAIL)], [scene("a")])
    assert {c.renderer: c.verdict for c in read(tmp_path).cells} == {"one": Verdict.PASS, "two": Verdict.FAIL}


def test_what_changes_nothing_leaves_the_file_as_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In whatever order the cells were finished, which differs between a run that renders and one that finds them."""
    cells = [cell(scene, renderer) for scene in "ab" for renderer in ("one", "two", "three")]
    first = written(tmp_path, cells, [scene("a"), scene("b")])
    monkeypatch.setattr(results_directory, "write_whole", pytest.fail)
    assert written(tmp_path, cells[::-1], [scene("a"), scene("b")]) == first


def test_an_earlier_file_that_is_broken_or_of_another_version_is_replaced(tmp_path: Path) -> None:
    written(tmp_path, [cell("a")], [scene("a")])
    valid = (tmp_path / RESULTS_FILE).read_text(encoding="utf-8")
    newer = valid.replace('"schema_version": 1', '"schema_version": 2')
    assert newer != valid
    for text in ("", "{", valid[:-9], newer, '{"schema_version": 1}'):
        (tmp_path / RESULTS_FILE).write_text(text, encoding="utf-8")
        written(tmp_path, [cell("b")], [scene("b")])
        assert [c.scene for c in read(tmp_path).cells] == ["b"], text[:30]


@pytest.mark.clause("RES-2")
def with_images(folder: Path, name: str, offset: float) -> Cell:
    """A cell whose image is off by this much everywhere."""
    cells = folder / "cells" / name / "pretender-whitted"
    cells.mkdir(parents=True)
    truth = (np.arange(16 * 16 * 3, dtype=np.float32) / np.float32(1024)).reshape(
        16, 16, 3
    )  # exact, with the offset, too
    write_image(folder / f"cells/{name}/truth.exr", truth)
    write_image(cells / "render.exr", truth + np.float32(offset))
    images = Images(
        render=f"cells/{name}/pretender-whitted/render.exr",
        truth=f"cells/{name}/truth.exr",
        tolerances=f"cells/{name}/pretender-whitted/tolerances.exr",
        feasible=f"cells/{name}/pretender-whitted/feasible.exr",
    )
    return cell(name, images=images)


def test_metrics_are_filled_in_and_kept_with_the_cell(tmp_path: Path) -> None:
    lost = cell("lost", images=Images(render="no.exr", truth="no.exr", tolerances="no.exr", feasible="no.exr"))
    cells = [
        with_images(tmp_path, "same", 0.0),
        cell("error", verdict=Verdict.ERROR),
        lost,
        with_images(tmp_path, "off", 0.125),
    ]
    measured = with_metrics(tmp_path, cells)
    assert [c.scene for c in measured] == ["same", "error", "lost", "off"]
    same, error, missing, off = (c.metrics for c in measured)
    assert error is None
    assert missing is None
    assert same is not None
    assert same.largest_difference == 0
    assert off is not None
    assert off.largest_difference == 0.125
    assert off.mean_difference == 0.125
    for c in (measured[0], measured[3]):
        kept = tmp_path / f"cells/{c.scene}/pretender-whitted" / CELL_FILE
        assert Cell.model_validate_json(kept.read_text()) == c


def test_metrics_that_are_there_are_not_computed_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    done = with_images(tmp_path, "done", 0.125).model_copy(update={"metrics": Metrics(rmse=7.0)})
    asked: list[object] = []

    def compute(pairs: list[object]) -> list[Metrics]:
        asked.extend(pairs)
        return [Metrics() for _ in pairs]

    monkeypatch.setattr(results_directory, "compute_metrics_batch", compute)
    assert with_metrics(tmp_path, [done]) == [done]
    assert asked == []
