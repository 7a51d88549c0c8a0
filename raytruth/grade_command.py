"""`raytruth grade`."""

from __future__ import annotations

import os
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from raytruth.bundles import opened_assignment, write_service_bundle
from raytruth.comparisons.attacks.ladder import Choice  # noqa: TC001 - as Path
from raytruth.comparisons.grading.assignment_file import (
    READY_FOLDER,
    STARTING,
    json_schema,
)
from raytruth.comparisons.grading.assignment_scenes import scenes_of
from raytruth.comparisons.grading.feedback import for_student
from raytruth.comparisons.grading.grade import grade_submission
from raytruth.comparisons.processes.interruption import start_worker
from raytruth.comparisons.records.class_results import Service  # noqa: TC001 - as Path
from raytruth.comparisons.records.grade_results import GRADE_FILE
from raytruth.errors import UsageError
from raytruth.grading_occasion import occasion_of
from raytruth.kept_grades import begin_results, has_grade, has_score
from raytruth.options import AsJson, expect_folder
from raytruth.output import print_json, progress, say
from raytruth.programs import the_program
from raytruth.reference_tracer.storage.cache import cache_folder
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.grade_junit import grade_junit
from raytruth.reports.grade_pages import STUDENT_PAGE, TEACHER_PAGE, grade_page
from raytruth.reports.grade_text import grade_lines
from raytruth.reports.gradescope import gradescope_results
from raytruth.sandboxed_programs import sandboxed
from raytruth.scenes.wording import quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from raytruth.comparisons.grading.assignment import Assignment, Stage
    from raytruth.comparisons.grading.grade import Occasion
    from raytruth.comparisons.records.grade_results import Grade
    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
    from raytruth.scenes.scene import Scene

FAILED = 1
GRADER_ERROR = 3


def grade(
    *command: str,
    assignment: str = STARTING,
    renderer_file: Path | None = None,
    stage: str | None = None,
    attempt: int | None = None,
    date: str | None = None,
    seed: int | None = None,
    submission_metadata: Path | None = None,
    out: Path | None = None,
    gradescope: Path | None = None,
    junit: Path | None = None,
    jobs: int | None = None,
    sandbox: Choice = "auto",
    sandbox_read: Annotated[tuple[Path, ...], Parameter(negative="")] = (),
    init: Annotated[Path | None, Parameter(show_default=False)] = None,
    schema: Annotated[bool, Parameter(negative="")] = False,
    bundle: Service | None = None,
    as_json: AsJson = False,
) -> int:
    """Grade one program: points, and a proof of what explains the pixels that are wrong.

    Parameters
    ----------
    command
        After `--`: the program and its arguments, in which {scene} is the file to read and {output} the one to write.
    assignment
        A ready assignment (spheres, shadows, mirrors, glass, whitted, extremes), or the path of a .toml file.
    renderer_file
        In place of a command: the program as this TOML file says that it is run, and what it reads and writes.
    stage
        A stage of the assignment: what is not due yet does not count.
    attempt
        Which attempt this is, from 1: some assignments tell more at later ones. By default the first.
    date
        At which date the student is told, as 2026-12-01T23:59:00+01:00; by default now.
    seed
        Added to the seeds of scenes that are drawn. By default 0, or any if the assignment draws scenes anew.
    submission_metadata
        Gradescope's submission_metadata.json, which tells the attempt, the student's deadline, and the seed for
        scenes that are drawn anew.
    out
        Write grade.json, student.html and teacher.html to this folder.
    gradescope
        Write what Gradescope reads of an autograder to this file (results.json).
    junit
        Write JUnit XML to this file.
    jobs
        How many scenes are graded side by side; one a processor by default.
    sandbox
        What the program runs in (docs/sandboxes.md): auto is the first that works here of bubblewrap, landlock,
        user; and for an ordinary user, if none of them does, none.
    sandbox_read
        Also let the program read this file or folder, beside its own and the system's.
    init
        Write an assignment with each key explained to this file, and nothing else.
    schema
        Print the JSON Schema that assignments obey, and nothing else.
    bundle
        Write what a teacher uploads to this service (gradescope, prairielearn, github-classroom), with the assignment
        whose name or path stands in place of a command, to the folder of --out, and nothing else.
    as_json
        Print the whole grade, with the solutions, as one JSON document instead of what a student is told.
    """
    if schema or init is not None or bundle is not None:
        return _written_instead(init, bundle, command, assignment, out)
    _check_numbers(attempt, jobs, seed)
    if out is not None:
        expect_folder(out)
    program = the_program("grade", command, renderer_file)
    opened, path = opened_assignment(assignment)
    opened, occasion = occasion_of(opened, stage, attempt, date, seed, submission_metadata)
    topics = _due_topics(opened, path, occasion)
    begin_results(gradescope, opened, occasion)
    hidden = [file for file in (path, cache_folder(), out, gradescope, junit) if file is not None]
    with sandboxed(program, sandbox, hidden, sandbox_read) as (confined, held), progress("Grading"):
        graded = _graded(confined, opened, topics, occasion, jobs or os.cpu_count() or 1)
    graded = graded.model_copy(update={"sandbox": held})
    shown = for_student(graded)
    _write(graded, shown, out, gradescope, junit)
    return _told(graded, shown, as_json=as_json)


