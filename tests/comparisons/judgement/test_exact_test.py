from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
from raytruth.comparisons.judgement.exact_test import (
    UNJUDGED,
    distances_in_tolerances,
    judge_image,
    largest_error,
    nearest_outcomes,
)
from raytruth.comparisons.judgement.first_hit_test import judge_first_hits
from raytruth.comparisons.judgement.pixel_verdict import verdict_of
from raytruth.comparisons.records.renderings import FirstHits
from raytruth.comparisons.records.results import FirstHitComparison, Verdict
from tests.comparisons.judgement.boxes import boxes, hits

if TYPE_CHECKING:
    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("VER-3")


def row(*values: float | tuple[float, float, float]) -> NDArray[np.float32]:
    """An image of one row; a single number is grey."""
    return np.array([[value if isinstance(value, tuple) else (value,) * 3 for value in values]], dtype=np.float32)


def truth(*values: float) -> NDArray[np.float64]:
    return row(*values).astype(np.float64)


def distance(value: float | tuple[float, float, float], feasible: FeasibleSet) -> float:
    return float(distances_in_tolerances(row(value), feasible)[0, 0])


def test_the_distance_counts_half_widths_from_the_middle_of_the_box() -> None:
    box = boxes([(0.25, 0.75)])
    for value, expected in [(0.5, 0), (0.75, 1), (0.25, 1), (0.625, 0.5), (1.0, 2), (-0.5, 4)]:
        assert distance(value, box) == expected


@given(st.floats(-1e3, 1e3), st.floats(0, 1e-6))
def test_the_ends_of_a_box_are_inside_and_their_neighbours_are_not(low: float, width: float) -> None:
    high = low + width
    images = [
        np.full((1, 1, 3), value) for value in (low, high, np.nextafter(low, -np.inf), np.nextafter(high, np.inf))
    ]
    distances = [float(distances_in_tolerances(image, boxes([(low, high)]))[0, 0]) for image in images]
    assert [value <= 1 for value in distances] == [True, True, False, False]


def test_infinity_lies_in_a_box_that_ends_there() -> None:
    overflowing = boxes([(6e4, math.inf)])
    for value, inside in ((math.inf, True), (6.1e4, True), (5.9e4, False), (-math.inf, False), (math.nan, False)):
        assert (distance(value, overflowing) <= 1) == inside
    assert distance(math.inf, boxes([(math.inf, math.inf)])) <= 1
    assert largest_error(row(math.inf), truth(7e4), boxes([(math.inf, math.inf)])) == math.inf


def test_the_worst_channel_counts() -> None:
    assert distance((0.5, 0.625, 1.25), boxes([(0.25, 0.75)])) == 3


def test_the_nearest_outcome_counts() -> None:
    box = boxes([(0.25, 0.75), (4.0, 6.0)])
    for value, expected in [(5.0, 0), (0.5, 0), (3.0, 2), (1.0, 2)]:
        assert distance(value, box) == expected
    # No outcome explains a channel of one and a channel of the other.
    assert distance((0.5, 5.0, 0.5), box) > 1


@given(
    st.floats(-1e3, 1e3, width=32),
    st.floats(2.0**-10, 1e3, width=32),
    st.floats(-4, 4).filter(lambda part: abs(abs(part) - 1) > 1e-3),
)
def test_a_value_is_within_one_tolerance_exactly_if_it_is_in_the_box(middle: float, half: float, part: float) -> None:
    value = np.float32(middle + part * half)
    low, high = middle - half, middle + half
    if abs(abs(float(value) - middle) / half - 1) < 1e-3:
        return  # rounded to the very end
    assert (distance(float(value), boxes([(low, high)])) <= 1) == (low <= value <= high)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_not_a_number_is_infinitely_far(value: float) -> None:
    for feasible in (boxes([(0.0, 1.0)]), boxes([(0.0, 0.0)]), boxes([(0.0, 1.0), (2.0, 3.0)])):
        assert distance(value, feasible) == math.inf
        assert distance((0.5, value, 0.5), feasible) == math.inf


def test_without_any_tolerance_only_the_value_itself_is_feasible() -> None:
    assert distance(0.5, boxes([(0.5, 0.5)])) == 0
    assert distance(float(np.nextafter(np.float32(0.5), np.float32(1))), boxes([(0.5, 0.5)])) == math.inf


def test_counts_are_of_failing_unjudged_and_ambiguous_pixels() -> None:
    feasible = boxes([(0.0, 1.0)], [(0.0, 1.0)], [], [(0.0, 1.0), (2.0, 4.0)], [(0.0, 1.0), (2.0, 4.0)])
    judgement, nearest = judge_image(row(0.5, 1.5, 9.0, 5.0, 2.5), truth(0.5, 0.5, 0.5, 0.5, 0.5), feasible)
    assert nearest.in_tolerances().tolist() == [[0, 2, UNJUDGED, 2, 0.5]]
    assert (judgement.pixels, judgement.failing, judgement.unjudged, judgement.ambiguous) == (5, 2, 1, 2)
    verdict, reason = verdict_of(judgement)
    assert verdict == Verdict.FAIL
    assert reason.startswith("2 of 4 judged pixels")


