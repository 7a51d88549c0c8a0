"""Models that a renderer has on purpose: declared they are `declared`, and else they fail; declared only, they fail."""

from __future__ import annotations

import pytest

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.error_models.departures import NONE, Departures
from raytruth.comparisons.records.results import Verdict
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL
from raytruth.reference_tracer.rendering import prepare
from tests.comparisons.departing_tracers import BITS, DEPARTURES, SCENES, image_of, judged, model_of

pytestmark = pytest.mark.clause("VER-16", "VER-14")

each_departure = pytest.mark.parametrize("name", DEPARTURES)


@each_departure
@pytest.mark.parametrize("numbers", BITS)
def test_who_declares_a_departure_and_has_it_is_declared_where_one_sees_it(name: str, numbers: str) -> None:
    departures, scene_name, offset = DEPARTURES[name]
    model = model_of(departures, numbers, offset)
    verdict, reason = judged(image_of(SCENES[scene_name], model, numbers), SCENES[scene_name], model)
    assert verdict == Verdict.DECLARED, reason


@each_departure
def test_who_has_a_departure_without_a_word_fails(name: str) -> None:
    departures, scene_name, offset = DEPARTURES[name]
    image = image_of(SCENES[scene_name], model_of(departures, "float64", offset), "float64")
    verdict, reason = judged(image, SCENES[scene_name], model_of(NONE, "float64", offset))
    assert verdict == Verdict.FAIL, reason


@each_departure
def test_who_declares_a_departure_and_has_none_fails_although_it_is_the_truth(name: str) -> None:
    departures, scene_name, offset = DEPARTURES[name]
    image = image_of(SCENES[scene_name], model_of(NONE, "float64", offset), "float64")
    verdict, reason = judged(image, SCENES[scene_name], model_of(departures, "float64", offset))
    assert verdict == Verdict.FAIL, reason


def test_where_a_departure_changes_nothing_its_tracer_passes() -> None:
    for name in ("Schlick", "background at the end", "highlights everywhere"):
        model = model_of(DEPARTURES[name][0], "float32")
        assert judged(image_of(SCENES["board"], model, "float32"), SCENES["board"], model)[0] == Verdict.PASS


def test_departures_go_together() -> None:
    every = Departures(
        "background",
        "schlick",
        lit_from="offset point",
        textured_at="offset point",
        highlights="everywhere",
        clamped_lambert=True,
    )
    for name in ("mirrors", "glass", "board", "shadow", "behind"):
        model = model_of(every, "float32", DEPARTURES["lit from the offset point"][2])
        verdict, reason = judged(image_of(SCENES[name], model, "float32"), SCENES[name], model)
        assert verdict == Verdict.DECLARED, f"{name}: {reason}"
        without = model_of(NONE, "float32", DEPARTURES["lit from the offset point"][2])
        assert judged(image_of(SCENES[name], without, "float32"), SCENES[name], model)[0] == Verdict.FAIL


def test_who_shades_beside_the_surface_does_so_where_its_shadow_rays_start_by_whatever_policy() -> None:
    departures, scene_name, offset = DEPARTURES["textured at the offset point"]
    model = model_of(departures, "float64", offset, sphere_test="quadratic")
    assert model.needs_policies
    image = image_of(SCENES[scene_name], model, "float64")
    assert (image == image_of(SCENES[scene_name], model_of(departures, "float64", offset), "float64")).mean() > 0.5
    assert judged(image, SCENES[scene_name], model)[0] == Verdict.DECLARED


def test_who_is_lit_from_beside_the_surface_sends_shadow_rays_to_the_light_all_the_same() -> None:
    scene = SCENES["lit"]
    model = model_of(Departures(lit_from="offset point"), "float64", DEPARTURES["lit from the offset point"][2])
    behaviour = behaviour_of(model, scene).with_numbers(lambda ball: float(ball.mid()))
    kernel = prepare(scene, FLOAT, behaviour).kernel
    point, normal, light = (1.0, 2.0, 0.5), (0.0, 1.0, 0.0), (3.0, 5.0, -1.0)
    to_light = kernel.subtract(light, kernel.lit_point(0, point, normal))
    assert to_light != kernel.subtract(light, point)
    assert kernel.add(point, kernel.from_surface(0, point, normal, to_light, True)) == light
    assert kernel.from_surface(0, point, normal, to_light, False) == to_light


def test_weights_give_back_no_more_than_they_get_and_go_without_another_formula() -> None:
    for weights in ((0.6, 0.5), (-0.1, 0.5), (0.5, -0.1)):
        with pytest.raises(ValueError, match="not negative, and add up to at most 1"):
            Departures(constant_weights=weights)
    with pytest.raises(ValueError, match="not both"):
        Departures(constant_weights=(0.5, 0.5), fresnel="schlick")


def test_departures_are_told_in_words_and_none_changes_nothing() -> None:
    assert NONE.in_words() == "none"
    assert Departures("local", "schlick").in_words() == (
        "paths that end bring the local terms of what they would meet; Schlick's approximation for Fresnel's equations"
    )
    for departures, _, offset in DEPARTURES.values():
        assert departures.in_words() != "none"
        assert behaviour_of(model_of(departures, "float64", offset), SCENES["glass"]).functions
    assert behaviour_of(model_of(NONE, "float64"), SCENES["glass"]).functions == IDEAL.functions
