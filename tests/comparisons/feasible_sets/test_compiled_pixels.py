"""What the compiled evaluator finds of pixels is what PixelEvaluator finds of them in Arb's balls."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.feasible_sets import followed_rays
from raytruth.comparisons.feasible_sets.compiled_pixels import BATCH, CompiledPixels
from raytruth.comparisons.feasible_sets.feasible_pixel import PixelEvaluator
from raytruth.comparisons.feasible_sets.pixel_outcomes import FLOAT32_BITS, PLAIN_WORK
from raytruth.comparisons.feasible_sets.pixel_program import _pixel_program
from raytruth.comparisons.feasible_sets.plain_pixels import colors_of, first_hits_of
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.feasible_sets.rounded_rays import PlainRays
from raytruth.comparisons.feasible_sets.set_arithmetics import DOUBLE_DOUBLES, FLOATS, set_arithmetic
from raytruth.reference_tracer.arithmetics.scripted_decisions import COMPARISONS
from raytruth.reference_tracer.rendering import render
from tests.reference_tracer.small_scenes import library_scene, small_scene

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2", "ARI-11", "ARI-12")

FLOAT32 = ErrorModel("float32", 24)
MODELS = {
    "24 bits": FLOAT32,
    "51 bits": ErrorModel("float64", 51),
    "offsets": ErrorModel("offsets", 23, RayOffset(absolute=1e-4), index_bits=20, shadow_shortening=1e-3),
    "policies": ErrorModel(
        "policies",
        40,
        RayOffset(absolute=1e-4, minimum_distance=1e-5, relative_minimum_distance=1e-5, excludes_surface=False),
        sphere_test="quadratic",
        triangle_test="cramer",
        fresnel="cosines",
    ),
}
SCENES = ("whitted-1980", "glass-sphere", "facing-mirrors-depth-8", "camera-in-tea", "sphere-over-floor")
# Radii are bounds, and each arithmetic rounds its own a little otherwise: those of Arb have 30 bits.
MOST_WIDER = 1.05


class Both:
    """Arb's evaluator and the compiled one of the same pixels."""

    def __init__(self, scene: Scene, model: ErrorModel, work: int = PLAIN_WORK) -> None:
        self.rays = PlainRays(scene, model)
        self.arb = PixelEvaluator(self.rays, radiance_bound(scene), FLOAT32_BITS, work)
        balls = set_arithmetic(model.precision_bits)
        assert balls is not None
        self.compiled = CompiledPixels(self.arb, self.rays, balls)
        self.pixels = [(column, row) for row in range(scene.camera.height) for column in range(scene.camera.width)]

    def assert_alike(self, *, may_merge: bool = False) -> None:
        found = self.compiled.colors(self.pixels, may_merge=may_merge)
        hits = self.compiled.first_hits(self.pixels)
        for pixel, color, hit in zip(self.pixels, found, hits, strict=True):
            expected = colors_of(self.arb, pixel, may_merge=may_merge)
            assert color.boxes is not None
            assert len(color.boxes) == (len(expected.boxes) if expected else 0)
            if expected:
                assert (color.merged, color.spent) == (expected.merged, expected.spent)
                for box, other in zip(color.boxes, expected.boxes, strict=True):
                    assert_balls_alike(box, other)
            known = first_hits_of(self.arb, pixel) or []
            assert hit is not None
            assert [each.primitive for each in hit] == [each.primitive for each in known]
            for each, other in zip(hit, known, strict=True):
                assert_balls_alike(each.values, other.values)


def assert_balls_alike(found: tuple[object, ...], expected: tuple[object, ...]) -> None:
    for ball, other in zip(found, expected, strict=True):
        assert isinstance(ball, arb)
        assert isinstance(other, arb)
        assert ball.overlaps(other)
        assert float(ball.rad()) <= MOST_WIDER * float(other.rad())


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS.keys())
def test_pixels_have_the_same_outcomes_in_the_same_order(name: str, model: ErrorModel) -> None:
    Both(library_scene(name, 8, 6), model).assert_alike()


def test_pixels_of_a_rasteriser_have_the_same_outcomes() -> None:
    drawn = ErrorModel("a rasteriser", 24, rasterisation=Rasterisation(8, 24, 22))
    Both(library_scene("single-triangle", 8, 6), drawn).assert_alike()


