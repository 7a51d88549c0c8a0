"""A grade as `grade.json` holds it: the contract between grading and showing."""

from __future__ import annotations

from typing import Literal

from raytruth.comparisons.records.results import Record
from raytruth.comparisons.records.sandbox_results import RungResult  # noqa: TC001 - pydantic reads annotations at run time

GRADE_FILE = "grade.json"


class TopicGrade(Record):
    """The points of a topic."""

    id: str
    title: str
    points: float
    maximum: float
    scenes: tuple[str, ...]
    hidden: float = 0.0
    """Of the maximum what private scenes decide, in a record for a student who is not told of them yet."""


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
    is_private: bool = False
    """Whether students are told of it after the deadline only."""


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
    seed: int = 0
    """What was added to the seeds of scenes that are drawn."""
    date: str | None = None
    """When it was handed in, in ISO 8601; None where nobody said."""
    tells_private: bool = True
    """Whether its student is told of private scenes, too."""
    hidden: float = 0.0
    """As of topics, of all points."""
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
    sandbox: RungResult | None = None
    """What the submission ran in, and which attacks that holds here; not told to students."""