@pytest.mark.clause("VER-4")
@pytest.mark.parametrize(("unjudged", "verdict"), [(0, "pass"), (1, "pass"), (2, "incomparable")])
def test_an_image_passes_if_its_judged_pixels_are_feasible_and_at_most_one_in_a_hundred_is_not_judged(
    unjudged: int, verdict: str
) -> None:
    feasible = boxes(*[[(0.0, 1.0)]] * (101 - unjudged), *[[]] * unjudged)
    judgement, _ = judge_image(row(*[0.5] * 101), truth(*[0.5] * 101), feasible)
    found, reason = verdict_of(judgement)
    assert found == verdict
    assert (f"{unjudged} not judged" in reason) == (unjudged == 1)
    assert ("2 of 101 pixels cannot be judged" in reason) == (unjudged == 2)
    failing, _ = judge_image(row(9.0, *[0.5] * 100), truth(*[0.5] * 101), feasible)
    assert verdict_of(failing)[0] == Verdict.FAIL


@pytest.mark.clause("VER-4")
def test_a_pixel_whose_box_holds_several_outcomes_is_counted_and_told() -> None:
    feasible = replace(boxes(*[[(0.0, 1.0)]] * 3), merged=np.array([[False, True, True]]))
    image = row(0.5, 0.5, 0.5)
    judgement, _ = judge_image(image, image.astype(np.float64), feasible)
    assert (judgement.capped, judgement.unjudged) == (2, 0)
    reason = "all 3 pixels lie in their feasible sets (2 in a box of several outcomes)"
    assert verdict_of(judgement) == (Verdict.PASS, reason)
    failing, _ = judge_image(row(0.5, 9.0, 0.5), image.astype(np.float64), feasible)
    reason = "1 of 3 pixels lie outside their feasible sets (2 in a box of several outcomes)"
    assert verdict_of(failing) == (Verdict.FAIL, reason)


def test_nothing_is_said_of_capped_pixels_where_there_are_none() -> None:
    judgement, _ = judge_image(row(0.5), truth(0.5), boxes([(0.0, 1.0)]))
    assert judgement.capped == 0
    assert verdict_of(judgement) == (Verdict.PASS, "all 1 pixels lie in their feasible sets")


def test_each_channel_has_its_distance_from_the_one_nearest_outcome() -> None:
    feasible = boxes([(0.25, 0.75), (4.0, 6.0)], [])
    nearest = nearest_outcomes(row((3.0, 5.0, 7.5), 0.5), feasible)
    assert nearest.places[0, 0] == 1
    assert nearest.distances.tolist() == [[[2, 0, 2.5], [UNJUDGED] * 3]]


def test_an_image_of_which_nothing_can_be_judged_is_incomparable() -> None:
    judgement, nearest = judge_image(row(0.5, 0.5), truth(0.5, 0.5), boxes([], []))
    verdict, reason = verdict_of(judgement)
    assert verdict == Verdict.INCOMPARABLE
    assert reason.startswith("2 of 2 pixels cannot be judged")
    assert (nearest.distances == UNJUDGED).all()
    assert judgement.worst is not None
    assert judgement.worst.tolerances == UNJUDGED


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_one_pixel_that_is_not_a_number_makes_an_image_fail(bad: float) -> None:
    judgement, _ = judge_image(row(0.5, bad), truth(0.5, 0.5), boxes([(0.0, 1.0)], [(0.0, 1.0)]))
    assert judgement.failing == 1
    assert verdict_of(judgement)[0] == Verdict.FAIL
    assert judgement.worst is not None
    assert (judgement.worst.x, judgement.worst.tolerances) == (1, math.inf)


def test_the_worst_pixel_is_told_with_its_nearest_outcome() -> None:
    feasible = boxes([(0.0, 1.0)], [(0.0, 1.0), (2.0, 4.0)])
    judgement, _ = judge_image(row(0.75, (4.5, 3.0, 3.0)), truth(0.5, 0.25), feasible)
    worst = judgement.worst
    assert worst is not None
    assert (worst.x, worst.y, worst.tolerances) == (1, 0, 1.5)
    assert worst.value == (4.5, 3.0, 3.0)
    assert worst.truth == (0.25, 0.25, 0.25)
    assert (worst.low, worst.high) == ((2.0,) * 3, (4.0,) * 3)


