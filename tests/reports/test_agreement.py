from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.records.image_files import write_image
from raytruth.comparisons.records.pixel_evidence import PixelEvidence, write_pixel_evidence
from raytruth.comparisons.records.results import (
    Cell,
    Images,
    Judgement,
    RendererRecord,
    Results,
    SceneRecord,
    WorstPixel,
)
from raytruth.reports.agreement import Agreement, agreement_on
from raytruth.reports.confirmation import confirming

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REP-7")

SIZE = (4, 6)
TRUTH = 0.5
TOLERANCE = 0.125
X, Y = 4, 2
FAMILIES = {"one": "one", "one-fast": "one", "two": "two", "three": "three", "raytruth": None}


def cell(folder: Path, renderer: str, value: float = TRUTH, *, noise: float = 0.0) -> Cell:
    """A cell whose image is this at one pixel, and the truth plus some noise elsewhere."""
    image = np.full((*SIZE, 3), TRUTH + noise, dtype=np.float32)
    image[Y, X] = value
    low = np.full((*SIZE, 1, 3), TRUTH - TOLERANCE, dtype=np.float32)
    high = low + np.float32(2 * TOLERANCE)
    place = f"cells/a/{renderer}-x"
    (folder / place).mkdir(parents=True)
    distances = np.abs(image - np.float32(TRUTH)) / np.float32(TOLERANCE)
    write_image(folder / place / "render.exr", image)
    write_image(folder / place / "tolerances.exr", distances)
    nearest = np.zeros(SIZE, dtype=np.int64)
    write_pixel_evidence(folder / place / "feasible.exr", PixelEvidence(low, high, nearest, nearest > 0, nearest < 0))
    failing = int((distances > 1).any(axis=2).sum())
    box = {"low": (TRUTH - TOLERANCE,) * 3, "high": (TRUTH + TOLERANCE,) * 3}
    worst = WorstPixel(x=X, y=Y, value=(value,) * 3, truth=(TRUTH,) * 3, **box, tolerances=float(distances.max()))
    return bare(
        renderer,
        "fail" if failing else "pass",
        judgement=Judgement(pixels=24, failing=failing, unjudged=0, capped=0, ambiguous=0, worst=worst),
        largest_error=float(np.abs(image - TRUTH).max()),
        images=Images(
            render=f"{place}/render.exr",
            truth="cells/a/truth.exr",
            tolerances=f"{place}/tolerances.exr",
            feasible=f"{place}/feasible.exr",
        ),
    )


def bare(renderer: str, verdict: str, scene: str = "a", **more: Any) -> Cell:
    names = {"scene": scene, "renderer": renderer, "integrator": "x", "command": "", "reason": "so it is"}
    return Cell.model_validate({**names, "verdict": verdict, **more})


def results(*cells: Cell) -> Results:
    scenes = [
        SceneRecord(name=name, purpose="", convention="whitted", width=6, height=4, features=(), light_paths="")
        for name in dict.fromkeys(["a", *(cell.scene for cell in cells)])
    ]
    renderers = [
        RendererRecord(name=name, version="1", install="", error_model="", integrators={}, family=family)
        for name, family in FAMILIES.items()
    ]
    return Results(
        raytruth_version="1",
        created="",
        command="",
        machine={},
        scenes=tuple(scenes),
        renderers=tuple(renderers),
        cells=cells,
    )


def agreement(folder: Path, *cells: Cell) -> Agreement:
    found = agreement_on(folder, results(*cells), "a")
    assert found is not None
    return found


def test_references_whose_values_are_feasible_agree(tmp_path: Path) -> None:
    found = agreement(tmp_path, cell(tmp_path, "one", noise=0.0625), cell(tmp_path, "two", noise=-0.0625))
    assert found.sentences == ("Both independent references agree with the truth: one and two.",)
    pair = found.pairs[0, 1]
    assert pair is not None
    assert (pair.agree, pair.largest, pair.pixels) == (True, 0.125, 0)
    assert [comparison.agree for comparison in found.with_truth] == [True, True]


def test_who_is_wrong_is_named_with_the_pixel_and_what_the_others_say(tmp_path: Path) -> None:
    found = agreement(tmp_path, cell(tmp_path, "one", 0.9375), cell(tmp_path, "two"), cell(tmp_path, "three"))
    assert found.sentences == (
        "2 of 3 independent references agree with the truth: three and two.",
        "one/x is wrong at 1 of 24 pixels, worst at (4, 2): it says (0.938, 0.938, 0.938), the truth is "
        "(0.5, 0.5, 0.5), two/x says (0.5, 0.5, 0.5), three/x says (0.5, 0.5, 0.5).",
    )
    agree = {places: pair and (pair.agree, pair.pixels) for places, pair in found.pairs.items()}
    assert agree == {(0, 1): (False, 1), (0, 2): (False, 1), (1, 2): (True, 0)}
    assert [(one.agree, one.pixels) for one in found.with_truth] == [(False, 1), (True, 0), (True, 0)]


def test_two_that_agree_against_the_truth_cast_doubt_on_it(tmp_path: Path) -> None:
    found = agreement(tmp_path, cell(tmp_path, "one", 0.9375), cell(tmp_path, "two", 0.75))
    assert found.sentences[0] == "No independent reference agrees with the truth here."
    assert found.sentences[1].endswith("the truth is (0.5, 0.5, 0.5). two/x says the same: look at the truth first.")
    apart = agreement(tmp_path, cell(tmp_path, "three", 0.125), bare("one", "fail"), cell(tmp_path, "one-fast", 0.9375))
    assert "look at the truth" not in "".join(apart.sentences)


def test_one_family_is_one_opinion_and_the_tracer_itself_none(tmp_path: Path) -> None:
    cells = [cell(tmp_path, "one"), cell(tmp_path, "one-fast"), cell(tmp_path, "raytruth")]
    assert agreement(tmp_path, *cells).sentences == ("One independent reference agrees with the truth: one.",)
    assert confirming(results(*cells)) == {"a": {"one": frozenset()}}
    assert agreement_on(tmp_path, results(cells[2]), "a") is None


def test_first_hits_are_an_opinion_without_an_image(tmp_path: Path) -> None:
    found = agreement(tmp_path, cell(tmp_path, "one"), bare("two", "pass"))
    assert found.pairs == {(0, 1): None}
    assert found.sentences == ("Both independent references agree with the truth: one and two (first hits only).",)
    failing = agreement(tmp_path, bare("one", "pass"), bare("two", "fail"))
    assert failing.sentences[1] == "two/x is wrong: so it is."


def test_a_file_that_is_missing_leaves_its_pairs_out(tmp_path: Path) -> None:
    cells = [cell(tmp_path, "one"), cell(tmp_path, "two")]
    (tmp_path / "cells/a/two-x/render.exr").unlink()
    assert agreement(tmp_path, *cells).pairs == {(0, 1): None}
