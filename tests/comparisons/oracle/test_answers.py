"""Answers against exact rationals, and against the tracer's own source in floats."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given

from raytruth.comparisons.oracle.answer import CertifiedNumber, NumberRange
from raytruth.comparisons.oracle.answers import _features, _prepared
from raytruth.comparisons.oracle.lines import answered, checked_question
from raytruth.comparisons.oracle.situations import CHANGES, situation_of
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, INTERPRETED_FLOAT32, Arithmetic, make_kernel
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL
from tests.comparisons.oracle.questions import BOXES, FRESNEL, PLANES, QUESTIONS, REFLECTIONS, SPHERES


def exactly(vector: list[float]) -> list[Fraction]:
    return [Fraction(number) for number in vector]


def dot(a: list[Fraction], b: list[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def holds(number: Any, value: Fraction) -> bool:
    assert isinstance(number, CertifiedNumber)
    return abs(Fraction(number.middle) - value) <= Fraction(number.radius)


def truth_of(question: dict[str, Any]) -> dict[str, Any]:
    truth = answered(question).truth
    assert truth is not None
    return truth


@given(SPHERES)
@pytest.mark.clause("ORA-1")
def test_a_sphere_is_hit_where_rationals_say(question: dict[str, Any]) -> None:
    to_origin = [o - c for o, c in zip(exactly(question["origin"]), exactly(question["center"]), strict=True)]
    direction = exactly(question["direction"])
    a, b = dot(direction, direction), dot(direction, to_origin)
    c = dot(to_origin, to_origin) - Fraction(question["radius"]) ** 2
    meets = b * b - a * c >= 0 and (c < 0 or b < 0)
    truth = truth_of(question)
    assert truth["hit"] == meets
    if meets:  # the root's sign of a·t² + 2·b·t + c changes around t
        distance = truth["distance"]
        low, high = (Fraction(distance.middle) + sign * Fraction(distance.radius) for sign in (-1, 1))
        ends = [a * t * t + 2 * b * t + c for t in (low, high)]
        assert min(ends) <= 0 <= max(ends) or b * b == a * c


@given(PLANES)
@pytest.mark.clause("ORA-1")
def test_a_plane_is_hit_where_rationals_say(question: dict[str, Any]) -> None:
    normal, direction = exactly(question["normal"]), exactly(question["direction"])
    height = dot([p - o for p, o in zip(exactly(question["point"]), exactly(question["origin"]), strict=True)], normal)
    approach = dot(direction, normal)
    truth = truth_of(question)
    assert truth["hit"] == (height * approach > 0)
    if truth["hit"]:
        assert holds(truth["distance"], height / approach)


@given(BOXES)
@pytest.mark.clause("ORA-1")
def test_a_box_is_entered_and_left_where_rationals_say(question: dict[str, Any]) -> None:
    enter, leave, beside = Fraction(0), None, False
    rows = (exactly(question[key]) for key in ("origin", "direction", "low", "high"))
    for origin, direction, low, high in zip(*rows, strict=True):
        if direction == 0:
            beside = beside or not low <= origin <= high
            continue
        near, far = sorted([(low - origin) / direction, (high - origin) / direction])
        enter, leave = max(enter, near), far if leave is None else min(leave, far)
    assert leave is not None
    truth = truth_of(question)
    assert truth["hit"] == (not beside and enter <= leave)
    if truth["hit"]:
        assert holds(truth["enter"], enter)
        assert holds(truth["leave"], leave)


@given(REFLECTIONS)
@pytest.mark.clause("ORA-1")
def test_a_direction_is_reflected_as_rationals_say(question: dict[str, Any]) -> None:
    direction, normal = exactly(question["direction"]), exactly(question["normal"])
    factor = 2 * dot(direction, normal) / dot(normal, normal)
    expected = [d - factor * n for d, n in zip(direction, normal, strict=True)]
    assert all(holds(number, value) for number, value in zip(truth_of(question)["direction"], expected, strict=True))


@given(FRESNEL)
@pytest.mark.clause("ORA-1")
def test_reflection_is_total_exactly_beyond_the_critical_angle(question: dict[str, Any]) -> None:
    ratio, cosine = Fraction(question["index_to"]) / Fraction(question["index_from"]), Fraction(question["cosine"])
    truth = truth_of(question)
    assert truth["total_reflection"] == (ratio * ratio - 1 + cosine * cosine < 0)
    assert truth["total_reflection"] == ("transmittance" not in truth)


def squared_is(number: Any, value: Fraction) -> bool:
    """Whether the square of a number that is not negative, and lies within the radius, is the value."""
    low, high = (Fraction(number.middle) + sign * Fraction(number.radius) for sign in (-1, 1))
    return low * low <= value <= high * high


@pytest.mark.clause("ORA-1")
@pytest.mark.parametrize("normal", [[0, 3, 0], [0, -1, 0]])
def test_glass_refracts_by_the_ratio_of_sines_whichever_way_the_normal_points(normal: list[float]) -> None:
    into_glass = {"ask": "refract", "direction": [1, -1, 0], "normal": normal, "index_from": 1, "index_to": 1.5}
    truth = truth_of(into_glass)
    along, across, beside = truth["refracted"]
    assert squared_is(along, Fraction(1, 2) * Fraction(4, 9))
    assert across.middle < 0
    assert holds(beside, Fraction(0))
    assert [part.middle > 0 for part in truth["reflected"]] == [True, True, False]
    straight = truth_of(into_glass | {"direction": [0, -1, 0]})
    assert holds(straight["reflectance"], Fraction(1, 25))
    assert holds(straight["transmittance"], Fraction(24, 25))


@pytest.mark.clause("ORA-1")
@pytest.mark.parametrize("normal", [[0, 3, 0], [0, -1, 0]])
def test_a_surface_is_shaded_by_the_cosine_whichever_way_the_normal_points(normal: list[float]) -> None:
    light = {"kind": "point", "position": [1, 1, 0], "intensity": [1, 1, 1], "falloff": "none"}
    surface = {"diffuse": {"reflectance": [0.5, 0.25, 1]}}
    asked = {"ask": "shade", "convention": "whitted", "point": [0, 0, 0], "normal": normal, "direction": [1, -1, 0]}
    red, green, blue = truth_of(asked | {"material": surface, "lights": [light]})["color"]
    assert squared_is(red, Fraction(1, 8))
    assert squared_is(green, Fraction(1, 32))
    assert squared_is(blue, Fraction(1, 2))


@pytest.mark.clause("ORA-1")
def test_the_ray_of_a_pixel_is_the_ray_of_the_camera() -> None:
    camera = {"projection": "orthographic", "position": [0, 0, 5], "look_at": [0, 0, 0], "view_height": 2}
    truth = truth_of({"ask": "primary_ray", "camera": camera | {"width": 4, "height": 2}, "pixel": [3, 0]})
    assert all(map(holds, truth["origin"], [Fraction(3, 2), Fraction(1, 2), Fraction(5)]))
    assert all(map(holds, truth["direction"], [Fraction(0), Fraction(0), Fraction(-1)]))


@given(QUESTIONS)
@pytest.mark.clause("ORA-2")
def test_what_the_source_gives_in_floats_is_allowed_and_so_is_the_truth(question: dict[str, Any]) -> None:
    answer = answered(question)
    for outcomes, arithmetic in ((answer.float32, INTERPRETED_FLOAT32), (answer.float64, FLOAT)):
        if outcomes is None:
            continue
        found = in_floats(question, arithmetic)
        assert any(allows(outcome, found) for outcome in outcomes), (found, outcomes)
        if answer.truth is not None:
            assert any(touches(outcome, answer.truth) for outcome in outcomes)


def in_floats(question: dict[str, Any], arithmetic: Arithmetic) -> dict[str, Any]:
    """What the same situation gives in an arithmetic without balls."""
    compared = {**arithmetic.functions, "is_less": lambda a, b: a < b}
    plain = Arithmetic(arithmetic.name, arithmetic.number, compared, guarded_divisions=arithmetic.guarded_divisions)
    situation = situation_of(checked_question(question))
    with np.errstate(all="ignore"):
        kernel = make_kernel(plain, _features(situation), CHANGES.get(question["ask"], IDEAL))
        return situation.ask(_prepared(situation, plain, kernel))


def parts(value: Any) -> tuple[Any, ...]:
    return value if isinstance(value, tuple) else (value,)


def allows(outcome: dict[str, Any], found: dict[str, Any]) -> bool:
    return outcome.keys() == found.keys() and all(
        any(map(math.isnan, map(float, parts(found[name]))))
        or all(fits(it, value) for it, value in zip(parts(outcome[name]), parts(found[name]), strict=True))
        for name in found
    )


def fits(allowed: Any, value: Any) -> bool:
    if isinstance(allowed, NumberRange):
        return allowed.low <= float(value) <= allowed.high
    return allowed is None or bool(allowed == value)


def touches(outcome: dict[str, Any], truth: dict[str, Any]) -> bool:
    return outcome.keys() == truth.keys() and all(
        meet(it, value) for name in truth for it, value in zip(parts(outcome[name]), parts(truth[name]), strict=True)
    )


def meet(allowed: Any, value: Any) -> bool:
    if isinstance(allowed, NumberRange):
        return bool(allowed.low <= value.middle + value.radius and value.middle - value.radius <= allowed.high)
    return allowed is None or bool(allowed == value)


@pytest.mark.clause("ORA-2")
def test_a_ray_at_the_rim_of_a_sphere_may_hit_or_miss_in_floats_and_hits_in_truth() -> None:
    rim = {"ask": "intersect_sphere", "origin": [1, 0, 5], "direction": [0, 0, -1], "center": [0, 0, 0], "radius": 1}
    answer = answered(rim)
    assert answer.truth is not None
    assert answer.truth["hit"] is True
    for outcomes in (answer.float32, answer.float64):
        assert outcomes is not None
        assert {outcome["hit"] for outcome in outcomes} == {True, False}


@pytest.mark.clause("ORA-2")
def test_a_declared_formula_is_allowed_what_it_loses() -> None:
    far = {
        "ask": "intersect_sphere",
        "origin": [0.3, 0.1, 900],
        "direction": [0, 0, -1],
        "center": [0, 0, 0],
        "radius": 1,
    }
    widths = []
    for formula in ("accurate", "quadratic"):
        outcomes = answered(far | {"formulas": {"sphere": formula}, "slack_bits": 0}).float64
        assert outcomes is not None
        distance = outcomes[0]["distance"]
        assert isinstance(distance, NumberRange)
        widths.append(distance.high - distance.low)
    assert widths[1] > 10 * widths[0]


@given(QUESTIONS)
@pytest.mark.clause("ORA-1")
def test_an_answer_names_its_question_and_is_certain_to_the_last_digit(question: dict[str, Any]) -> None:
    answer = answered(question | {"id": "mine"})
    assert (answer.ask, answer.id) == (question["ask"], "mine")
    for value in (answer.truth or {}).values():
        for number in parts(value):
            if isinstance(number, CertifiedNumber):
                assert float.fromhex(number.middle_hex) == number.middle
                assert float.fromhex(number.radius_hex) == number.radius
                assert number.radius <= max(2.0**-52 * abs(number.middle), math.ulp(0.0))
