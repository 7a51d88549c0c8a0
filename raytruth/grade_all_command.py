"""`raytruth grade-all`."""

from __future__ import annotations

import time
from contextlib import contextmanager
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from pydantic import ValidationError

from raytruth.bundles import opened_assignment
from raytruth.comparisons.attacks.ladder import Choice  # noqa: TC001 - as AsJson
from raytruth.comparisons.classes.archives import EXPORT_ROOM, ArchiveError, is_archive, unpack
from raytruth.comparisons.classes.class_files import kept_pictures
from raytruth.comparisons.classes.class_run import class_rows, plan_of
from raytruth.comparisons.classes.class_scenes import make_expectations
from raytruth.comparisons.classes.exports import submissions_in
from raytruth.comparisons.classes.likeness import likenesses
from raytruth.comparisons.classes.one_submission import Confined
from raytruth.comparisons.classes.workers import ClusterError, cluster_workers, local_workers
from raytruth.comparisons.grading.assignment import Assignment
from raytruth.comparisons.grading.assignment_file import STARTING
from raytruth.comparisons.grading.assignment_scenes import scenes_of
from raytruth.comparisons.grading.feedback import for_student
from raytruth.comparisons.grading.grade import Occasion
from raytruth.comparisons.records.class_results import CLASS_FILE, STUDENTS_FOLDER, ClassResults, Service
from raytruth.comparisons.records.grade_results import GRADE_FILE
from raytruth.errors import UsageError
from raytruth.grade_command import stage_named
from raytruth.options import AsJson, expect_folder
from raytruth.output import print_json, print_table, progress, say, tell
from raytruth.reference_tracer.storage.cache import cache_folder
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.class_page import CLASS_PAGE, class_headline, class_page
from raytruth.reports.class_tables import (
    CANVAS_CSV,
    CLASS_CSV,
    HEADERS,
    MOODLE_CSV,
    canvas_csv,
    class_csv,
    moodle_csv,
    table_rows,
    what_explains,
)
from raytruth.reports.grade_pages import STUDENT_PAGE, TEACHER_PAGE, grade_page
from raytruth.reports.grade_text import points
from raytruth.reports.service_results import service_results
from raytruth.sandboxed_programs import tell_sandbox
from raytruth.scenes.validation import problems_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from concurrent.futures import Executor
    from contextlib import AbstractContextManager

    from raytruth.comparisons.classes.class_run import ClassPlan
    from raytruth.comparisons.records.class_results import ClassRow
    from raytruth.comparisons.records.grade_results import Grade

NOT_RUN = 1
RESULTS_FILE = "results.json"
GRADER_ERROR = 3
# As many as the smallest machine has processors; the programs that are graded have processes of their own beside them.
WORKERS = 2


