"""A class graded: each submission by itself, side by side, resumed where it was broken off, and none lost."""

from __future__ import annotations

from concurrent.futures import FIRST_COMPLETED, wait
from dataclasses import dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING

from raytruth.comparisons.classes.apart import apart
from raytruth.comparisons.classes.class_files import (
    KeptRow,
    asked_digest,
    code_digest,
    folder_names,
    given_digest,
    keep_pictures,
    keep_row,
    kept_grade,
    kept_row,
)
from raytruth.comparisons.classes.grouping import group_of, why_moved
from raytruth.comparisons.classes.one_submission import Confined, Job, Outcome, graded_here
from raytruth.comparisons.grading.credit import score_of
from raytruth.comparisons.records.class_results import STUDENTS_FOLDER, ClassRow, Move
from raytruth.comparisons.records.grade_results import Grade

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from concurrent.futures import Executor, Future
    from pathlib import Path

    from raytruth.comparisons.classes.exports import Submission
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.grade import Occasion
    from raytruth.scenes.scene import Scene

_WORDS = {
    "refused": "refused as it was handed in",
    "no_program": "no program was found",
    "build_failed": "it could not be built",
    "grader_error": "raytruth itself failed",
}
"""The groups of submissions without a grade."""


@dataclass(frozen=True)
class ClassPlan:
    """What there is to do for a class, and what is there already."""

    out: Path
    assignment: Assignment
    topics: Mapping[str, Sequence[Scene]]
    occasion: Occasion
    folders: Mapping[str, Submission]
    """The submissions, by their folders."""
    given: Mapping[str, str]
    """A digest of each and of what it is graded by."""
    kept: Mapping[str, ClassRow]
    """The rows of those that need not be graded again."""
    by_other_code: int
    """How many of these were graded by another state of raytruth."""
    confined: Confined

    @property
    def left(self) -> list[str]:
        """The folders of those that are to be graded."""
        return [folder for folder in self.folders if folder not in self.kept]

    @property
    def maximum(self) -> float:
        """What a submission without a mistake gets."""
        return score_of([(most, most) for most in self.most_points().values()], 0, self.assignment)

    def most_points(self) -> dict[str, float]:
        """Of each topic that has scenes."""
        weights = {topic.id: topic.weight for topic in self.assignment.topics if topic.id in self.topics}
        return {topic: self.assignment.points * weight / sum(weights.values()) for topic, weight in weights.items()}


def plan_of(
    submissions: Sequence[Submission],
    out: Path,
    assignment: Assignment,
    topics: Mapping[str, Sequence[Scene]],
    occasion: Occasion,
    confined: Confined,
    *,
    regrade: bool = False,
    fresh: bool = False,
) -> ClassPlan:
    """What is to be graded: what has no row of its own yet, what failed, and what is another submission now.

    With `regrade` also what another state of raytruth has graded; with `fresh` all.
    """
    scenes = [scene.model_dump_json() for of_topic in topics.values() for scene in of_topic]
    asked, code = asked_digest(assignment, scenes, occasion), code_digest()
    folders = dict(zip(folder_names(submissions), submissions, strict=True))
    given = {folder: given_digest(submission, asked) for folder, submission in folders.items()}
    kept: dict[str, ClassRow] = {}
    others = 0
    for folder in folders:
        found = None if fresh else kept_row(out, folder)
        if found is None or found.given != given[folder] or found.row.status == "grader_error":
            continue
        if found.code != code and regrade:
            continue
        kept[folder] = found.row
        others += found.code != code
    return ClassPlan(out, assignment, topics, occasion, folders, given, kept, others, confined)


def class_rows(
    plan: ClassPlan, pool: Executor, workers: int, write_pages: Callable[[str, Grade], None]
) -> Iterator[ClassRow]:
    """The rows of the submissions that are left, as they are done; each is kept before it is given.

    Only this process writes: so nothing is half-written or written twice, wherever a submission is graded, and however
    often a cluster has to begin it again.
    """
    waiting = list(reversed(plan.left))
    running: dict[Future[Outcome], str] = {}
    while waiting or running:
        # A few more than can be worked at, so that nobody waits for the next; not all, so that little is dropped.
        while waiting and len(running) < 2 * workers:
            folder = waiting.pop()
            job = Job(plan.folders[folder], plan.assignment, plan.topics, plan.occasion, plan.confined)
            running[pool.submit(apart, graded_here, job)] = folder
        for done in wait(running, return_when=FIRST_COMPLETED).done:
            folder = running.pop(done)
            failure = done.exception()
            outcome = done.result() if failure is None else Outcome("grader_error", str(failure))
            yield _kept(plan, folder, outcome, write_pages)


def _kept(plan: ClassPlan, folder: str, outcome: Outcome, write_pages: Callable[[str, Grade], None]) -> ClassRow:
    """Write all of a submission, its row last. An earlier grade stays where raytruth itself has failed now."""
    before, earlier = kept_row(plan.out, folder), kept_grade(plan.out, folder)
    row = _row(plan, folder, outcome)
    if before is not None and before.given == plan.given[folder]:
        if outcome.status == "grader_error" and before.row.status != "grader_error":
            told = f"It could not be graded again, so that its grade is as before: {row.reason}"
            return before.row.model_copy(update={"reason": told})
        if row.score != before.row.score:
            why = why_moved(earlier if before.row.score is not None else None, outcome.grade)
            row = row.model_copy(update={"move": Move(before=before.row.score, after=row.score, why=why)})
    (plan.out / STUDENTS_FOLDER / folder).mkdir(parents=True, exist_ok=True)
    keep_pictures(plan.out, folder, outcome.pictures or {})
    write_pages(folder, outcome.grade or _without_points(plan, row))
    keep_row(plan.out, KeptRow(given=plan.given[folder], code=code_digest(), row=row))
    return row


def _without_points(plan: ClassPlan, row: ClassRow) -> Grade:
    """The grade of a submission that could not be run, which tells its student why."""
    return Grade(
        raytruth_version=version("raytruth"),
        assignment=plan.assignment.name,
        title=plan.assignment.title,
        submission=row.student,
        stage=plan.occasion.stage,
        attempt=plan.occasion.attempt,
        told="diagnosis",  # the reason is nothing to hold back
        status="grader_error" if row.status == "grader_error" else "graded",
        score=row.score or 0.0,
        maximum=row.maximum,
        clauses=(),
        mistakes=(),
        scenes=(),
        diagnosis=(),
        unexplained=row.reason,
        seconds=row.seconds,
    )


def _row(plan: ClassPlan, folder: str, outcome: Outcome) -> ClassRow:
    submission, grade = plan.folders[folder], outcome.grade
    failed = outcome.status == "grader_error"
    reason = outcome.reason
    if grade is not None and failed:
        reason = "; ".join(f"{it.name}: {it.reason}" for it in grade.scenes if it.verdict == "grader_error")
    graded = grade is not None and not failed
    return ClassRow(
        folder=folder,
        student=submission.student,
        identifier=submission.identifier,
        email=submission.email,
        status=outcome.status,
        reason=reason,
        score=None if failed else grade.score if grade is not None else 0.0,
        maximum=plan.maximum,
        topics={it.id: it.points for it in grade.clauses} if grade is not None and graded else {},
        group=group_of(grade) if grade is not None and graded else _WORDS[outcome.status],
        seconds=outcome.seconds,
    )
