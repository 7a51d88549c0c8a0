"""Scenes from outside the library on which verdicts were once wrong, each for a kind of trouble.

What is right on them was found apart from this project, in sixty digits, from the specification.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.matrix.plan import plan_run
from raytruth.comparisons.matrix.run import run_plan
from raytruth.comparisons.records.image_files import read_image
from raytruth.comparisons.records.pixel_evidence import read_pixel_evidence
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.catalogue import select_renderers
from raytruth.scenes.loading import load_scene

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import Cell

pytestmark = pytest.mark.clause("VER-14")

SCENES = Path(__file__).with_name("outside")


def judged(name: str, renderers: list[str], folder: Path) -> dict[tuple[str, str], Cell]:
    """The cells of a scene that can be compared, by renderer and integrator."""
    scene = load_scene(SCENES / f"{name}.json")
    plan = plan_run({name: scene}, list(select_renderers(renderers).values()), folder, fresh=True)
    cells = [*plan.settled, *run_plan(plan, folder, 1)]
    return {
        (c.renderer, c.integrator): c for c in cells if c.verdict not in {Verdict.INCOMPARABLE, Verdict.UNAVAILABLE}
    }


def test_a_shadow_that_an_offset_steps_over_is_as_declared_and_no_pass(tmp_path: Path) -> None:
    cells = judged("shadow-within-an-offset", ["mitsuba", "povray", "raytruth"], tmp_path)
    truth = read_image(tmp_path / "cells" / "shadow-within-an-offset" / "truth.exr")
    assert (truth == 0).all()
    for integrator in ("direct", "path"):
        cell = cells["mitsuba", integrator]
        assert cell.verdict == Verdict.DECLARED, cell.reason
        assert cell.judgement is not None
        assert cell.judgement.declared is not None
        assert cell.judgement.declared.count == 12
        assert cell.largest_error == pytest.approx(cell.judgement.declared.largest_difference)
    assert cells["povray", "whitted"].verdict == cells["raytruth", "whitted"].verdict == Verdict.PASS


def test_a_box_smaller_than_an_offset_is_as_declared_where_it_is_too_bright(tmp_path: Path) -> None:
    cells = judged("box-smaller-than-an-offset", ["embree", "mitsuba", "raytruth"], tmp_path)
    for renderer in ("embree", "mitsuba"):
        cell = cells[renderer, "direct"]
        assert cell.verdict == Verdict.DECLARED, cell.reason
        assert cell.judgement is not None
        assert cell.judgement.declared is not None
        assert (20, 16) in cell.judgement.declared.pixels
    assert cells["raytruth", "whitted"].verdict == Verdict.PASS
    truth = read_image(tmp_path / "cells" / "box-smaller-than-an-offset" / "truth.exr")
    assert (truth[16, 20] == 0).all()


def test_glass_that_an_offset_makes_black_confirms_nothing(tmp_path: Path) -> None:
    cells = judged("glass-smaller-than-an-offset", ["mitsuba", "povray"], tmp_path)
    cell = cells["mitsuba", "path"]
    assert cell.verdict == Verdict.DECLARED, cell.reason
    assert "8.9 times the radius of the smallest sphere" in cell.reason
    assert cells["povray", "whitted"].verdict == Verdict.PASS


@pytest.mark.clause("VER-2")
def test_a_camera_on_a_sphere_may_see_what_the_truth_is(tmp_path: Path) -> None:
    cells = judged("camera-on-a-sphere", ["povray", "raytruth"], tmp_path)
    assert cells["raytruth", "whitted"].verdict == Verdict.PASS
    cell = cells["povray", "whitted"]
    assert cell.verdict == Verdict.PASS, cell.reason
    assert cell.images is not None
    assert cell.judgement is not None
    image, truth = (read_image(tmp_path / path) for path in (cell.images.render, cell.images.truth))
    # Whether the camera is within the sphere or without, POV-Ray's numbers cannot tell: both sides are due to it.
    other_side = int((np.abs(image - truth) > 0.1).any(axis=2).sum())
    assert cell.judgement.ambiguous >= other_side
    evidence = read_pixel_evidence(tmp_path / cell.images.feasible)
    inside = (evidence.low <= truth[:, :, np.newaxis]) & (truth[:, :, np.newaxis] <= evidence.high)
    assert inside.all(axis=3).any(axis=2).all()


@pytest.mark.clause("VER-2", "SHAD-1")
def test_a_light_at_a_corner_of_a_box_leaves_light_or_shadow_and_not_everything_open(tmp_path: Path) -> None:
    cells = judged("../../extremes/tie_scenes/light-at-the-corner-of-a-box", ["embree", "povray", "raytruth"], tmp_path)
    for name in (("embree", "direct"), ("povray", "whitted"), ("raytruth", "whitted")):
        cell = cells[name]
        assert cell.verdict == Verdict.PASS, cell.reason
        assert cell.judgement is not None
        assert cell.judgement.unjudged == 0


@pytest.mark.clause("VER-4")
def test_first_hits_of_which_nearly_all_are_left_open_are_told_and_do_not_pass(tmp_path: Path) -> None:
    cells = judged("slivers-seen-edge-on", ["vtk", "raytruth"], tmp_path)
    assert ("vtk", "first-hits") not in cells
    plan = plan_run(
        {"slivers": load_scene(SCENES / "slivers-seen-edge-on.json")},
        list(select_renderers(["vtk"]).values()),
        tmp_path / "again",
        fresh=True,
    )
    (cell,) = [cell for cell in run_plan(plan, tmp_path / "again", 1) if cell.integrator == "first-hits"]
    assert cell.verdict == Verdict.INCOMPARABLE
    assert cell.first_hits is not None
    assert cell.first_hits.unjudged == 560
    assert cell.reason.startswith("560 of 576 first hits cannot be judged")
