from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer import certification
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.balls import ball_arithmetic
from raytruth.reference_tracer.certification import (
    FEWEST_BITS,
    MOST_BITS,
    MOST_OUTCOMES,
    NOTHING_KNOWN,
    TWO_ROUNDINGS,
    Certifier,
    Enclosure,
    agree,
    enclosing_floats,
)
from raytruth.reference_tracer.rendering import prepare, render
from raytruth.reference_tracer.ties import NO_BOUND, ONE_HAS_NO_BOUND, TOO_MANY, RaisingDecisions
from tests.reference_tracer.small_scenes import lamp, library_scene, small_scene, sphere
from tests.reproduction import note_case

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("ARI-5")

# An irrational unit direction from here to the origin, so that no ball on the way is exact.
ASKEW = {"position": (0.0, 1.0, 2.0)}
FAR = {"position": (0.0, 2.0**36, 2.0**37)}
SHINING = {"emission": {"radiance": (1.0, 0.5, 0.25)}}


GROUND = {"shape": "triangle", "vertices": ((-9.0, 0.0, 9.0), (9.0, 0.0, 9.0), (0.0, 0.0, -9.0)), "material": "a"}


def view(objects: list[dict[str, Any]], materials: dict[str, Any], **changes: Any) -> Scene:
    """One pixel, whose ray goes from (0, 1, 2) through the origin."""
    camera = ASKEW | changes.pop("camera", {})
    return small_scene(
        projection="perspective", extent=30.0, camera=camera, materials=materials, objects=objects, **changes
    )


def exact(ball: Any) -> Fraction:
    """The middle of a ball."""
    mantissa, exponent = (int(part) for part in ball.mid().man_exp())
    return Fraction(mantissa) * Fraction(2) ** exponent


