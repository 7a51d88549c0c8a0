"""Of a pixel that takes too long the heaviest rays are followed, and the others bring anything."""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.feasible_sets import linked_pixels, pixel_outcomes
from raytruth.comparisons.feasible_sets.declared_outcomes import bounds_of
from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES, PixelEvaluator, UndecidableError
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.feasible_sets.rounded_rays import LinkedRays, PlainRays
from raytruth.comparisons.feasible_sets.tape_rays import TapeRays
from raytruth.comparisons.renderers.mitsuba.adapter import mitsuba_scalar
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.loading import load_scene
from tests.reference_tracer.small_scenes import lamp, small_scene, square

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2")

FLOAT64 = ErrorModel("float64", 51)
UNLIMITED = 10**9
CORNERS = 8
WAYS = {"plain": PlainRays, "linked": LinkedRays, "tape": TapeRays}
# As much as 41 rays take that look at two panes 16 times a pixel: some follow all of them, and some but the first.
PANES_WORK = {"plain": 6_000, "linked": 150_000, "tape": 200_000}


@cache
def panes() -> Scene:
    """Two panes of glass with a gap of a thousandth between them, over a checkerboard."""
    return load_scene(Path(__file__).parent / "panes-with-a-narrow-gap.json")


@cache
def evaluator_of_panes(way: str) -> PixelEvaluator:
    return evaluator(panes(), way)


def evaluator(scene: Scene, way: str, work: int = UNLIMITED) -> PixelEvaluator:
    return PixelEvaluator(WAYS[way](scene, FLOAT64), radiance_bound(scene), 24, work)


def boxes_within(evaluator: PixelEvaluator, pixel: tuple[int, int], work: int) -> list[Any] | None:
    """The ends of a pixel's boxes; None where so little work leaves everything open."""
    evaluator.most_work = work
    try:
        return [np.array(bounds_of(box)) for box in evaluator.colors(*pixel)[0]]
    except UndecidableError:
        return None


def lies_in(inner: Any, outer: Any) -> bool:
    """Whether a box lies in another, but for what balls lose: radii have 30 bits, and fewer than 2^8 are added."""
    slack = 2.0**-22 * (outer[:, 1] - outer[:, 0])
    return bool(((outer[:, 0] - slack <= inner[:, 0]) & (inner[:, 1] <= outer[:, 1] + slack)).all())


def assert_more_work_leaves_less_open(way: str, pixel: tuple[int, int], little: int, much: int) -> None:
    coarse = boxes_within(evaluator_of_panes(way), pixel, little)
    fine = boxes_within(evaluator_of_panes(way), pixel, much)
    if coarse is not None:
        assert fine is not None
        assert all(any(lies_in(box, other) for other in coarse) for box in fine)


PIXELS = st.tuples(st.integers(0, 31), st.integers(0, 23))


@given(PIXELS, st.integers(0, PANES_WORK["plain"]), st.integers(0, PANES_WORK["plain"]))
def test_what_more_work_leaves_open_lies_in_what_less_work_does(pixel: tuple[int, int], one: int, other: int) -> None:
    assert_more_work_leaves_less_open("plain", pixel, min(one, other), max(one, other))


def test_what_more_work_leaves_open_lies_in_what_less_work_does_in_linked_balls_too() -> None:
    budgets = [0, *np.linspace(0, PANES_WORK["linked"], 9, dtype=int).tolist(), UNLIMITED]
    for little, much in pairwise(budgets):
        assert_more_work_leaves_less_open("linked", (20, 4), little, much)


