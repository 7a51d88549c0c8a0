from __future__ import annotations

import numpy as np
import pytest

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.grading.diagnosis import evidence_of
from raytruth.comparisons.grading.explanation import diagnosis
from raytruth.comparisons.grading.faulty_tracers import FaultyTracer
from raytruth.comparisons.grading.first_difference import bounces_of, unexplained
from raytruth.comparisons.grading.global_mistakes import AS_IT_IS
from raytruth.comparisons.grading.scene_grading import judged_as
from raytruth.comparisons.grading.submission import Submitted
from raytruth.reference_tracer.explanation import explain
from tests.comparisons.grading.small_scenes import ASSIGNMENT, AtOnce, picture, small_scene

pytestmark = pytest.mark.clause("GRD-4")


def test_what_nobody_has_thought_of_is_said_to_be_unknown_with_its_place() -> None:
    image = picture(small_scene())
    image[2:5, 6:9] += 0.0123
    plain = small_scene("single-sphere")
    graded = [
        judged_as(AS_IT_IS, Submitted(given, 0.0), ASSIGNMENT, scene, OutputModel("float32"))
        for given, scene in ((image, small_scene()), (picture(plain), plain))
    ]
    shown = evidence_of(graded, AS_IT_IS, OutputModel("float32"), ASSIGNMENT)
    known = [FaultyTracer((name,)) for name in ("no_pi", "first_light_only")]
    assert [it for it in diagnosis(shown, known, AtOnce()) if it.explained] == []
    told = unexplained(shown)
    assert told.startswith("None of the known mistakes explains this. It shows first in small-three-coloured-lights,")
    assert "in 9 pixels, columns 6 to 8, rows 2 to 4" in told
    assert "of its features no scene that is right needs" in told
    assert "triangles" in told
    assert unexplained(shown, in_part=True).startswith("No known mistake explains all of this.")


@pytest.mark.parametrize(("wrong", "bounces"), [("mirrored", "one bounce"), ("seen directly", "no bounce")])
def test_the_simplest_wrong_pixel_is_told_with_its_bounces_and_terms(wrong: str, bounces: str) -> None:
    scene = small_scene("mirror-over-diffuse-floor").model_copy(update={"max_depth": 1})
    height, width = scene.camera.height, scene.camera.width
    depth = np.array([[bounces_of(explain(scene, x, y)) for x in range(width)] for y in range(height)])
    image = picture(scene)
    image[depth > 0 if wrong == "mirrored" else depth >= 0] += 0.0123
    graded = judged_as(AS_IT_IS, Submitted(image, 0.0), ASSIGNMENT, scene, OutputModel("float32"))
    told = unexplained(evidence_of([graded], AS_IT_IS, OutputModel("float32"), ASSIGNMENT))
    assert f"takes {bounces}, and what it should show is " in told
    assert "light" in told.partition("should show is")[2]