def test_the_worst_pixel_of_several_rows_is_found_by_column_and_row() -> None:
    flat = boxes(*([(0.0, 1.0)] for _ in range(6)))
    shaped = FeasibleSet(
        low=flat.low.reshape(2, 3, 1, 3),
        high=flat.high.reshape(2, 3, 1, 3),
        due=flat.due.reshape(2, 3, 1),
        merged=flat.merged.reshape(2, 3),
        hit_primitives=flat.hit_primitives.reshape(2, 3, 1),
        hit_low=flat.hit_low.reshape(2, 3, 1, -1),
        hit_high=flat.hit_high.reshape(2, 3, 1, -1),
        hit_due=flat.hit_due.reshape(2, 3, 1),
    )
    image = np.full((2, 3, 3), 0.5, dtype=np.float32)
    image[1, 2, 0] = 1.5
    judgement, _ = judge_image(image, image.astype(np.float64), shaped)
    assert judgement.worst is not None
    assert (judgement.worst.x, judgement.worst.y) == (2, 1)


def test_the_largest_error_is_from_the_truth_or_from_the_nearest_of_several_outcomes() -> None:
    one, two = [(0.0, 1.0)], [(0.0, 1.0), (2.0, 4.0)]
    assert largest_error(row(0.75), truth(0.5), boxes(one)) == 0.25
    assert largest_error(row(0.75), truth(0.0), boxes(one)) == 0.75  # not from the middle of the box
    assert largest_error(row(3.25), truth(0.5), boxes(two)) == 0.25
    assert largest_error(row(0.75), truth(0.625), boxes(two)) == 0.125  # nearer to the truth than to a middle
    assert largest_error(row(0.5, (0.5, 0.5, 2.5)), truth(0.5, 0.5), boxes(one, one)) == 2.0
    unbounded = (-math.inf, math.inf)
    assert largest_error(row(0.75), truth(0.5), boxes([unbounded, unbounded])) == 0.25  # they have no middle
    assert largest_error(row(9.0), truth(0.5), boxes([])) == 0.0  # not judged
    assert math.isnan(largest_error(row(0.5, math.nan), truth(0.5, 0.5), boxes(one, one)))


def first_hits(*pixels: tuple[int, float]) -> FirstHits:
    """Primitives, and the one value that distance, position and normal all have."""
    values = np.array([[value for _, value in pixels]])
    vectors = np.repeat(values[..., np.newaxis], 3, axis=2)
    return FirstHits(values, vectors, vectors.copy(), np.array([[primitive for primitive, _ in pixels]]))


def comparison(feasible: FeasibleSet, *pixels: tuple[int, float]) -> FirstHitComparison:
    return judge_first_hits(first_hits(*pixels), feasible)


RANGE = (1.0, 2.0)
NOWHERE = (math.nan, math.nan)


def test_first_hits_agree_in_primitive_and_in_all_their_values() -> None:
    feasible = hits([(0, RANGE)], [(1, RANGE)], [(-1, NOWHERE)])
    agreed = comparison(feasible, (0, 1.25), (1, 1.875), (-1, math.nan))
    assert (agreed.compared, agreed.primitive_mismatches, agreed.ambiguous, agreed.failing) == (3, 0, 0, 0)
    assert agreed.largest_depth_error == agreed.largest_position_error == agreed.largest_normal_error == 0.375


def test_each_way_of_missing_the_first_hit_fails() -> None:
    feasible = hits(*[[(0, RANGE)]] * 4, [(-1, NOWHERE)])
    found = comparison(feasible, (1, 1.5), (-1, math.nan), (0, 2.5), (0, math.nan), (0, 1.5))
    assert found.failing == 5
    assert found.primitive_mismatches == 3


@pytest.mark.parametrize("part", ["depth", "position", "normal"])
def test_each_value_of_a_first_hit_is_judged(part: str) -> None:
    given_hits = first_hits((0, 1.5))
    getattr(given_hits, part)[...] = 2.25
    found = judge_first_hits(given_hits, hits([(0, RANGE)]))
    assert found.failing == 1
    assert found.primitive_mismatches == 0
    errors = {
        "depth": found.largest_depth_error,
        "position": found.largest_position_error,
        "normal": found.largest_normal_error,
    }
    assert errors == {name: 0.75 if name == part else 0.0 for name in errors}


def test_of_several_first_hits_one_must_fit_as_a_whole() -> None:
    feasible = hits([(0, RANGE), (1, (5.0, 6.0)), (-1, NOWHERE)])
    for primitive, value, fails in [(0, 1.5, 0), (1, 5.5, 0), (-1, math.nan, 0), (0, 5.5, 1), (1, 1.5, 1), (2, 1.5, 1)]:
        found = comparison(feasible, (primitive, value))
        assert (found.failing, found.ambiguous, found.compared) == (fails, 1, 1), (primitive, value)
        assert found.primitive_mismatches == (primitive == 2)


def test_a_pixel_without_known_first_hits_is_not_compared() -> None:
    feasible = hits([], [(0, RANGE)])
    found = comparison(feasible, (7, math.nan), (0, 1.5))
    assert (found.compared, found.failing, found.ambiguous) == (1, 0, 0)


def test_the_mark_of_an_unused_place_is_no_primitive() -> None:
    feasible = hits([(0, RANGE)], [(0, RANGE), (1, RANGE)])
    assert comparison(feasible, (-2, math.nan), (0, 1.5)).failing == 1