def grade_all(
    submissions: Path,
    *,
    assignment: str = STARTING,
    out: Path = Path("graded"),
    run: str | None = None,
    build: str | None = None,
    stage: str | None = None,
    attempt: int = 1,
    seed: int = 0,
    workers: int = WORKERS,
    scheduler: str | None = None,
    sandbox: Choice = "auto",
    results_for: Service | None = None,
    regrade: bool = False,
    fresh: bool = False,
    as_json: AsJson = False,
) -> int:
    """Grade a class: every submission in a folder, or in what a learning platform exports.

    Parameters
    ----------
    submissions
        A folder with a folder or an archive (zip, tar, git bundle) for each student; or an export of
        Gradescope, Moodle, Canvas or GitHub Classroom, as a folder or as the archive that it comes in.
    assignment
        A ready assignment (spheres, shadows, mirrors, glass, whitted, extremes), or the path of a .toml file.
    out
        The folder of results, which an interrupted run resumes from.
    run
        How each submission is run, as './tracer {scene} {output}.pfm'; else as the assignment or its tracer.toml says.
    build
        What is run in a submission's folder before, as 'make'; else as the assignment says.
    stage
        A stage of the assignment: what is not due yet does not count.
    attempt
        Which attempt this is, from 1: some assignments tell more at later ones.
    seed
        Added to the seeds of scenes that are drawn.
    workers
        How many submissions are graded side by side on this machine.
    scheduler
        The address of a Dask scheduler, as tcp://host:8786: its workers grade in place of this machine.
    sandbox
        What submissions are built and run in (docs/sandboxes.md): auto is the first that works of bubblewrap,
        landlock, user; and for an ordinary user, if none of them does, none.
    results_for
        Write each student's results.json as gradescope, prairielearn or github-classroom reads it.
    regrade
        Grade again what another state of raytruth has graded, and show which grades move, and why.
    fresh
        Grade all again.
    as_json
        Print the class, with what explains each submission, as one JSON document.
    """
    _check_numbers(attempt, workers, seed)
    expect_folder(out)
    opened, path = opened_assignment(assignment)
    opened = _with_options(opened, run, build)
    topics = scenes_of(opened, path.parent, seed, stage_named(opened, stage))
    if not topics:
        raise UsageError(f"--stage: nothing is due at the stage '{stage}'.")
    out.mkdir(parents=True, exist_ok=True)
    with _opened_submissions(submissions, out) as folder:
        found = submissions_in(folder)
        if not found:
            raise UsageError(f"{submissions}: expected a folder or an archive for each student, found none.")
        occasion = Occasion(stage, attempt, datetime.now(UTC), seed)
        confined = Confined(sandbox, (folder, submissions, out, path, cache_folder()))
        plan = plan_of(found, out, opened, topics, occasion, confined, regrade=regrade, fresh=fresh)
        if scheduler is None and plan.left:  # a cluster's workers find out for themselves
            tell_sandbox(sandbox)
        rows = _graded(plan, workers, scheduler, results_for)
    results = _results(plan, rows)
    _write(results, out)
    _tell_results(results, out, as_json=as_json)
    return _status(results)


def _status(results: ClassResults) -> int:
    """The exit status that a class has."""
    statuses = {row.status for row in results.rows}
    return GRADER_ERROR if "grader_error" in statuses else 0 if statuses == {"graded"} else NOT_RUN


def _check_numbers(attempt: int, workers: int, seed: int) -> None:
    for option, number, least in (("--attempt", attempt, 1), ("--workers", workers, 1), ("--seed", seed, 0)):
        if number < least:
            raise UsageError(f"{option}: expected {least} or more, found {number}.")


def _with_options(assignment: Assignment, run: str | None, build: str | None) -> Assignment:
    """The assignment with what the command line says otherwise. Raises UsageError."""
    given = {key: text for key, text in (("run", run), ("build", build)) if text is not None}
    try:
        return Assignment.model_validate(assignment.model_dump() | given)
    except ValidationError as error:
        told = [f"--{where}: {sentence}" for where, sentence in problems_of(error, root=Assignment)]
        raise UsageError("\n".join(told)) from error


@contextmanager
def _opened_submissions(path: Path, out: Path) -> Iterator[Path]:
    """The folder of submissions; of an archive what is in it, for as long as the block takes. Raises UsageError."""
    if path.is_dir():
        yield path
        return
    if not is_archive(path):
        raise UsageError(f"{path}: expected a folder of submissions, or the archive of an export, found neither.")
    with TemporaryDirectory(dir=out, prefix=".unpacked-") as name:
        folder = Path(name) / path.name.partition(".")[0]
        folder.mkdir()
        left_out: list[str] = []
        try:
            unpack(path, folder, EXPORT_ROOM, left_out)
        except ArchiveError as error:
            raise UsageError(str(error)) from error
        for sentence in left_out:
            tell(f"Left out: {sentence}")
        yield folder