@pytest.fixture
def in_balls_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where exact values would take too much work."""
    monkeypatch.setattr(certification, "MOST_WORK", 0)
    monkeypatch.setattr(certification, "MOST_WORK_OF_A_WAY", 0)


@pytest.mark.parametrize("name", ["whitted-1980", "camera-under-water", "trefoil-knot", "several-lights-sphere"])
def test_a_pixel_encloses_what_four_times_the_bits_say(name: str) -> None:
    scene = library_scene(name, 7, 5)
    certifier = Certifier(scene)
    with ctx.workprec(4 * FEWEST_BITS):
        prepared = prepare(scene, ball_arithmetic(4 * FEWEST_BITS, RaisingDecisions()))
        frame = prepared.kernel.camera_frame(prepared.data)
        for column, row in ((0, 0), (3, 2), (4, 3), (6, 4)):
            pixel = certifier.pixel(column, row)
            color = prepared.kernel.radiance_at(prepared.data, frame, arb(column + 0.5), arb(row + 0.5))
            assert pixel.undecided is None
            for middle, radius, channel in zip(pixel.middle, pixel.radius, color, strict=True):
                assert abs(channel - arb(middle)) <= arb(radius), (column, row)
                assert radius <= 2.0**-52 * max(pixel.middle)


def test_a_pixel_is_near_what_floats_say() -> None:
    scene = library_scene("glass-and-mirror", 8, 6)
    certifier = Certifier(scene)
    image = render(scene, FLOAT)
    for row in range(6):
        for column in range(8):
            # The float64 error model of this scene allows more; here it only has to be the same picture.
            assert certifier.pixel(column, row).middle == pytest.approx(tuple(image[row, column]), rel=1e-9)


@given(st.floats(-1e300, 1e300), st.floats(-1e300, 1e300), st.sampled_from([0.0, 1e-320, 1e-30, 0.3, 1e200]))
def test_floats_enclose_a_ball(coarse: float, fine: float, spread: float) -> None:
    with ctx.workprec(300):
        ball = arb(coarse) + arb(fine) / 2**70
        ball = arb(ball.mid(), arb(ball.rad()) + arb(spread))
        middle, radius = enclosing_floats(ball)
        note_case(coarse=coarse, fine=fine, spread=spread, middle=middle, radius=radius)
        assert Fraction(middle) - Fraction(radius) <= exact(ball) - exact(ball.rad())
        assert exact(ball) + exact(ball.rad()) <= Fraction(middle) + Fraction(radius)
        # No wider than rounding the middle, once, and the radius, to Arb's 30 bits and to a float.
        least = exact(ball.rad()) + abs(exact(ball) - Fraction(middle))
        assert Fraction(radius) <= least * (1 + Fraction(1, 2**28)) + Fraction(math.ulp(0.0))


@pytest.mark.parametrize("ball", [arb("nan"), arb("inf"), arb(1) / arb(0, 1), arb(2) ** 2000])
def test_what_floats_cannot_enclose_has_an_infinite_radius(ball: arb) -> None:
    assert enclosing_floats(ball)[1] == math.inf


@pytest.mark.usefixtures("in_balls_alone")
def test_a_pixel_gets_the_bits_that_a_comparison_needs() -> None:
    # The foot of the perpendicular is known to 2^36 · 2^-128, which is more than the radius.
    scene = view([sphere("a", radius=2.0**-100)], {"a": SHINING}, camera=FAR)
    pixel = Certifier(scene).pixel(0, 0)
    assert pixel.undecided is None
    assert pixel.precision_bits == 2 * FEWEST_BITS
    assert pixel.middle == (1.0, 0.5, 0.25)
    assert pixel.radius == (0.0, 0.0, 0.0)


def test_a_pixel_gets_the_bits_that_a_narrow_radius_needs() -> None:
    white = {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}}
    lights = [lamp((0.0, 4.0, 4.0))]
    scene = view([sphere("a", radius=2.0**-70)], {"a": white}, camera=FAR, lights=lights)
    certifier = Certifier(scene)
    wide = certifier.pixel(0, 0)
    assert wide.precision_bits == FEWEST_BITS
    assert max(wide.radius) > 2.0**-30
    narrow = certifier.pixel(0, 0, widest=2.0**-52)
    assert narrow.precision_bits == 2 * FEWEST_BITS
    assert narrow.undecided is None
    assert max(narrow.radius) <= 2.0**-52
    assert abs(narrow.middle[0] - wide.middle[0]) <= wide.radius[0]


@pytest.mark.clause("NUM-3")
@pytest.mark.usefixtures("in_balls_alone")
def test_an_edge_met_exactly_is_undecided_and_holds_both_colours() -> None:
    half = {"shape": "triangle", "vertices": ((-3.0, 0.0, -3.0), (-3.0, 0.0, 3.0), (3.0, 0.0, 3.0)), "material": "a"}
    scene = view([half], {"a": SHINING}, background={"color": (0.0, 0.0, 1.0)})
    pixel = Certifier(scene).pixel(0, 0)
    assert pixel.undecided is not None
    assert pixel.precision_bits == MOST_BITS
    assert "an edge or a corner of a triangle" in pixel.undecided.explanation
    assert {outcome.middle for outcome in pixel.undecided.outcomes} == {(1.0, 0.5, 0.25), (0.0, 0.0, 1.0)}
    for middle, radius, one, other in zip(pixel.middle, pixel.radius, (1.0, 0.5, 0.25), (0.0, 0.0, 1.0), strict=True):
        assert middle - radius <= min(one, other)
        assert max(one, other) <= middle + radius
    assert pixel.undecided.origin == (0.0, 1.0, 2.0)
    assert pixel.undecided.direction == pytest.approx((0.0, -math.sqrt(0.2), -2 * math.sqrt(0.2)))


@pytest.mark.clause("NUM-3")
@pytest.mark.usefixtures("in_balls_alone")
def test_a_sphere_touched_exactly_is_undecided_and_says_so() -> None:
    # Along the x axis from the origin of the ray's closest approach, in its own plane: the distance is the radius.
    scene = view([sphere("a", center=(1.0, 0.0, 0.0), radius=1.0)], {"a": SHINING})
    undecided = Certifier(scene).pixel(0, 0).undecided
    assert undecided is not None
    assert "touches a sphere exactly" in undecided.explanation


@pytest.mark.usefixtures("in_balls_alone")
def test_the_border_of_two_squares_is_undecided_and_says_so() -> None:
    board = {"even": (1.0, 0.0, 0.0), "odd": (0.0, 1.0, 0.0), "size": 1.0, "plane": "xz", "offset": (0.5, 0.0)}
    material = {"emission": {"radiance": {"checkerboard": board}}}
    scene = view([GROUND], {"a": material})
    undecided = Certifier(scene).pixel(0, 0).undecided
    assert undecided is not None
    assert undecided.explanation == "the ray lands exactly on the border of two squares of a checkerboard"
    assert {outcome.middle for outcome in undecided.outcomes} == {(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)}


@pytest.mark.usefixtures("in_balls_alone")
def test_a_shadow_ray_that_meets_an_edge_exactly_says_so() -> None:
    screen = {"shape": "triangle", "vertices": ((0.0, 1.0, 9.0), (0.0, 1.0, -9.0), (9.0, 1.0, 0.0)), "material": "a"}
    white = {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}}
    camera = {"position": (-1.0, 1.0, 2.0)}
    scene = view([GROUND, screen], {"a": white}, lights=[lamp((0.0, 3.0, 1.0))], camera=camera)
    undecided = Certifier(scene).pixel(0, 0).undecided
    assert undecided is not None
    assert undecided.explanation.startswith("the shadow ray meets exactly an edge")


@pytest.mark.usefixtures("in_balls_alone")
def test_a_tie_without_a_consequence_is_certified() -> None:
    board = {"even": (0.3, 0.2, 0.1), "odd": (0.3, 0.2, 0.1), "size": 1.0, "plane": "xz"}
    scene = view([GROUND], {"a": {"emission": {"radiance": {"checkerboard": board}}}})
    pixel = Certifier(scene).pixel(0, 0)
    assert pixel.undecided is None
    assert pixel.precision_bits == MOST_BITS
    assert pixel.middle == (0.3, 0.2, 0.1)


@pytest.mark.usefixtures("in_balls_alone")
def test_too_many_outcomes_leave_nothing_known() -> None:
    touching = [sphere("a", center=(radius, 0.0, 0.0), radius=radius) for radius in (0.5, 1, 2, 4, 8, 16, 32, 64)]
    pixel = Certifier(view(touching, {"a": SHINING})).pixel(0, 0)
    assert pixel.undecided is not None
    assert pixel.undecided.outcomes == ()
    assert pixel.middle == NOTHING_KNOWN.middle
    assert "touches a sphere exactly" in pixel.undecided.explanation
    assert pixel.undecided.explanation.endswith(TOO_MANY)
    assert f" {MOST_OUTCOMES} " in TOO_MANY


@pytest.mark.usefixtures("in_balls_alone")
def test_a_way_without_a_bound_is_told_in_words() -> None:
    # The light is in the point that is seen: if it were in front of the surface, its light there would be infinite.
    white = {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}}
    pixel = Certifier(view([GROUND], {"a": white}, lights=[lamp((0.0, 0.0, 0.0), 1.0, "inverse_square")])).pixel(0, 0)
    assert pixel.undecided is not None
    assert pixel.undecided.outcomes == ()
    assert pixel.undecided.explanation.endswith(ONE_HAS_NO_BOUND)


def test_ties_count_as_one_value_by_the_image_if_its_largest_is_known_and_by_floats_next_to_zero() -> None:
    assert agree(Enclosure((1.0, 0.5, 0.0), (TWO_ROUNDINGS, 0.0, 0.0)))
    assert not agree(Enclosure((1.0, 0.5, 0.0), (2 * TWO_ROUNDINGS, 0.0, 0.0)))
    assert agree(Enclosure((1e-9, 0.0, 0.0), (TWO_ROUNDINGS, 0.0, 0.0)), widest=TWO_ROUNDINGS)
    assert not agree(Enclosure((1.0, 0.0, 0.0), (TWO_ROUNDINGS, 0.0, 0.0)), widest=TWO_ROUNDINGS / 2)
    assert agree(Enclosure((0.0, 0.0, 0.0), (5e-324, 0.0, 0.0)), widest=0.0)
    assert not agree(Enclosure((0.0, 0.0, 0.0), (1e-323, 0.0, 0.0)), widest=0.0)
    assert not agree(NOTHING_KNOWN)


def test_a_radius_that_no_float_allows_is_undecided_without_a_tie() -> None:
    white = {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}}
    scene = view([sphere("a")], {"a": white}, lights=[lamp((0.3, 4.0, 4.0))])
    pixel = Certifier(scene).pixel(0, 0, widest=2.0**-80)
    assert pixel.undecided is not None
    assert pixel.undecided.explanation == NO_BOUND


def test_the_precision_of_the_process_stays_as_it_was() -> None:
    with ctx.workprec(77):
        Certifier(library_scene("single-sphere", 2, 2)).pixel(1, 1)
        assert ctx.prec == 77
