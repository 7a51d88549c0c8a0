"""What a run of `grade` leaves when it is killed or fails: never less than was there before."""

from __future__ import annotations

import json
from importlib.metadata import version
from typing import TYPE_CHECKING

from pydantic import ValidationError

from raytruth.comparisons.records.grade_results import GRADE_FILE, Grade
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.gradescope import gradescope_results

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.grade import Occasion


def begin_results(gradescope: Path | None, assignment: Assignment, occasion: Occasion) -> None:
    """Where there is no file for Gradescope yet, one that says that raytruth failed: it holds until there is a grade.

    So there is one however the run ends, also if it is killed, or fails before or behind the grading of scenes.
    """
    if gradescope is None or gradescope.exists():
        return
    failed = Grade(
        raytruth_version=version("raytruth"),
        assignment=assignment.name,
        title=assignment.title,
        submission="-",
        stage=occasion.stage,
        attempt=occasion.attempt,
        told=assignment.told(occasion.attempt),
        status="grader_error",
        score=0.0,
        maximum=assignment.points,
        clauses=(),
        mistakes=(),
        scenes=(),
        diagnosis=(),
        seconds=0.0,
    )
    write_whole(gradescope, gradescope_results(failed))


def has_grade(folder: Path | None) -> bool:
    """Whether a grade lies in a folder that is one, and no failure of raytruth."""
    try:
        return folder is not None and Grade.model_validate_json((folder / GRADE_FILE).read_bytes()).status == "graded"
    except (OSError, ValidationError):
        return False


def has_score(gradescope: Path | None) -> bool:
    """Whether a file for Gradescope has a score."""
    try:
        return gradescope is not None and "score" in json.loads(gradescope.read_bytes())
    except (OSError, ValueError, TypeError):
        return False
