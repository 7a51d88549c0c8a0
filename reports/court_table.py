"""The table of the court: who is right on which case, for a terminal, for a document, and for a spreadsheet."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.records.court_results import CaseResult, CourtResults, Outcome, TruthResult, WitnessAnswer

WRONG: tuple[Outcome, ...] = ("missed", "false hit", "wrong surface")

COUNT_HEADERS = ("Witness", "Version", "Asked", "Right", "Missed", "False hit", "Wrong surface")
CASE_HEADERS = ("Case", "Shape", "Truth", "Who is wrong")
CSV_HEADERS = ("case", "shape", "truth", "witness", "version", "outcome", "hit", "distance", "primitive")


def truth_in_words(truth: TruthResult) -> str:
    """`hit`, `miss` or `touch`, where either answer is right."""
    return "touch" if truth.hit is None else "hit" if truth.hit else "miss"


def count_rows(results: CourtResults) -> list[tuple[str, ...]]:
    """For each witness how many cases it was asked, and what came of them; an error in place of the counts."""
    return [
        (witness.name, witness.version or "", f"error: {witness.error}", *([""] * 4))
        if witness.error is not None
        else (witness.name, witness.version or "", *map(str, _counts(results, witness.name)))
        for witness in results.witnesses
    ]


def case_rows(results: CourtResults) -> list[tuple[str, ...]]:
    """For each case its truth and who is wrong about it, by what is wrong."""
    return [(case.case, case.shape, truth_in_words(case.truth), who_is_wrong(case)) for case in results.cases]


def who_is_wrong(case: CaseResult) -> str:
    """As `missed: embree, mitsuba`; empty where nobody is."""
    by_outcome = {wrong: [name for name, answer in case.answers.items() if answer.outcome == wrong] for wrong in WRONG}
    return "; ".join(f"{wrong}: {' + '.join(names)}" for wrong, names in by_outcome.items() if names)


def markdown(results: CourtResults) -> str:
    """Both tables for a document, each case linked to its first source."""
    cases = [
        (f"[{case.title}]({case.sources[0]})", truth_in_words(case.truth), who_is_wrong(case) or "–")
        for case in results.cases
    ]
    return f"{_markdown(COUNT_HEADERS, count_rows(results))}\n{_markdown(('Case', *CASE_HEADERS[2:]), cases)}"


def csv_text(results: CourtResults) -> str:
    """A line for each case and witness that was asked; numbers with all their digits."""
    versions = {witness.name: witness.version or "" for witness in results.witnesses}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(CSV_HEADERS)
    for case in results.cases:
        for name, answer in case.answers.items():
            if answer.outcome != "not asked":
                writer.writerow(
                    (case.case, case.shape, truth_in_words(case.truth), name, versions[name], *_cells(answer))
                )
    return text.getvalue()


def _cells(answer: WitnessAnswer) -> tuple[str, ...]:
    values = (answer.hit, answer.distance, answer.primitive)
    return (answer.outcome, *("" if value is None else repr(value) for value in values))


def _counts(results: CourtResults, witness: str) -> tuple[int, ...]:
    outcomes = [case.answers[witness].outcome for case in results.cases]
    asked = sum(outcome != "not asked" for outcome in outcomes)
    return asked, outcomes.count("right"), *(outcomes.count(wrong) for wrong in WRONG)


def _markdown(headers: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [headers, ["---"] * len(headers), *rows]
    return "".join(f"| {' | '.join(cell.replace('|', '&#124;') for cell in line)} |\n" for line in lines)
