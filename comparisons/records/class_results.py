"""A class as `class.json` holds it: the contract between grading a class and showing it."""

from __future__ import annotations

from typing import Literal

from raytruth.comparisons.records.results import Record

CLASS_FILE = "class.json"
STUDENTS_FOLDER = "students"
Service = Literal["gradescope", "prairielearn", "github-classroom"]
"""What grades by scripts of a teacher's, and reads results of its own kind."""


class Move(Record):
    """How a grade moved when a submission was graded again."""

    before: float | None
    """Points; None where there was no grade."""
    after: float | None
    why: tuple[str, ...]
    """A sentence for each thing that is otherwise."""


class ClassRow(Record):
    """What became of one submission."""

    folder: str
    """Its folder in `students/`, where its pages lie."""
    student: str
    identifier: str = ""
    """By which the platform that it came from knows the student."""
    email: str = ""
    status: Literal["graded", "refused", "no_program", "build_failed", "grader_error"]
    reason: str = ""
    """Why it is not graded."""
    score: float | None
    """Points; 0 where there is nothing that could be graded, None where raytruth itself failed."""
    maximum: float
    topics: dict[str, float]
    """Points of each topic."""
    group: str
    """What explains what is wrong with it, the same words for all with the same mistake."""
    move: Move | None = None
    seconds: float = 0.0


class Likeness(Record):
    """Two submissions whose wrong or rounded pixels are alike, which is evidence for a person to look at."""

    first: str
    """The folders of both."""
    second: str
    alike: int
    """Pixels, not as the truth is rounded, that both have with the same bits and few others have."""
    looked_at: int
    """Pixels in which either is not as the truth is rounded, but for those of common mistakes."""


class ClassResults(Record):
    """The grades of a class."""

    schema_version: int = 1
    raytruth_version: str
    assignment: str
    title: str
    maximum: float
    topics: dict[str, tuple[str, float]]
    """Title and most points of each topic."""
    rows: tuple[ClassRow, ...]
    likenesses: tuple[Likeness, ...] = ()
