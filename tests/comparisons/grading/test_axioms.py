"""What any grade has to obey, whatever was handed in."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.grading.credit import counts_of, scene_credit
from raytruth.comparisons.grading.feedback import for_student
from raytruth.comparisons.grading.global_mistakes import AS_IT_IS, readings
from raytruth.comparisons.grading.scene_grading import expectations_of
from raytruth.comparisons.records.grade_results import Grade, MistakeGrade, SceneGrade, TopicGrade
from tests.comparisons.grading.small_scenes import ASSIGNMENT, HEIGHT, WIDTH, picture, small_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.grading.scene_expectations import SceneExpectations

FLOATS = OutputModel()
PIXELS = st.sets(st.integers(0, WIDTH * HEIGHT - 1), max_size=40)


@cache
def expectations() -> SceneExpectations:
    """Of one scene, for all examples."""
    return expectations_of(small_scene(), ASSIGNMENT)


def spoilt(pixels: set[int], by: float) -> NDArray[np.float64]:
    """The right picture with these pixels altered."""
    image = picture(small_scene()).copy()
    for pixel in pixels:
        image[divmod(pixel, WIDTH)] += by
    return image


def credit(image: NDArray[np.float64]) -> float:
    return scene_credit(counts_of(expectations().fit(image, FLOATS, AS_IT_IS)), ASSIGNMENT)


@given(PIXELS, PIXELS, st.sampled_from([1e-4, 0.25, 100.0, np.inf, np.nan]))
@pytest.mark.clause("GRD-2")
def test_repairing_pixels_of_a_picture_never_lowers_its_credit(wrong: set[int], kept: set[int], by: float) -> None:
    repaired = wrong & kept
    assert credit(spoilt(wrong - repaired, by)) >= credit(spoilt(wrong, by))


@given(PIXELS, st.sampled_from(["mirrored", "upside_down", "channels_as_BGR"]))
@pytest.mark.clause("GRD-3")
def test_a_picture_that_is_altered_alike_is_graded_as_if_it_were_not_once_that_is_undone(
    wrong: set[int], name: str
) -> None:
    (reading,) = [it for it in readings(FLOATS) if [mistake.name for mistake in it] == [name]]
    image = spoilt(wrong, 0.25)
    altered = {"mirrored": image[:, ::-1], "upside_down": image[::-1], "channels_as_BGR": image[..., ::-1]}[name]
    undone = counts_of(expectations().fit(altered, FLOATS, reading))
    assert scene_credit(undone, ASSIGNMENT) == credit(image)


CREDITS = st.sampled_from([0.0, 0.25, 0.5, 1.0])


def scene_grade(name: str, credit: float, is_private: bool) -> SceneGrade:
    verdict: Literal["right", "wrong"] = "right" if credit == 1.0 else "wrong"
    return SceneGrade(name=name, purpose="", verdict=verdict, credit=credit, reason="-", is_private=is_private)


@st.composite
def grades(draw: st.DrawFn, private_credits: dict[str, float]) -> Grade:
    """A grade of two topics of which some scenes are private, and perhaps a global mistake."""
    credits = {name: draw(CREDITS) for name in ("a", "b", "c")} | private_credits
    topics = {"one": ("a", "hidden-1"), "two": ("b", "c", "hidden-2")}
    clauses = tuple(
        TopicGrade(
            id=topic,
            title=topic,
            points=50.0 * float(np.mean([credits[it] for it in names])),
            maximum=50.0,
            scenes=names,
        )
        for topic, names in topics.items()
    )
    total = sum(it.points for it in clauses)
    charge = total * draw(st.sampled_from([0.0, 0.1]))
    mistakes = (MistakeGrade(name="mirrored", words="-", hint="-", charge=charge),) if charge else ()
    return Grade(
        raytruth_version="1",
        assignment="a",
        title="A",
        submission="s",
        stage=None,
        attempt=1,
        told="diagnosis",
        tells_private=False,
        score=total - charge,
        maximum=100.0,
        clauses=clauses,
        mistakes=mistakes,
        scenes=tuple(scene_grade(name, own, name in private_credits) for name, own in credits.items()),
        diagnosis=(),
        seconds=0.0,
    )


@given(st.data(), CREDITS, CREDITS)
@pytest.mark.clause("GRD-8")
def test_what_is_told_before_the_deadline_says_nothing_of_private_scenes_and_is_never_full_marks(
    data: st.DataObject, first: float, second: float
) -> None:
    grade = data.draw(grades({"hidden-1": first, "hidden-2": second}))
    told = for_student(grade)
    assert told.score + told.hidden <= told.maximum + 1e-9
    assert told.hidden == pytest.approx(50 / 2 + 50 / 3)
    assert told.score < told.maximum
    assert "hidden-" not in told.model_dump_json()
    own = {it.name: it.credit for it in grade.scenes}
    points = [50 / 2 * own["a"], 50 / 3 * (own["b"] + own["c"])]
    assert [it.points for it in told.clauses] == pytest.approx(points)
    if grade.mistakes:
        assert [it.charge for it in told.mistakes] == pytest.approx([0.1 * sum(points)])
    assert told.score == pytest.approx(sum(points) - sum(it.charge for it in told.mistakes))
    assert for_student(grade.model_copy(update={"tells_private": True})).score == grade.score