def _written_instead(
    init: Path | None, bundle: Service | None, command: tuple[str, ...], assignment: str, out: Path | None
) -> int:
    """What is asked for in place of a grade: an assignment to start from, a bundle, or else the schema."""
    if init is not None:
        return _start(init)
    if bundle is not None:
        return write_service_bundle(bundle, command, assignment, out)
    print_json(json_schema())
    return 0


def _graded(
    program: ProgramRenderer,
    assignment: Assignment,
    topics: Mapping[str, Sequence[Scene]],
    occasion: Occasion,
    jobs: int,
) -> Grade:
    """In processes of their own: what fails in one of them is told in the grade."""
    cache_folder()  # what must be told of it is told once, not by each process
    with ProcessPoolExecutor(jobs, get_context("spawn"), start_worker) as pool:
        try:
            return grade_submission(program, assignment, topics, occasion, pool)
        finally:
            pool.shutdown(cancel_futures=True)


def _told(graded: Grade, shown: Grade, *, as_json: bool) -> int:
    """Print the grade; the exit status that it has."""
    if as_json:
        print_json(graded.model_dump(mode="json"))
    else:
        say("\n".join(grade_lines(shown)))
    if graded.status == "grader_error":
        return GRADER_ERROR
    return 0 if shown.score == shown.maximum else FAILED


def _write(graded: Grade, told: Grade, out: Path | None, gradescope: Path | None, junit: Path | None) -> None:
    """Each file whole or not at all; only grade.json and the teacher's page hold what is not for students.

    Where raytruth itself failed, grades of an earlier run stay as they are.
    """
    if graded.status == "grader_error":
        out, gradescope = None if has_grade(out) else out, None if has_score(gradescope) else gradescope
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        write_whole(out / GRADE_FILE, graded.model_dump_json(indent=1))
        write_whole(out / STUDENT_PAGE, grade_page(told, for_teacher=False))
        write_whole(out / TEACHER_PAGE, grade_page(graded, for_teacher=True))
    if gradescope is not None:
        write_whole(gradescope, gradescope_results(told))
    if junit is not None:
        write_whole(junit, grade_junit(told))


def _due_topics(assignment: Assignment, path: Path, occasion: Occasion) -> dict[str, tuple[Scene, ...]]:
    """The scenes that count at the occasion's stage. Raises UsageError where there are none."""
    topics = scenes_of(assignment, path.parent, occasion.seed, stage_named(assignment, occasion.stage))
    if not topics:
        raise UsageError(f"--stage: nothing is due at the stage {quoted(str(occasion.stage))}.")
    return topics


def stage_named(assignment: Assignment, name: str | None) -> Stage | None:
    """The stage of an assignment. Raises UsageError where there is none of this name."""
    if name is None:
        return None
    known = {stage.id: stage for stage in assignment.stages}
    if name not in known:
        raise UsageError(f"--stage: the assignment has no stage {quoted(name)}; {suggestion(name, sorted(known))}")
    return known[name]


def _check_numbers(attempt: int | None, jobs: int | None, seed: int | None) -> None:
    for option, number, least in (("--attempt", attempt, 1), ("--jobs", jobs, 1), ("--seed", seed, 0)):
        if number is not None and number < least:
            raise UsageError(f"{option}: expected {least} or more, found {number}.")


def _start(path: Path) -> int:
    """The file to start from. Raises UsageError where there is such a file."""
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write((READY_FOLDER / f"{STARTING}.toml").read_text(encoding="utf-8"))
    except FileExistsError as error:
        raise UsageError(f"--init: {path} is there already; it is left as it is.") from error
    say(f"Wrote {path}; edit it, then: raytruth grade --assignment {path} -- ./tracer {{scene}} {{output}}")
    return 0
