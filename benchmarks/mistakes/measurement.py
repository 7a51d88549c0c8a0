"""Grades submissions with mistakes switched on, and keeps what was told of each."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from pydantic import Field

from benchmarks.mistakes.mistakes import FOLDER, Part, write_submission
from raytruth.comparisons.grading.grade import Occasion, grade_submission
from raytruth.programs import program_of_file
from raytruth.reference_tracer.storage.whole_files import write_whole

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from concurrent.futures import Executor

    from benchmarks.mistakes.mistakes import Mistake
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.records.grade_results import Grade
    from raytruth.scenes.scene import Scene

RESULTS = FOLDER / "results.json"


class Told(Part):
    """What was told of one submission."""

    lost: tuple[str, ...]
    """The topics that lost points, in the assignment's order."""
    names: tuple[str, ...]
    """Global mistakes and faults, the likeliest first; those of a pair one after the other."""
    explained: int
    looked_at: int
    """Of the wrong pixels, by what is told first of all faults; 0 where there is none."""
    is_unknown: bool
    """Whether it was said that no known mistake explains this, or not all of it."""
    score: float
    seconds: float


class Results(Part):
    """What was told of all submissions so far, by the names of their mistakes."""

    told: dict[str, Told] = Field(default_factory=dict)


def key_of(mistakes: Sequence[Mistake]) -> str:
    """What a submission is called in the results."""
    return " + ".join(mistake.name for mistake in mistakes)


def measured(
    mistakes: tuple[Mistake, ...], assignment: Assignment, topics: Mapping[str, Sequence[Scene]], pool: Executor
) -> Told:
    """Switch the mistakes on, build the tracer, and grade it for the scenes of each topic."""
    with TemporaryDirectory(prefix="raytruth-") as folder:
        program = program_of_file(write_submission(mistakes, Path(folder)))
        return told_of(grade_submission(program, assignment, topics, Occasion(), pool))


def told_of(grade: Grade) -> Told:
    """What a grade tells of its mistakes."""
    names = [it.name for it in grade.mistakes] + [name for it in grade.diagnosis for name in it.fault.split(" + ")]
    first = grade.diagnosis[0] if grade.diagnosis else None
    return Told(
        # Sums of credits are rounded: a topic without a wrong pixel misses no thousandth of a point.
        lost=tuple(it.id for it in grade.clauses if it.points < it.maximum - 1e-3),
        names=tuple(dict.fromkeys(names)),
        explained=first.explained if first else 0,
        looked_at=first.looked_at if first else 0,
        is_unknown=bool(grade.unexplained),
        score=round(grade.score, 2),
        seconds=round(grade.seconds, 1),
    )


def load_results(path: Path = RESULTS) -> Results:
    """The results so far; none where there is no file."""
    return Results.model_validate_json(path.read_text(encoding="utf-8")) if path.exists() else Results()


def save(results: Results, path: Path = RESULTS) -> None:
    """The whole file or none of it."""
    write_whole(path, results.model_dump_json(indent=1) + "\n")
