"""A grade as `grade.json` holds it: the contract between grading and showing."""

from __future__ import annotations

from typing import Literal

from raytruth.comparisons.records.results import Record

GRADE_FILE = "grade.json"


class TopicGrade(Record):
    """The points of a topic."""

    id: str
    title: str
    points: float
    maximum: float
    scenes: tuple[str, ...]


class SceneGrade(Record):
    """What came of one scene."""

    name: str
    purpose: str
    verdict: Literal["right", "wrong", "error", "grader_error"]
    credit: float
    """Which share of its points it gets, 0 to 1."""
    reason: str
    pixels: int = 0
    wrong: int = 0
    unjudged: int = 0
    declared: int = 0
    region: tuple[int, int, int, int] | None = None
    """The least rectangle around all wrong pixels: first and last column, first and last row."""
    features: tuple[str, ...] = ()
    seconds: float | None = None


class MistakeGrade(Record):
    """A global mistake that was recognised, charged once and undone."""

    name: str
    words: str
    hint: str
    charge: float
    """In points."""


class Diagnosed(Record):
    """A fault of the catalogue, and how much of what is wrong it explains."""

    fault: str
    clause: str
    words: str
    """What the mistake is: this is the solution, which the teacher reads."""
    hint: str
    likelihood: float
    """The share of the wrong pixels looked at that lie in the feasible sets of the tracer with this fault."""
    explained: int
    looked_at: int
    contradicted: int
    """Right pixels of the same scenes that would be wrong with this fault."""
    left_open: int = 0
    """Wrong pixels of which nothing can be proved, since the tracer with this fault leaves everything open there."""
    scenes: tuple[str, ...]
    is_whole: bool
    """Whether it explains every wrong pixel that was looked at, and no right one speaks against it."""


class Grade(Record):
    """What a submission gets, and why."""

    schema_version: int = 1
    raytruth_version: str
    assignment: str
    title: str
    submission: str
    stage: str | None
    attempt: int
    told: Literal["score", "topics", "scenes", "pixels", "diagnosis"]
    """How much of this its student is told."""
    status: Literal["graded", "grader_error"] = "graded"
    score: float
    maximum: float
    clauses: tuple[TopicGrade, ...]
    mistakes: tuple[MistakeGrade, ...]
    scenes: tuple[SceneGrade, ...]
    diagnosis: tuple[Diagnosed, ...]
    unexplained: str = ""
    """Where no known mistake explains all: in which scene, region and features it shows first."""
    seconds: float
