from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.matrix.probe import TRIED_OFFSETS, Picture, most_bits, tightest_declaration, verdicts
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.program.declaration_file import checked_declaration
from raytruth.comparisons.renderers.program.declared_model import error_model_of_declaration
from raytruth.reference_tracer.rendering import render
from tests.comparisons.error_models.low_scenes import low_things, program
from tests.reference_tracer.small_scenes import lamp, small_scene, sphere, square

if TYPE_CHECKING:
    from raytruth.comparisons.renderers.program.declaration import Declaration
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-8")


def declared(**tables: Any) -> Declaration:
    return checked_declaration({"name": "mine", "command": ["./mine", "{scene}", "{output}"], **tables}, "mine.toml")


def ball_on_a_floor() -> Scene:
    """Where the ball meets the floor, a least distance lets light through."""
    return small_scene(
        name="ball-on-a-floor",
        width=9,
        height=6,
        extent=3.0,
        objects=[sphere("white"), square("white", -1.0)],
        lights=[lamp((3.0, 2.0, 4.0), 0.75)],
    )


def test_what_is_as_due_needs_no_slack_and_no_offset() -> None:
    picture = Picture(ball_on_a_floor(), render(ball_on_a_floor()))
    found = tightest_declaration(declared(writes="exr"), [picture])
    assert (found.bits, found.obstacle) == (53, None)
    assert found.rays == declared().rays
    assert verdicts(declared(), found, [picture]) == {"ball-on-a-floor": Verdict.PASS}


def in_ambient_light() -> Scene:
    """A colour after two multiplications."""
    white = {"ambient": {"reflectance": (0.7, 0.7, 0.7)}}
    return small_scene(name="ambient", width=9, height=6, materials={"white": white}, ambient_light=(0.9, 0.9, 0.9))


@pytest.mark.parametrize(("precision", "error_bits"), [("float32", 14), ("float32", 20), ("float64", 20)])
def test_the_bits_are_the_most_with_which_it_holds(precision: str, error_bits: int) -> None:
    scene = in_ambient_light()
    image = render(scene)
    assert image[3, 4].all(), "the ball is seen there"
    image[3, 4] *= 1 + 2.0**-error_bits
    found = tightest_declaration(declared(arithmetic={"precision": precision}), [Picture(scene, image)])
    if precision == "float64":
        assert found.bits is None, "float64's half is 26 bits"
    else:
        assert found.bits is not None
        assert error_bits <= found.bits <= error_bits + 2
    assert found.obstacle is not None
    pixel = found.obstacle.pixel
    assert (found.obstacle.scene, pixel.x, pixel.y) == ("ambient", 4, 3)


@pytest.mark.parametrize("least", TRIED_OFFSETS[2:5])
def test_the_least_distance_that_a_program_has_is_found(least: float) -> None:
    has = error_model_of_declaration(declared(rays={"least_distance": least}))
    scenes = [low_things("shadow", share * least).model_copy(update={"name": f"{share}"}) for share in (0.5, 5.0)]
    found = tightest_declaration(declared(), [Picture(scene, program(scene, has)) for scene in scenes])
    assert found.rays.least_distance == least
    assert found.rays.offset == 0.0
    assert found.bits is not None


def test_no_offset_is_told_where_the_declared_one_shows_nowhere() -> None:
    scene = ball_on_a_floor()
    found = tightest_declaration(declared(rays={"offset": 1e-9}), [Picture(scene, render(scene))])
    assert found.rays == declared().rays


def test_a_mistake_is_told_with_its_pixel() -> None:
    scene = ball_on_a_floor()
    image = render(scene)
    image[2, 5] *= 0.5
    found = tightest_declaration(declared(), [Picture(scene, image)])
    assert found.bits is None
    assert found.obstacle is not None
    assert (found.obstacle.pixel.x, found.obstacle.pixel.y) == (5, 2)


def test_angles_that_are_told_have_fewer_bits() -> None:
    assert most_bits(declared(conventions={"field_of_view": "horizontal"})) == 49
    assert most_bits(declared()) == 53
    assert most_bits(declared(arithmetic={"precision": "float32"})) == 24
