"""Rays on the tape go where Arb's linked balls go, and find the same."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.feasible_sets import linked_pixels, tape_rays
from raytruth.comparisons.feasible_sets.feasible_pixel import PixelEvaluator
from raytruth.comparisons.feasible_sets.linked_pixels import MOST_BITS, WORTH_COMPILING, LinkedPixels
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.feasible_sets.rounded_rays import LinkedRays
from raytruth.comparisons.feasible_sets.tape_rays import TapeIsFullError, TapeRays
from raytruth.comparisons.renderers.cycles.adapter import Cycles
from raytruth.comparisons.renderers.mitsuba.adapter import mitsuba_scalar
from raytruth.comparisons.renderers.vtk.adapter import Vtk
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL
from raytruth.reference_tracer.arithmetics.linked_tape_memory import tape_memory
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2")

MITSUBA, CYCLES = mitsuba_scalar().error_model, Cycles().error_model
UNLIMITED = 10**9


def evaluator(way: Any, scene: Scene, model: ErrorModel) -> PixelEvaluator:
    return PixelEvaluator(way(scene, model), radiance_bound(scene), 24, UNLIMITED)


@pytest.mark.parametrize(
    ("name", "model"),
    [
        ("glass-sphere", MITSUBA),
        ("bubble-in-glass", MITSUBA),
        ("concave-mirror", CYCLES),
        ("cornell-box", MITSUBA),
        ("trefoil-knot", CYCLES),
        ("parallel-projection", ErrorModel("", 24, image_radius=0.01)),
    ],
)
def test_pixels_have_the_outcomes_of_arbs_linked_balls_hardly_wider(name: str, model: ErrorModel) -> None:
    scene = library_scene(name).resized(8, 6)
    arbs, tape = (evaluator(way, scene, model.of_light()) for way in (LinkedRays, TapeRays))
    for column, row in [(1, 1), (4, 3), (6, 4), (3, 5)]:
        (expected, expected_merged), (boxes, merged) = arbs.colors(column, row), tape.colors(column, row)
        assert (len(boxes), merged) == (len(expected), expected_merged)
        hits, expected_hits = tape.first_hits(column, row), arbs.first_hits(column, row)
        assert [hit.primitive for hit in hits] == [hit.primitive for hit in expected_hits]
        assert_as_narrow(boxes, expected)
        assert_as_narrow([hit.values for hit in hits], [hit.values for hit in expected_hits])


def assert_as_narrow(boxes: Any, expected: Any) -> None:
    """Radii are Arb's or a twentieth larger, but for roundings of the values themselves."""
    for box, other in zip(boxes, expected, strict=True):
        for ball, arbs in zip(box, other, strict=True):
            assert ball.overlaps(arbs)
            assert float(ball.rad()) <= 1.05 * float(arbs.rad()) + 2.0**-48 * (1.0 + abs(float(arbs.mid())))


def pixels_of(scene: Scene, model: ErrorModel, expected: int = WORTH_COMPILING) -> LinkedPixels:
    pixels = LinkedPixels(scene, model, IDEAL, radiance_bound(scene), 24)
    pixels.expect(expected)
    return pixels


@pytest.fixture
def no_arb(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(linked_pixels, "LinkedRays", None)


@pytest.mark.usefixtures("no_arb")
def test_many_pixels_are_evaluated_on_the_tape() -> None:
    pixels = pixels_of(library_scene("glass-sphere").resized(8, 6), MITSUBA)
    assert len(pixels.colors(4, 3)[0]) == 1
    assert pixels.first_hits(4, 3)


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        (MITSUBA, WORTH_COMPILING - 1),
        (ErrorModel("", MOST_BITS + 1), WORTH_COMPILING),
        (Vtk().error_model, WORTH_COMPILING),
    ],
)
def test_few_pixels_many_bits_and_rasterisers_are_left_to_arb(
    model: ErrorModel, expected: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(linked_pixels, "TapeRays", None)
    pixels = pixels_of(library_scene("single-triangle").resized(8, 6), model, expected)
    assert pixels.first_hits(4, 3)


def test_a_pixel_that_does_not_fit_the_tape_is_arbs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tape_rays, "tape_memory", lambda constants: tape_memory(constants, numbers=150))
    scene = library_scene("glass-sphere").resized(8, 6)
    with pytest.raises(TapeIsFullError):
        evaluator(TapeRays, scene, MITSUBA).colors(4, 3)
    pixels = pixels_of(scene, MITSUBA)
    expected = evaluator(LinkedRays, scene, MITSUBA)
    assert [str(box) for box in pixels.colors(4, 3)[0]] == [str(box) for box in expected.colors(4, 3)[0]]
    assert len(pixels.first_hits(4, 3)) == len(expected.first_hits(4, 3))


@pytest.mark.usefixtures("no_arb")
def test_a_pixel_whose_work_is_spent_says_so() -> None:
    pixels = pixels_of(library_scene("glass-sphere").resized(8, 6), MITSUBA)
    pixels.colors(4, 3)
    assert not pixels.spent
    pixels.share = 15_000 / linked_pixels.TAPE_WORK
    assert pixels.colors(4, 3)[1]
    assert pixels.spent
