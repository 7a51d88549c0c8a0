from __future__ import annotations

import inspect
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.grading.allowed_models import radiance_model
from raytruth.comparisons.grading.diagnosis import (
    MOST_FIRST,
    MOST_SCENES,
    Evidence,
    Proof,
    agreements,
    evidence_of,
    ranked,
    spread,
)
from raytruth.comparisons.grading.diagnosis import proof_of as proof_of_some
from raytruth.comparisons.grading.explanation import diagnosis
from raytruth.comparisons.grading.faulty_tracers import (
    FaultyTracer,
    outcomes_of,
    single_faults,
    values_of,
    with_another,
)
from raytruth.comparisons.grading.global_mistakes import AS_IT_IS
from raytruth.comparisons.grading.scene_grading import judged_as
from raytruth.comparisons.grading.submission import Submitted
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour, merged
from tests.comparisons.grading.small_scenes import ASSIGNMENT, HEIGHT, WIDTH, AtOnce, picture, small_scene

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("GRD-4")

FLOATS = OutputModel("float32")
# Some of the catalogue: all of it takes as many times as long.
KNOWN = [
    FaultyTracer((name,))
    for name in (
        "no_shadow_rays",
        "no_pi",
        "first_light_only",
        "lights_averaged",
        "missing_clamp",
        "short_pi",
        "nothing_absorbed",
    )
]


def behaviour(*faults: str) -> Behaviour:
    return merged(*(Behaviour(all_faults()[name].overrides, name=name) for name in faults))


def evidence(image: np.ndarray, scene: Scene | None = None) -> Evidence:
    graded = judged_as(AS_IT_IS, Submitted(image, 0.0), ASSIGNMENT, scene or small_scene(), FLOATS)
    (found,) = evidence_of([graded], AS_IT_IS, FLOATS, ASSIGNMENT)
    return found


def proof_of(shown: Evidence, tracer: FaultyTracer) -> Proof:
    """By all pixels."""
    return proof_of_some(shown, tracer, shown.wrong.size, shown.right.size)


def test_the_tracer_with_the_fault_explains_every_wrong_pixel_and_is_contradicted_by_no_right_one() -> None:
    shown = evidence(picture(small_scene(), behaviour("no_shadow_rays")))
    proof = proof_of(shown, FaultyTracer(("no_shadow_rays",)))
    assert (proof.explained, proof.contradicted) == (proof.looked_at, 0)
    assert proof.looked_at > 0
    other = proof_of(shown, FaultyTracer(("no_pi",)))
    assert other.explained == 0
    assert other.contradicted > 0


@pytest.mark.parametrize("fault", ["one_bounce_too_few", "one_bounce_too_many", "background_where_paths_end"])
def test_faults_of_the_walk_through_the_ray_tree_are_proved_in_other_words(fault: str) -> None:
    scene = small_scene("glass-and-mirror").model_copy(update={"max_depth": 1})
    image = picture(scene, behaviour(fault))
    proof = proof_of(evidence(image, scene), FaultyTracer((fault,)))
    assert proof.looked_at > 0
    assert (proof.explained, proof.contradicted) == (proof.looked_at, 0)


def test_a_value_beside_the_faulty_tracers_feasible_set_is_not_explained() -> None:
    image = picture(small_scene(), behaviour("no_shadow_rays"))
    column, row = spread(evidence(image).wrong, 1)[0]
    image[row, column] *= 1.0 + 1e-4
    proof = proof_of(evidence(image), FaultyTracer(("no_shadow_rays",)))
    assert proof.explained == proof.looked_at - 1


@pytest.mark.parametrize("fault", ["no_shadow_rays", "first_light_only", "lights_averaged"])
def test_of_all_faults_the_true_one_is_told_first_and_explains_all(fault: str) -> None:
    told = diagnosis([evidence(picture(small_scene(), behaviour(fault)))], KNOWN, AtOnce())
    assert told[0].fault == fault
    assert told[0].is_whole
    assert told[0].likelihood == 1.0
    assert (told[0].clause, told[0].hint) == (all_faults()[fault].clause, all_faults()[fault].hint)


def test_two_mistakes_at_once_are_explained_by_the_pair() -> None:
    image = picture(small_scene(), behaviour("no_shadow_rays", "no_pi"))
    whole = [it for it in diagnosis([evidence(image)], KNOWN, AtOnce()) if it.is_whole]
    assert {tuple(sorted(it.fault.split(" + "))) for it in whole} == {("no_pi", "no_shadow_rays")}


def test_the_simplest_scenes_come_first() -> None:
    scenes = [small_scene(name) for name in ("mirror-over-diffuse-floor", "three-coloured-lights", "single-sphere")]
    images = [picture(scene) for scene in scenes]
    for image in images[:2]:
        image[4, 4] += 0.1
    graded = [
        judged_as(AS_IT_IS, Submitted(image, 0.0), ASSIGNMENT, scene, FLOATS)
        for scene, image in zip(scenes, images, strict=True)
    ]
    found = evidence_of(graded, AS_IT_IS, FLOATS, ASSIGNMENT)
    names = ["small-single-sphere", "small-three-coloured-lights", "small-mirror-over-diffuse-floor"]
    assert [it.scene.name for it in found] == names
    assert [bool(it.wrong.any()) for it in found] == [False, True, True]


