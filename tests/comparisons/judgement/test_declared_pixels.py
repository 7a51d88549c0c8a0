"""As due, or only as declared: what a shortcut alone explains, and one could see, is no pass."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.judgement.declared_pixels import MOST_LISTED, declared_pixels
from raytruth.comparisons.judgement.exact_test import judge_image, largest_error, nearest_outcomes
from raytruth.comparisons.judgement.first_hit_test import judge_first_hits, verdict_of_first_hits
from raytruth.comparisons.judgement.pixel_verdict import verdict_of
from raytruth.comparisons.records.renderings import FirstHits
from raytruth.comparisons.records.results import Verdict
from tests.comparisons.judgement.boxes import boxes, hits

if TYPE_CHECKING:
    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("VER-14")

DUE, SHORTCUT = (0.4, 0.5), (0.0, 0.1)
FEASIBLE = boxes([DUE, SHORTCUT], [DUE], declared=frozenset({SHORTCUT}))


def grey(*values: float) -> NDArray[np.float32]:
    return np.repeat(np.array([values], dtype=np.float32)[..., np.newaxis], 3, axis=2)


def judged(*values: float, truth: float = 0.45) -> tuple[Verdict, str]:
    judgement, _ = judge_image(grey(*values), grey(*[truth] * len(values)).astype(np.float64), FEASIBLE)
    return verdict_of(judgement)


def test_what_is_due_passes() -> None:
    assert judged(0.45, 0.45)[0] == Verdict.PASS


def test_what_only_a_shortcut_explains_is_declared_with_count_distance_and_place() -> None:
    verdict, reason = judged(0.05, 0.45)
    assert verdict == Verdict.DECLARED
    assert reason == "1 of 2 pixels are as declared, not as due: up to 0.4 from the truth, at (0, 0)"


def test_what_nobody_could_see_is_taken_for_what_is_due() -> None:
    assert judged(0.05, 0.45, truth=0.0501)[0] == Verdict.PASS


def test_what_no_outcome_explains_fails_whatever_is_declared_elsewhere() -> None:
    assert judged(0.05, 0.7)[0] == Verdict.FAIL


def test_a_shortcut_of_one_pixel_excuses_no_other() -> None:
    assert judged(0.45, 0.05)[0] == Verdict.FAIL


@given(st.floats(0, 1), st.floats(0, 1), st.floats(0, 1), st.floats(0, 1), st.floats(0, 1))
def test_a_value_in_both_kinds_of_boxes_is_due(value: float, a: float, b: float, c: float, d: float) -> None:
    due, shortcut = (min(a, b), max(a, b)), (min(c, d), max(c, d))
    nearest = nearest_outcomes(grey(value), boxes([shortcut, due], declared=frozenset({shortcut}) - {due}))
    single = float(np.float32(value))
    in_due, in_shortcut = due[0] <= single <= due[1], shortcut[0] <= single <= shortcut[1]
    assert bool(nearest.by_shortcut()[0, 0]) == (in_shortcut and not in_due)


def test_the_pixels_are_listed_the_farthest_first_and_not_endlessly() -> None:
    image = np.zeros((40, 50, 3), dtype=np.float32)
    truth = np.zeros((40, 50, 3))
    truth[..., 1] = np.arange(2000).reshape(40, 50) / 2000
    found = declared_pixels(image, truth, np.ones((40, 50), bool))
    assert found is not None
    assert (found.count, found.largest_difference, len(found.pixels)) == (2000, 1999 / 2000, MOST_LISTED)
    assert found.pixels[:2] == ((49, 39), (48, 39))
    assert declared_pixels(image, truth, np.zeros((40, 50), bool)) is None


@pytest.mark.clause("VER-9")
@pytest.mark.parametrize(("primitive", "verdict"), [(0, Verdict.PASS), (1, Verdict.DECLARED), (2, Verdict.FAIL)])
def test_a_first_hit_by_a_shortcut_is_declared(primitive: int, verdict: Verdict) -> None:
    box = (0.0, 1.0)
    feasible = hits([(0, box), (1, box)], declared=frozenset({1}))
    halves = np.full((1, 1, 3), 0.5)
    found = FirstHits(halves[..., 0], halves, halves, np.full((1, 1), primitive))
    assert verdict_of_first_hits(judge_first_hits(found, feasible))[0] == verdict


@pytest.mark.clause("VER-9", "VER-4")
@pytest.mark.parametrize(("unjudged", "verdict"), [(0, "pass"), (1, "pass"), (2, "incomparable")])
def test_first_hits_that_are_not_judged_are_told(unjudged: int, verdict: str) -> None:
    feasible = hits(*[[(0, (0.0, 1.0))]] * (101 - unjudged), *[[]] * unjudged)
    halves = np.full((1, 101, 3), 0.5)
    found = judge_first_hits(FirstHits(halves[..., 0], halves, halves, np.zeros((1, 101), int)), feasible)
    told, reason = verdict_of_first_hits(found)
    assert (told, found.unjudged) == (verdict, unjudged)
    assert (f"{unjudged} not judged" in reason) == (unjudged == 1)
    assert ("2 of 101 first hits cannot be judged" in reason) == (unjudged == 2)


def test_the_largest_error_of_what_is_as_declared_is_from_the_truth() -> None:
    image, truth = grey(0.05, 0.45), grey(0.45, 0.45).astype(np.float64)
    assert largest_error(image, truth, FEASIBLE) == pytest.approx(0.4)