@pytest.mark.parametrize("way", WAYS)
def test_each_ray_more_that_is_followed_narrows_the_pixel(way: str) -> None:
    shares = [boxes_within(evaluator_of_panes(way), (20, 4), PANES_WORK[way] // part) for part in (1, 3, 6, 12)]
    widths = [float(np.ptp(boxes[0], axis=1).max()) for boxes in shares if boxes is not None]
    assert len(widths) >= 3
    assert all(fine < coarse / 2 for fine, coarse in pairwise(widths))


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("part", [4, 12])
def test_no_ray_is_followed_after_the_work_is_spent(way: str, part: int, monkeypatch: pytest.MonkeyPatch) -> None:
    pixel = evaluator_of_panes(way)
    pixel.most_work = PANES_WORK[way] // part
    follow, starts = pixel._follow, []
    monkeypatch.setattr(pixel, "_follow", lambda ray: (starts.append(pixel.rays.work_done()), follow(ray)))
    before = pixel.rays.work_done()
    merged = pixel.colors(20, 4)[1]
    assert merged
    assert pixel.spent
    assert starts[-1] - before < pixel.most_work


@pytest.mark.clause("VER-4")
def test_a_pixel_that_takes_too_long_counts_as_merged_and_holds_the_truth(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = panes().resized(4, 3)
    truth = np.asarray(render(scene, FLOAT))
    whole = feasible_set(scene, FLOAT64)
    assert not whole.merged.any()
    monkeypatch.setattr(pixel_outcomes, "PLAIN_WORK", PANES_WORK["plain"] // 4)
    monkeypatch.setattr(linked_pixels, "LINKED_WORK", PANES_WORK["linked"] // 4)
    for model in (FLOAT64, mitsuba_scalar().error_model):
        cut = feasible_set(scene, model)
        low, high = cut.hull()
        assert cut.merged.any()
        assert (cut.outcomes > 0).all()
        assert ((low <= truth) & (truth <= high)).all()


@pytest.mark.clause("VER-4")
def test_a_pixel_that_takes_too_long_without_a_bound_is_not_judged(monkeypatch: pytest.MonkeyPatch) -> None:
    facing = {"mirror": {"reflectance": (0.5, 0.5, 0.5)}, "diffuse": {"reflectance": (0.5, 0.5, 0.5)}}
    scene = small_scene(
        materials={"white": facing},
        objects=[square("white", 0.0), square("white", 9.0)],
        lights=[lamp((0.0, 1.0, 2.0))],
        camera={"position": (0.0, 0.0, 5.0), "look_at": (0.3, 0.1, 0.0)},
        max_depth=16,
    )
    assert radiance_bound(scene) is None
    assert (feasible_set(scene, FLOAT64).outcomes == 1).all()
    monkeypatch.setattr(pixel_outcomes, "PLAIN_WORK", 100)
    monkeypatch.setattr(linked_pixels, "LINKED_WORK", 1000)
    assert (feasible_set(scene, FLOAT64).outcomes == 0).all()


def test_of_a_ray_with_too_many_ways_only_so_many_are_taken_as_tell_it() -> None:
    """A ray to the corner of many triangles, no two of which are equal, may meet any of them, and which decides."""
    angles = [2 * math.pi * place / CORNERS for place in range(CORNERS)]
    rim = [(0.1 + math.cos(angle), 0.2 + math.sin(angle), 0.1 * math.sin(5 * angle)) for angle in angles]
    fan = {
        "shape": "mesh",
        "vertices": ((0.1, 0.2, 0.0), *rim),
        "faces": tuple((0, 1 + place, 1 + (place + 1) % CORNERS) for place in range(CORNERS)),
        "material": "white",
    }
    scene = small_scene(
        projection="perspective",
        extent=30.0,
        camera={"position": (0.3, 0.1, 5.0), "look_at": (0.1, 0.2, 0.0)},
        objects=[fan],
        lights=[lamp((1.0, 2.0, 5.0), falloff="inverse_square")],
    )
    assert radiance_bound(scene) is None
    for way in WAYS:
        pixel = evaluator(scene, way)
        trace, taken = pixel.rays.trace, []
        pixel.rays.trace = lambda ray, trace=trace, taken=taken: (taken.append(1), trace(ray))[1]
        with pytest.raises(UndecidableError):
            pixel.colors(0, 0)
        assert 1 < len(taken) < MOST_OUTCOMES


def test_a_stack_of_panes_at_depth_16_has_an_end() -> None:
    """Its tree has some thousand rays that are not negligible, and 2^16 in all."""
    objects = []
    for pane in range(6):
        objects += [square("glass", 0.2 * pane), square("glass", 0.2 * pane + 0.1)]
    scene = small_scene(
        materials={"glass": {"dielectric": {"index_of_refraction": 1.5}}},
        objects=objects,
        background={"color": (0.5, 0.25, 1.0)},
        camera={"position": (0.0, 0.0, 5.0), "look_at": (0.3, 0.1, 0.0)},
        max_depth=16,
    )
    found = feasible_set(scene, FLOAT64)
    assert found.merged.all()
    low, high = found.hull()
    expected = np.array([0.5, 0.25, 1.0])  # all that glass does not lose comes from a background of one colour
    assert ((low <= expected) & (expected <= high)).all()
