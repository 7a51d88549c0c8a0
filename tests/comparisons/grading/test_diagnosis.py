from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.grading.diagnosis import Evidence, agreements, evidence_of, proof_of, ranked, spread
from raytruth.comparisons.grading.explanation import diagnosis, unexplained
from raytruth.comparisons.grading.faulty_tracers import FaultyTracer, single_faults, values_of
from raytruth.comparisons.grading.global_mistakes import AS_IT_IS
from raytruth.comparisons.grading.scene_grading import judged_as
from raytruth.comparisons.grading.submission import Submitted
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour, merged
from tests.comparisons.grading.small_scenes import ASSIGNMENT, AtOnce, picture, small_scene

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


def evidence(image: np.ndarray) -> Evidence:
    graded = judged_as(AS_IT_IS, Submitted(image, 0.0), ASSIGNMENT, small_scene(), FLOATS)
    (found,) = evidence_of([graded], AS_IT_IS, FLOATS, ASSIGNMENT)
    return found


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
    graded = judged_as(AS_IT_IS, Submitted(image, 0.0), ASSIGNMENT, scene, FLOATS)
    (shown,) = evidence_of([graded], AS_IT_IS, FLOATS, ASSIGNMENT)
    proof = proof_of(shown, FaultyTracer((fault,)))
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


def test_what_nobody_has_thought_of_is_said_to_be_unknown_with_its_place() -> None:
    image = picture(small_scene())
    image[2:5, 6:9] += 0.0123
    shown = evidence(image)
    assert [it for it in diagnosis([shown], KNOWN, AtOnce()) if it.explained] == []
    told = unexplained([shown], [])
    assert "None of the known mistakes explains this." in told
    assert "in 9 pixels, columns 6 to 8, rows 2 to 4" in told
    assert "point lights" in told
    assert "of its features" not in unexplained([shown], [small_scene()])
    assert unexplained([shown], [], in_part=True).startswith("No known mistake explains all of this.")


def test_the_simplest_scenes_come_first_and_right_ones_not_at_all() -> None:
    scenes = [small_scene(name) for name in ("mirror-over-diffuse-floor", "three-coloured-lights", "single-sphere")]
    images = [picture(scene) for scene in scenes]
    for image in images[:2]:
        image[4, 4] += 0.1
    graded = [
        judged_as(AS_IT_IS, Submitted(image, 0.0), ASSIGNMENT, scene, FLOATS)
        for scene, image in zip(scenes, images, strict=True)
    ]
    found = evidence_of(graded, AS_IT_IS, FLOATS, ASSIGNMENT)
    assert [it.scene.name for it in found] == ["small-three-coloured-lights", "small-mirror-over-diffuse-floor"]


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
    with pytest.raises(ValueError, match="shadow"):
        FaultyTracer(("no_shadow_rays", "shadow_ray_not_limited")).behaviour()


def test_pixels_are_spread_over_a_mask() -> None:
    mask = np.zeros((4, 5), dtype=bool)
    assert spread(mask, 3) == []
    mask[1] = True
    assert spread(mask, 3) == [(0, 1), (2, 1), (4, 1)]
    assert len(spread(mask, 99)) == 5
