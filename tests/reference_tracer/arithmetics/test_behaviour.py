"""What a behaviour puts into a kernel, and that no two behaviours say what one name means."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb, ctx

from raytruth.reference_tracer.arithmetics.arithmetic import (
    FLOAT,
    FLOAT32,
    FLOAT64,
    INTERPRETED_FLOAT32,
    Arithmetic,
    make_kernel,
)
from raytruth.reference_tracer.arithmetics.balls import Decisions, ball_arithmetic, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour, merged
from raytruth.reference_tracer.arithmetics.instantiation import kernel_source
from raytruth.reference_tracer.arithmetics.linked_arithmetic import linked_arithmetic
from raytruth.reference_tracer.rendering import prepare, render
from raytruth.scenes.requirements import Feature
from tests.reference_tracer.small_scenes import lamp, library_scene, small_scene

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("ARI-2")

strength = 0.0
"""A constant of the behaviour below."""


def strengthened(factor: float) -> float:
    """A helper, with a literal of its own."""
    return strength * factor + 0.0625


def brighter(scene: Any, light: Any, distance_squared: Any) -> float:  # noqa: ARG001 - the signature of attenuation
    return strengthened(4.0)


def tenth(scene: Any, light: Any, distance_squared: Any) -> float:  # noqa: ARG001 - the signature of attenuation
    return 0.1


def no_shadows(scene: Any, primitive: Any, point: Any, normal: Any, to_light: Any, light_is_near: Any) -> bool:  # noqa: ARG001 - a signature
    return False


def scale(a: Any, factor: Any) -> Any:  # noqa: ARG001 - the name of a function of the source
    return a


BRIGHTER = Behaviour({"attenuation": brighter}, (strengthened,), {"strength": 0.25}, "more light")
LIT = small_scene(lights=[lamp((0.0, 0.0, 3.0))])


@pytest.mark.parametrize("arithmetic", [FLOAT, FLOAT64, FLOAT32], ids=lambda arithmetic: arithmetic.name)
def test_functions_call_helpers_and_name_constants_compiled_or_not(arithmetic: Arithmetic) -> None:
    assert render(LIT, arithmetic)[0, 0, 0] == 1.0
    assert render(LIT, arithmetic, BRIGHTER)[0, 0, 0] == 1.0625


def test_a_helpers_operations_are_rounded_and_its_comparisons_decided_as_all_others() -> None:
    text, literals = kernel_source({Feature.POINT_LIGHTS, Feature.SPHERES}, BRIGHTER, rounded_operations=True)
    assert "return (strength * factor * roundoff_factor + number_0_0625) * roundoff_factor" in text
    assert literals["number_0_0625"] == 0.0625


def half_lit(scene: Any, light: Any, distance_squared: Any) -> float:
    return 0.5 * inner_attenuation(scene, light, distance_squared)


inner_attenuation = tenth


@pytest.mark.parametrize("arithmetic", [FLOAT, FLOAT64], ids=lambda arithmetic: arithmetic.name)
def test_a_function_around_another_calls_the_sources_or_a_behaviours_own(arithmetic: Arithmetic) -> None:
    around = Behaviour(around={"attenuation": half_lit}, name="half the light")
    assert render(LIT, arithmetic, around)[0, 0, 0] == 0.5
    assert render(LIT, arithmetic, merged(around, BRIGHTER))[0, 0, 0] == 1.0625 / 2
    with pytest.raises(ValueError, match="both say what inner_attenuation is"):
        merged(around, around)


def test_a_function_around_one_that_a_scene_does_not_require_is_left_out() -> None:
    around = Behaviour(around={"attenuation": half_lit})
    assert kernel_source({Feature.SPHERES}, around) == kernel_source({Feature.SPHERES}, IDEAL)


def test_a_helper_that_no_function_calls_is_left_out() -> None:
    unused = Behaviour(helpers=(strengthened,), constants={"strength": 0.25})
    assert kernel_source(set(Feature), unused) == kernel_source(set(Feature), IDEAL)


@pytest.mark.parametrize(
    ("other", "name"),
    [
        (Behaviour({"attenuation": no_shadows}, name="no light"), "attenuation"),
        (Behaviour(helpers=(strengthened,), name="no light"), "strengthened"),
        (Behaviour(constants={"strength": 2.0}, name="no light"), "strength"),
        (Behaviour(constants={"strengthened": 2.0}, name="no light"), "strengthened"),
    ],
)
def test_no_two_behaviours_say_what_a_name_is(other: Behaviour, name: str) -> None:
    with pytest.raises(ValueError, match=f"^more light and no light both say what {name} is$"):
        merged(BRIGHTER, other)


def test_a_merged_behaviour_has_the_functions_helpers_and_constants_of_all() -> None:
    whole = merged(BRIGHTER, IDEAL, Behaviour({"is_shadowed": no_shadows}, constants={"other": 1.0}, name="no shadows"))
    assert whole == Behaviour(
        {"attenuation": brighter, "is_shadowed": no_shadows},
        (strengthened,),
        {"strength": 0.25, "other": 1.0},
        "more light and no shadows",
    )


@pytest.mark.parametrize(
    ("clashing", "name"),
    [
        (Behaviour(helpers=(scale,), name="mine"), "scale"),
        (Behaviour(constants={"dot": 1.0}, name="mine"), "dot"),
        (Behaviour(constants={"NOTHING": 1.0}, name="mine"), "NOTHING"),
    ],
)
def test_a_helper_or_a_constant_has_no_name_of_the_source(clashing: Behaviour, name: str) -> None:
    with pytest.raises(ValueError, match=f"^the tracer's source and mine both say what {name} is$"):
        kernel_source(set(Feature), clashing)


@pytest.mark.parametrize("name", ["roundoff_factor", "sqrt", "is_less"])
def test_a_constant_has_no_name_of_the_arithmetics_functions(name: str) -> None:
    arithmetic = rounded_ball_arithmetic(24, Decisions())
    with pytest.raises(ValueError, match=f"^{arithmetic.name} and mine both say what {name} is$"):
        make_kernel(arithmetic, set(Feature), Behaviour(constants={name: arb(1)}, name="mine"))


def test_a_compiled_kernel_takes_no_list_of_numbers() -> None:
    with pytest.raises(TypeError, match="list"):
        prepare(LIT, FLOAT64, Behaviour(constants={"strengths": [1.0, 2.0]}))


def test_constants_are_made_numbers_of_another_type_lists_too() -> None:
    behaviour = Behaviour({"is_shadowed": no_shadows}, constants={"one": 1, "several": [2, 3]}, name="mine")
    singles = behaviour.with_numbers(np.float32)
    assert singles == Behaviour({"is_shadowed": no_shadows}, constants={"one": 1.0, "several": [2.0, 3.0]}, name="mine")
    assert {type(number) for number in (singles.constants["one"], *singles.constants["several"])} == {np.float32}


OF_BALLS = {
    "balls": lambda: ball_arithmetic(200, Decisions()),
    "rounded balls": lambda: rounded_ball_arithmetic(168, Decisions()),
    "linked balls": lambda: linked_arithmetic(168, Decisions()),
}


@pytest.mark.clause("ARI-3")
@pytest.mark.parametrize("made", OF_BALLS.values(), ids=OF_BALLS)
def test_making_an_arithmetic_or_a_kernel_leaves_the_precision_as_it_is(made: Callable[[], Arithmetic]) -> None:
    with ctx.workprec(77):
        arithmetic = made()
        assert ctx.prec == 77
        prepared = prepare(LIT, arithmetic)
        assert ctx.prec == 77
        with arithmetic.in_force():
            assert ctx.prec == 200
            prepared.kernel.camera_frame(prepared.data)
        assert ctx.prec == 77


@pytest.mark.clause("ARI-3")
def test_numbers_and_images_have_the_precision_of_their_arithmetic_whatever_was_in_force_before() -> None:
    def value() -> list[str]:
        arithmetic = ball_arithmetic(200, Decisions())
        pixel = render(small_scene(lights=[lamp((0.1, 0.2, 3.0))]), arithmetic)[0, 0]
        return [ball.str(70, more=True) for ball in (arithmetic.functions["pi"], *pixel)]

    with ctx.workprec(24):
        coarse = value()
    with ctx.workprec(1000):
        assert value() == coarse


@pytest.mark.clause("ARI-3")
def test_literals_and_the_numbers_of_a_scene_are_stored_at_the_precision_of_their_arithmetic() -> None:
    arithmetic: Any = rounded_ball_arithmetic(24, Decisions())
    scene = small_scene(lights=[lamp((0.1, 0.2, 3.0))])

    def stored() -> list[arb]:
        prepared: Any = prepare(scene, arithmetic, Behaviour({"attenuation": tenth}))
        return [ball.mid() for ball in (prepared.kernel.number_0_1, *prepared.data.numbers)]

    for precision in (10, 1000):
        with ctx.workprec(precision):
            numbers = stored()
        assert numbers[0] == arb(0.1)
        assert {0.1, 0.2, 3.0} <= {float(number) for number in numbers[1:]}


@pytest.mark.clause("ARI-1")
def test_floats_have_a_precision_of_their_own() -> None:
    before = ctx.prec
    for arithmetic in (FLOAT, FLOAT64, FLOAT32, INTERPRETED_FLOAT32):
        with arithmetic.in_force():
            assert ctx.prec == before


@pytest.mark.clause("ARI-1")
def test_interpreted_float32_is_float32_throughout() -> None:
    for function in INTERPRETED_FLOAT32.functions.values():
        assert type(function(np.float32(0.3)) if callable(function) else function) is np.float32
    image = render(library_scene("tinted-glass", 6, 4), INTERPRETED_FLOAT32)
    assert {type(number) for number in image.ravel()} == {np.float32}
