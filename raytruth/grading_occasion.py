"""When a submission is graded, which attempt it is, and which scenes are drawn for it: from options, or Gradescope."""

from __future__ import annotations

import secrets
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from raytruth.comparisons.grading.grade import Occasion
from raytruth.comparisons.grading.submission_metadata import (
    SEED_BYTES,
    MetadataError,
    parsed_date,
    read_submission_metadata,
)
from raytruth.errors import UsageError

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.submission_metadata import SubmissionMetadata


def occasion_of(
    assignment: Assignment,
    stage: str | None,
    attempt: int | None,
    date: str | None,
    seed: int | None,
    metadata: Path | None,
) -> tuple[Assignment, Occasion]:
    """The assignment with the student's own deadline, and the occasion. What is None is taken from the metadata.

    Raises UsageError for a date or a file that cannot be used.
    """
    told, told_on = _metadata(metadata), _date(date)
    assignment = _with_own_deadline(assignment, told)
    seed = _seed(assignment, seed, told)
    number = attempt or (told.attempt if told else 1)
    return assignment, Occasion(stage, number, told_on, seed)


def _metadata(path: Path | None) -> SubmissionMetadata | None:
    try:
        return None if path is None else read_submission_metadata(path)
    except MetadataError as error:
        raise UsageError(f"--submission-metadata: {error}") from error


def _date(text: str | None) -> datetime:
    try:
        return datetime.now(UTC) if text is None else parsed_date(text, "--date")
    except MetadataError as error:
        raise UsageError(str(error)) from error


def _with_own_deadline(assignment: Assignment, told: SubmissionMetadata | None) -> Assignment:
    """The assignment with the student's own deadline, if that is later."""
    if told is None or told.due is None or assignment.deadline is None or told.due <= assignment.deadline:
        return assignment
    return assignment.model_copy(update={"deadline": told.due})


def _seed(assignment: Assignment, stated: int | None, told: SubmissionMetadata | None) -> int:
    """The seed of this submission: what is stated, else 0 for all, else its own."""
    if stated is not None or assignment.drawn == "alike":
        return stated or 0
    return told.seed if told is not None else secrets.randbelow(2 ** (8 * SEED_BYTES))
