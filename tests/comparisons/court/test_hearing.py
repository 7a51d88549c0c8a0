from __future__ import annotations

import pytest

from raytruth.comparisons.court.cases import all_cases
from raytruth.comparisons.court.exact_hits import Truth
from raytruth.comparisons.court.hearing import judged, outcome
from raytruth.comparisons.court.questions import MISSED, Answer
from raytruth.comparisons.court.witnesses import Statement

pytestmark = pytest.mark.clause("CRT-4")

HIT = Truth(hit=True, distance=1.0, primitives=frozenset({2, 3}))
MISS = Truth(hit=False, distance=None, primitives=frozenset())
TOUCH = Truth(hit=None, distance=1.0, primitives=frozenset({2}))


@pytest.mark.parametrize(
    ("truth", "answer", "expected"),
    [
        (HIT, Answer(hit=True, distance=1.0, primitive=3), "right"),
        (HIT, Answer(hit=True), "right"),
        (HIT, MISSED, "missed"),
        (HIT, Answer(hit=True, primitive=1), "wrong surface"),
        (MISS, MISSED, "right"),
        (MISS, Answer(hit=True, primitive=2), "false hit"),
        (TOUCH, MISSED, "right"),
        (TOUCH, Answer(hit=True, primitive=2), "right"),
        (TOUCH, Answer(hit=True, primitive=1), "wrong surface"),
        (HIT, None, "not asked"),
    ],
)
def test_an_answer_is_right_or_wrong_in_one_way(truth: Truth, answer: Answer | None, expected: str) -> None:
    assert outcome(truth, answer) == expected


def test_the_results_hold_what_each_witness_said_of_each_case() -> None:
    cases = {name: all_cases()[name] for name in ("flat-box", "edge-of-two-triangles")}
    heard = [
        Statement("good", "1", (Answer(hit=True), Answer(hit=True, distance=1.0, primitive=0))),
        Statement("blind", "2", (None, MISSED)),
        Statement("broken", None, (None, None), "it fell"),
    ]
    results = judged(cases, heard)
    assert [(each.name, each.error) for each in results.witnesses] == [
        ("good", None),
        ("blind", None),
        ("broken", "it fell"),
    ]
    assert [[answer.outcome for answer in case.answers.values()] for case in results.cases] == [
        ["right", "not asked", "error"],
        ["right", "missed", "error"],
    ]
    assert results == type(results).model_validate_json(results.model_dump_json())
