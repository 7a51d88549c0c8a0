from __future__ import annotations

import numpy as np
import pytest

from raytruth.comparisons.classes.likeness import LEAST_PIXELS, Explained, explained_by, likenesses, telling_pixels
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.records.grade_results import Diagnosed, MistakeGrade
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from tests.comparisons.grading.small_scenes import picture, small_scene
from tests.reports.test_grade_reports import GRADE

pytestmark = pytest.mark.clause("CLA-5")

SHAPE = (10, 20, 3)


def rounded(seed: int, share: float = 0.5) -> np.ndarray:
    """Telling pixels of someone who computes in an order of their own."""
    generator = np.random.default_rng(seed)
    values = generator.random(SHAPE).astype(np.float32)
    values[generator.random(SHAPE[:2]) > share] = np.nan
    return values


def told(pictures: dict[str, np.ndarray]) -> list[tuple[str, str]]:
    return [(it.first, it.second) for it in likenesses({name: {"scene": own} for name, own in pictures.items()})]


def test_who_has_the_same_bits_is_told_and_nobody_else() -> None:
    assert told({"ada": rounded(1), "ben": rounded(2), "cleo": rounded(1)}) == [("ada", "cleo")]


def test_who_differs_in_fewer_than_half_of_the_pixels_is_told_still_and_in_more_is_not() -> None:
    ada = rounded(1, share=1.0)
    few, many = ada.copy(), ada.copy()
    few[:2] += 1.0
    many[:7] += 1.0
    assert told({"ada": ada, "few": few}) == [("ada", "few")]
    assert told({"ada": ada, "many": many}) == []


def test_a_few_pixels_that_may_fall_alike_by_chance_are_no_evidence() -> None:
    ada = np.full(SHAPE, np.nan, dtype=np.float32)
    ada.reshape(-1, 3)[: LEAST_PIXELS - 1] = 1.0
    assert told({"ada": ada, "ben": ada}) == []
    ada.reshape(-1, 3)[LEAST_PIXELS] = 1.0
    assert told({"ada": ada, "ben": ada}) == [("ada", "ben")]


def test_a_mistake_that_many_share_is_no_evidence() -> None:
    common = {f"student-{number}": rounded(1) for number in range(5)}
    assert told({**common, **{f"other-{number}": rounded(number) for number in range(10, 20)}}) == []


def test_right_pictures_tell_nothing_and_a_wrong_pixel_tells_of_itself() -> None:
    scene = small_scene()
    image = picture(scene)
    written = OutputModel("float32")
    assert np.isnan(telling_pixels(scene, image, written, Explained())).all()
    image[2, 3, 1] += 0.25
    telling = telling_pixels(scene, image, written, Explained())
    assert [tuple(place) for place in np.argwhere(~np.isnan(telling).all(axis=2))] == [(2, 3)]
    codes = np.rint(np.clip(picture(scene), 0, 1) * 255) / 255
    assert np.isnan(telling_pixels(scene, codes, OutputModel("uint8", clipped=True), Explained())).all()


def test_pictures_of_other_sizes_and_missing_ones_stop_nothing() -> None:
    pictures = {"ada": {"one": rounded(1)}, "ben": {"one": rounded(1)[:2], "two": rounded(3)}, "cleo": {}}
    assert likenesses(pictures) == []
    assert likenesses({}) == []


def test_what_the_told_mistakes_give_tells_nothing_more() -> None:
    scene, written = small_scene(), OutputModel("float32")
    dark = picture(scene, Behaviour(all_faults()["first_light_only"].overrides, name="first_light_only"))
    assert not np.isnan(telling_pixels(scene, dark, written, Explained())).all()
    assert np.isnan(telling_pixels(scene, dark, written, Explained(faults=("first_light_only",)))).all()
    mistakes = (MistakeGrade(name="mirrored", words="-", hint="-", charge=0.0),)
    fault = Diagnosed(
        fault="first_light_only",
        clause="-",
        words="-",
        hint="-",
        likelihood=1.0,
        explained=1,
        looked_at=1,
        contradicted=0,
        scenes=(),
        is_whole=True,
    )
    of_grade = explained_by(GRADE.model_copy(update={"mistakes": mistakes, "diagnosis": (fault,)}), written)
    assert np.isnan(telling_pixels(scene, dark[:, ::-1], written, of_grade)).all()
    assert explained_by(GRADE.model_copy(update={"mistakes": (), "diagnosis": ()}), written) == Explained()