def _graded(plan: ClassPlan, workers: int, scheduler: str | None, service: Service | None) -> dict[str, ClassRow]:
    """The rows of all submissions, by their folders, with a line for each that is done. Raises UsageError."""
    rows = dict(plan.kept)
    if rows:
        told = f"{len(rows)} of {len(plan.folders)} submissions are graded already"
        others = f", {plan.by_other_code} of them by another state of raytruth: --regrade grades these again"
        tell(f"{told}{others if plan.by_other_code else ''}.")
    if not plan.left:
        return rows
    cache_folder()  # what must be told of it is told once, not by each process
    try:
        with _workers(workers, scheduler) as (pool, count):
            scenes = list({scene.name: scene for of_topic in plan.topics.values() for scene in of_topic}.values())
            with progress(f"Finding out what the pixels of {len(scenes)} scenes may be"):
                make_expectations(scenes, plan.assignment, pool, count)
            start = time.perf_counter()
            left = len(plan.left)
            for number, row in enumerate(
                class_rows(plan, pool, count, lambda *it: _write_pages(plan.out, service, *it)), start=1
            ):
                rows[row.folder] = row
                seconds = (time.perf_counter() - start) / number * (left - number)
                tell(f"{number} of {left}: {_told(row)} About {_duration(seconds)} left.")
    except ClusterError as error:
        raise UsageError(str(error)) from error
    return rows


def _workers(count: int, scheduler: str | None) -> AbstractContextManager[tuple[Executor, int]]:
    return cluster_workers(scheduler) if scheduler is not None else local_workers(count)


def _told(row: ClassRow) -> str:
    score = "no grade" if row.score is None else f"{points(row.score)} of {points(row.maximum)} points"
    return f"{row.student}: {score} ({what_explains(row).rstrip('.')})."


def _duration(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 90 else f"{seconds / 60:.0f} min"


def _write_pages(out: Path, service: Service | None, folder: str, grade: Grade) -> None:
    """A grade and its two pages; only the student's holds no solution."""
    own = out / STUDENTS_FOLDER / folder
    if service is not None:
        write_whole(own / RESULTS_FILE, service_results(service, for_student(grade)))
    write_whole(own / GRADE_FILE, grade.model_dump_json(indent=1))
    write_whole(own / STUDENT_PAGE, grade_page(for_student(grade), for_teacher=False))
    write_whole(own / TEACHER_PAGE, grade_page(grade, for_teacher=True))


def _results(plan: ClassPlan, rows: dict[str, ClassRow]) -> ClassResults:
    titles = {topic.id: topic.title for topic in plan.assignment.topics}
    return ClassResults(
        raytruth_version=version("raytruth"),
        assignment=plan.assignment.name,
        title=plan.assignment.title,
        maximum=plan.maximum,
        topics={topic: (titles[topic], most) for topic, most in plan.most_points().items()},
        rows=tuple(sorted((rows[folder] for folder in plan.folders), key=lambda row: (row.student, row.folder))),
        likenesses=tuple(likenesses({folder: kept_pictures(plan.out, folder) for folder in plan.folders})),
    )


def _write(results: ClassResults, out: Path) -> None:
    """Each file whole or not at all."""
    write_whole(out / CLASS_FILE, results.model_dump_json(indent=1))
    write_whole(out / CLASS_CSV, class_csv(results))
    if any(row.identifier.isdecimal() for row in results.rows):  # as these two number students
        write_whole(out / MOODLE_CSV, moodle_csv(results))
        write_whole(out / CANVAS_CSV, canvas_csv(results))
    write_whole(out / CLASS_PAGE, class_page(results))


def _tell_results(results: ClassResults, out: Path, *, as_json: bool) -> None:
    if as_json:
        print_json(results.model_dump(mode="json"))
        return
    print_table(HEADERS, table_rows(results))
    for row in results.rows:
        if row.move is not None:
            before, after = ("no grade" if it is None else points(it) for it in (row.move.before, row.move.after))
            say(f"{row.student} moved from {before} to {after}: {' '.join(row.move.why)}")
    say(f"{class_headline(results)} See {out / CLASS_PAGE}.")
