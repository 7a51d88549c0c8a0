"""The results of the court, as `raytruth court --json` prints them: the contract between judging and showing."""

from __future__ import annotations

from typing import Literal

from raytruth.comparisons.records.results import Record

Outcome = Literal["right", "missed", "false hit", "wrong surface", "not asked", "error"]


class WitnessResult(Record):
    """Who was asked."""

    name: str
    version: str | None
    error: str | None
    """Why it answered nothing; None if it did."""


class TruthResult(Record):
    """What is proven of a case."""

    hit: bool | None
    """None where the ray only touches, and either answer is right."""
    distance: float | None
    """The t of the hit or the touch, rounded to float64."""
    primitives: tuple[int, ...]
    """The triangles of which each is a right answer."""


class WitnessAnswer(Record):
    """What a witness answered to a case, and what that is worth. None stands for what it does not tell."""

    outcome: Outcome
    hit: bool | None = None
    distance: float | None = None
    primitive: int | None = None


class CaseResult(Record):
    """A case, its truth, and all answers by the names of witnesses."""

    case: str
    title: str
    sources: tuple[str, ...]
    dispute: str
    numbers: str
    shape: str
    truth: TruthResult
    answers: dict[str, WitnessAnswer]


class CourtResults(Record):
    """All cases that were heard."""

    schema_version: int = 1
    witnesses: tuple[WitnessResult, ...]
    cases: tuple[CaseResult, ...]
