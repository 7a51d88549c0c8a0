from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.grading.assignment import Assignment
from raytruth.comparisons.grading.credit import (
    NO_PICTURE,
    SceneCounts,
    counts_of,
    scene_credit,
    score_of,
    topic_points,
)
from raytruth.comparisons.grading.reading import best_place
from raytruth.comparisons.grading.scene_expectations import PixelFit

pytestmark = pytest.mark.clause("GRD-2")

TOPICS = {"one": ["a", "b"], "two": ["b", "c", "d"]}
ASSIGNMENT = Assignment.model_validate(
    {
        "name": "stated",
        "title": "Stated",
        "points": 60.0,
        "models": [{}],
        "topics": [
            {"id": "one", "title": "One", "weight": 1.0, "scenes": ["a", "b"]},
            {"id": "two", "title": "Two", "weight": 2.0, "scenes": ["b", "c", "d"]},
        ],
    }
)
PERFECT = SceneCounts(judged=12, counted=8, counted_right=8)


@st.composite
def pictures(draw: st.DrawFn, least_wrong: int = 0) -> SceneCounts:
    """Counts of a picture in which something is seen, and at least so many pixels are wrong."""
    judged = draw(st.integers(1, 300))
    wrong = draw(st.integers(least_wrong, judged))
    counted = draw(st.integers(1, judged))
    wrong_counted = draw(st.integers(max(0, wrong - (judged - counted)), min(wrong, counted)))
    declared = draw(st.integers(0, judged - wrong))
    return SceneCounts(judged, wrong, draw(st.integers(0, 20)), declared, counted, counted - wrong_counted)


ALL_PICTURES = st.fixed_dictionaries({name: st.just(NO_PICTURE) | pictures() for name in "abcd"})


def score(counts: dict[str, SceneCounts], mistakes: int = 0) -> float:
    return score_of(topic_points(ASSIGNMENT, TOPICS, counts).values(), mistakes, ASSIGNMENT)


@given(ALL_PICTURES, st.sampled_from("abcd"), pictures(least_wrong=1), st.data())
def test_repairing_pixels_never_lowers_the_score(
    others: dict[str, SceneCounts], scene: str, before: SceneCounts, data: st.DataObject
) -> None:
    counts = others | {scene: before}
    repaired = data.draw(st.integers(1, before.wrong))
    seen = data.draw(st.integers(0, min(repaired, before.counted - before.counted_right)))
    after = replace(before, wrong=before.wrong - repaired, counted_right=before.counted_right + seen)
    assert score(counts | {scene: after}) >= score(counts)


@given(ALL_PICTURES, st.sampled_from("abcd"))
def test_a_scene_without_a_picture_costs_its_own_points_and_no_more(counts: dict[str, SceneCounts], lost: str) -> None:
    without = score(counts | {lost: NO_PICTURE})
    worth = sum(
        20.0 * weight / len(TOPICS[topic]) for topic, weight in (("one", 1), ("two", 2)) if lost in TOPICS[topic]
    )
    credit = scene_credit(counts[lost], ASSIGNMENT)
    assert without == pytest.approx(score(counts) - worth * credit, abs=1e-9)


@given(ALL_PICTURES, st.permutations("abcd"))
def test_neither_the_order_nor_the_names_of_scenes_change_the_score(
    counts: dict[str, SceneCounts], order: list[str]
) -> None:
    turned = {topic: [name for name in order if name in scenes] for topic, scenes in reversed(TOPICS.items())}
    renamed = {topic: [f"{name}-renamed" for name in scenes] for topic, scenes in turned.items()}
    points = topic_points(ASSIGNMENT, renamed, {f"{name}-renamed": counts[name] for name in order})
    assert score_of(points.values(), 0, ASSIGNMENT) == score(counts)


@given(ALL_PICTURES, ALL_PICTURES)
@pytest.mark.clause("GRD-2", "GRD-3")
def test_repairing_a_global_mistake_never_lowers_the_score(
    plain: dict[str, SceneCounts], undone: dict[str, SceneCounts]
) -> None:
    both = {0: plain, 1: undone}
    place = best_place(both, {0: 0, 1: 1}, ASSIGNMENT, TOPICS)
    graded = score(both[place], place)
    assert graded >= score(plain)
    # Repaired, the pictures are those that were found by undoing it.
    assert place == 0 or score(undone) >= graded


def test_a_global_mistake_is_charged_once_however_many_scenes_show_it() -> None:
    wrong = {name: SceneCounts(judged=12, wrong=12, counted=8) for name in "abcd"}
    right = dict.fromkeys("abcd", PERFECT)
    assert best_place({0: wrong, 3: right}, {0: 0, 3: 1}, ASSIGNMENT, TOPICS) == 3
    assert score(right, 1) == pytest.approx(60.0 * 0.9)
    assert best_place({0: right, 3: right}, {0: 0, 3: 1}, ASSIGNMENT, TOPICS) == 0


def test_all_points_are_for_pictures_without_a_wrong_pixel_and_half_at_most_for_others() -> None:
    assert score(dict.fromkeys("abcd", PERFECT)) == pytest.approx(60.0)
    assert scene_credit(replace(PERFECT, wrong=1), ASSIGNMENT) == 0.5
    assert scene_credit(replace(PERFECT, wrong=4, counted_right=4), ASSIGNMENT) == 0.25
    assert scene_credit(NO_PICTURE, ASSIGNMENT) == 0.0
    assert scene_credit(SceneCounts(unjudged=12), ASSIGNMENT) == 1.0


def test_no_more_pixels_than_allowed_may_be_right_only_as_declared() -> None:
    assert scene_credit(SceneCounts(judged=200, declared=2, counted=1, counted_right=1), ASSIGNMENT) == 1.0
    assert scene_credit(SceneCounts(judged=200, declared=3, counted=1, counted_right=1), ASSIGNMENT) == 0.5


def test_pixels_are_counted_by_what_they_are() -> None:
    right = np.array([[True, True, False, False]])
    unjudged = np.array([[False, False, True, False]])
    fit = PixelFit(right, unjudged, np.array([[True, False, False, False]]), np.array([[False, True, True, True]]))
    assert counts_of(fit) == SceneCounts(judged=3, wrong=1, unjudged=1, declared=1, counted=2, counted_right=1)