def test_a_fault_that_changes_nothing_in_a_scene_is_not_held_against_it() -> None:
    shown = evidence(picture(small_scene(), behaviour("no_shadow_rays")))
    found = agreements(shown, KNOWN)
    assert KNOWN[-1] not in found
    assert set(KNOWN) < set(single_faults())
    assert ranked([found])[0] == FaultyTracer(("no_shadow_rays",))
    assert ranked([{}]) == []


def test_a_faulty_tracer_that_breaks_has_no_values() -> None:
    broken = FaultyTracer(("near_lights_left_out",))
    assert values_of(broken, small_scene(), AS_IT_IS, [(0, 0)]) is not None
    endless = replace(broken, faults=("one_bounce_too_many",))
    assert values_of(endless, small_scene(), AS_IT_IS, []) is not None


def test_faults_of_one_function_are_made_together_where_each_still_finds_its_place() -> None:
    both = with_another(FaultyTracer(("highlight_times_cosine",)), FaultyTracer(("light_direction_not_normalised",)))
    assert both is not None
    (function,) = both.behaviour().functions
    alone = [all_faults()[fault].overrides[function] for fault in both.faults]
    text = inspect.getsource(both.behaviour().functions[function])
    assert text not in map(inspect.getsource, alone)
    other_way = with_another(FaultyTracer(both.faults[1:]), FaultyTracer(both.faults[:1]))
    assert other_way is not None
    assert inspect.getsource(other_way.behaviour().functions[function]) == text
    # One has no shadow ray, of which the other could alter the end.
    assert with_another(FaultyTracer(("no_shadow_rays",)), FaultyTracer(("shadow_ray_not_limited",))) is None
    with pytest.raises(ValueError, match="shadow_ray_end"):
        FaultyTracer(("no_shadow_rays", "shadow_ray_not_limited")).behaviour()


def test_a_right_scene_that_a_fault_would_alter_speaks_against_it() -> None:
    sun, lamps = small_scene("directional-light"), small_scene()
    image = picture(sun, behaviour("sun_throws_no_shadows"))
    known = [FaultyTracer(("no_shadow_rays",)), FaultyTracer(("sun_throws_no_shadows",))]
    alone = {it.fault: it.is_whole for it in diagnosis([evidence(image, sun)], known, AtOnce())}
    assert alone == {"no_shadow_rays": True, "sun_throws_no_shadows": True}
    told = diagnosis([evidence(image, sun), evidence(picture(lamps))], known, AtOnce())
    assert {it.fault: it.is_whole for it in told} == {"sun_throws_no_shadows": True, "no_shadow_rays": False}
    assert told[0].fault == "sun_throws_no_shadows"


def test_a_second_mistake_that_shows_in_later_scenes_only_is_told_with_the_first() -> None:
    lamps = [small_scene().model_copy(update={"name": f"lamps-{number}"}) for number in range(MOST_SCENES)]
    later = small_scene("parallel-projection")
    shown = [evidence(picture(scene, behaviour("no_shadow_rays")), scene) for scene in lamps]
    both = behaviour("no_shadow_rays", "parallel_rays_spread")
    known = [FaultyTracer(("no_shadow_rays",)), FaultyTracer(("parallel_rays_spread",)), FaultyTracer(("no_pi",))]
    told = diagnosis([*shown, evidence(picture(later, both), later)], known, AtOnce())
    assert [it.fault for it in told if it.is_whole] == ["no_shadow_rays + parallel_rays_spread"]


def test_a_fault_that_explains_none_of_the_first_pixels_is_not_held_to_the_others() -> None:
    shown = evidence(picture(small_scene(), behaviour("no_shadow_rays")))
    other = proof_of(shown, FaultyTracer(("no_pi",)))
    assert MOST_FIRST <= other.looked_at < other.wrong == int(shown.wrong.sum())
    without = proof_of(shown, FaultyTracer(("nothing_absorbed",)))
    assert (without.explained, without.looked_at, without.contradicted) == (0, without.wrong, 0)


@pytest.mark.parametrize("name", ["three-coloured-lights", "whitted-1980", "cornell-box", "parallel-projection"])
def test_every_fault_can_be_held_to_a_proof(name: str) -> None:
    scene = small_scene(name)
    model = radiance_model(ASSIGNMENT.models[0]).in_scene(scene)
    for tracer in single_faults():
        if tracer.applies_to(scene):
            assert len(outcomes_of(tracer, scene, AS_IT_IS, model, [(WIDTH // 2, HEIGHT - 1)])) == 1


def test_pixels_are_spread_over_a_mask() -> None:
    mask = np.zeros((4, 5), dtype=bool)
    assert spread(mask, 3) == []
    mask[1] = True
    assert spread(mask, 3) == [(0, 1), (2, 1), (4, 1)]
    assert len(spread(mask, 99)) == 5
