"""A hearing: each case's truth, each witness's answer, and who is right."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.court.exact_hits import Truth, truth_of
from raytruth.comparisons.court.witnesses import Statement, statements
from raytruth.comparisons.records.court_results import (
    CaseResult,
    CourtResults,
    Outcome,
    TruthResult,
    WitnessAnswer,
    WitnessResult,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from raytruth.comparisons.court.cases import Case
    from raytruth.comparisons.court.questions import Answer


def outcome(truth: Truth, answer: Answer | None) -> Outcome:
    """Whether an answer is right, or what is wrong with it; nothing is said of a distance, which is not disputed."""
    if answer is None:
        return "not asked"
    if truth.hit is not None and answer.hit != truth.hit:
        return "missed" if truth.hit else "false hit"
    if answer.hit and answer.primitive is not None and answer.primitive not in truth.primitives:
        return "wrong surface"
    return "right"


def hold_court(cases: Mapping[str, Case]) -> CourtResults:
    """Put all cases to all witnesses."""
    return judged(cases, statements(tuple(case.question for case in cases.values())))


def judged(cases: Mapping[str, Case], heard: Iterable[Statement]) -> CourtResults:
    """The results, from what each witness said of all cases in this order."""
    heard = tuple(heard)
    return CourtResults(
        witnesses=tuple(WitnessResult(name=each.witness, version=each.version, error=each.error) for each in heard),
        cases=tuple(_case_result(name, case, index, heard) for index, (name, case) in enumerate(cases.items())),
    )


def _case_result(name: str, case: Case, index: int, heard: tuple[Statement, ...]) -> CaseResult:
    truth = truth_of(case.question)
    return CaseResult(
        case=name,
        title=case.title,
        sources=tuple(map(str, case.sources)),
        dispute=case.dispute,
        numbers=case.numbers,
        shape=case.question.shape,
        truth=TruthResult(hit=truth.hit, distance=truth.distance, primitives=tuple(sorted(truth.primitives))),
        answers={each.witness: _witness_answer(truth, each, index) for each in heard},
    )


def _witness_answer(truth: Truth, statement: Statement, index: int) -> WitnessAnswer:
    answer = statement.answers[index]
    if statement.error is not None:
        return WitnessAnswer(outcome="error")
    if answer is None:
        return WitnessAnswer(outcome="not asked")
    return WitnessAnswer(
        outcome=outcome(truth, answer), hit=answer.hit, distance=answer.distance, primitive=answer.primitive
    )