# In so few bits rays and those that go on from them have several outcomes each, up to all that are told apart.
@pytest.mark.parametrize(
    ("name", "bits"),
    [("glass-sphere", 21), ("cornell-box", 15), ("sphere-over-floor", 12)],
)
def test_outcomes_of_rays_that_fork_and_fork_again_are_summed_alike(name: str, bits: int) -> None:
    both = Both(library_scene(name, 8, 6), ErrorModel("few bits", bits))
    both.assert_alike(may_merge=True)
    assert max(len(color.boxes or []) for color in both.compiled.colors(both.pixels, may_merge=True)) >= 8


def test_outcomes_that_may_be_merged_are_merged_alike() -> None:
    Both(library_scene("cornell-box", 8, 6), FLOAT32).assert_alike(may_merge=True)


@pytest.mark.parametrize("work", [1, 40, 150])
@pytest.mark.clause("VER-4")
def test_little_work_leaves_the_same_rays_open(work: int) -> None:
    Both(library_scene("glass-sphere", 6, 4), ErrorModel("float64", 45), work).assert_alike(may_merge=True)


def test_the_same_work_is_counted_for_each_pixel_that_can_be_told() -> None:
    both = Both(library_scene("whitted-1980", 8, 6), FLOAT32)
    counts, told = both.compiled.decisions.counts, 0
    for pixel in both.pixels:
        arbs, own = both.rays.decisions.comparisons, counts[COMPARISONS]
        expected = colors_of(both.arb, pixel, may_merge=False)
        both.compiled.colors([pixel], may_merge=False)
        if expected:  # else a ray has many ways, of which one or the other is decided by a hair
            told += 1
            assert counts[COMPARISONS] - own == both.rays.decisions.comparisons - arbs > 0
    assert told > len(both.pixels) / 2


@pytest.mark.parametrize("model", [MODELS["24 bits"], MODELS["51 bits"]], ids=["floats", "double-doubles"])
def test_boxes_hold_what_the_tracer_gives_in_float64(model: ErrorModel) -> None:
    scene = library_scene("glass-sphere", 8, 6)
    both, image = Both(scene, model), render(scene)
    for (column, row), color in zip(both.pixels, both.compiled.colors(both.pixels, may_merge=True), strict=True):
        holding = [
            all(abs(arb(value) - ball.mid()) <= ball.rad() for ball, value in zip(box, image[row, column], strict=True))
            for box in color.boxes or []
        ]
        assert not color.boxes or any(holding)


def test_more_pixels_than_one_call_takes_are_found_in_their_order() -> None:
    both = Both(library_scene("single-sphere", 8, 6), FLOAT32)
    many = both.pixels * (BATCH // len(both.pixels) + 2)
    once = [len(color.boxes or []) for color in both.compiled.colors(both.pixels, may_merge=True)]
    assert [len(color.boxes or []) for color in both.compiled.colors(many, may_merge=True)] == once * (
        len(many) // len(both.pixels)
    )
    assert len(both.compiled.first_hits(many)) == len(many)


@pytest.mark.clause("VER-4")
def test_a_tree_without_room_is_told_and_nothing_is_written_beyond_it(monkeypatch: pytest.MonkeyPatch) -> None:
    room = 4
    monkeypatch.setattr(followed_rays, "MOST_NODES", room)  # a constant of the program
    _pixel_program.cache_clear()
    both = Both(library_scene("glass-sphere", 4, 3), FLOAT32)
    _pixel_program.cache_clear()
    found = both.compiled.colors(both.pixels, may_merge=True)
    assert any(color.boxes is None for color in found)
    assert any(color.boxes for color in found)
    assert not both.compiled.tree.weights[room:].any()
    assert not both.compiled.tree.nodes[room:].any()


def test_a_pixel_of_a_scene_without_a_bound_says_nothing_where_its_arithmetic_breaks_down() -> None:
    scene = small_scene(width=2, height=2, extent=4.0)
    Both(scene, ErrorModel("few bits", 8)).assert_alike()


def test_the_arithmetic_follows_from_the_precision() -> None:
    assert set_arithmetic(24) is set_arithmetic(48) is FLOATS
    assert set_arithmetic(49) is set_arithmetic(53) is DOUBLE_DOUBLES
    assert set_arithmetic(7) is set_arithmetic(60) is None


def test_a_ball_of_either_arithmetic_becomes_one_of_arbs_and_back() -> None:
    third = arb(1) / 3
    for balls in (FLOATS, DOUBLE_DOUBLES):
        there = balls.to_arb(list(balls.of_arb(third)))
        assert there.contains(third)
        assert balls.parts == np.shape(balls.arithmetic.number(0.0))[0]
