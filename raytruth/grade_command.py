"""`raytruth grade`."""

from __future__ import annotations

import os
import shlex
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from raytruth.comparisons.grading.assignment_file import (
    READY_FOLDER,
    STARTING,
    AssignmentError,
    assignment_path,
    json_schema,
    load_assignment,
)
from raytruth.comparisons.grading.assignment_scenes import scenes_of
from raytruth.comparisons.grading.feedback import for_student
from raytruth.comparisons.grading.grade import Occasion, grade_submission
from raytruth.comparisons.processes.interruption import start_worker
from raytruth.comparisons.records.grade_results import GRADE_FILE
from raytruth.errors import UsageError
from raytruth.options import AsJson, expect_folder
from raytruth.output import print_json, progress, say
from raytruth.programs import programs_of
from raytruth.reference_tracer.storage.cache import cache_folder
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.grade_junit import grade_junit
from raytruth.reports.grade_pages import STUDENT_PAGE, TEACHER_PAGE, grade_page
from raytruth.reports.grade_text import grade_lines
from raytruth.reports.gradescope import gradescope_results
from raytruth.scenes.wording import quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from raytruth.comparisons.grading.assignment import Assignment, Stage
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
    attempt: int = 1,
    seed: int = 0,
    out: Path | None = None,
    gradescope: Path | None = None,
    junit: Path | None = None,
    jobs: int | None = None,
    init: Annotated[Path | None, Parameter(show_default=False)] = None,
    schema: Annotated[bool, Parameter(negative="")] = False,
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
        Which attempt this is, from 1: some assignments tell more at later ones.
    seed
        Added to the seeds of scenes that are drawn, so that each submission may have its own.
    out
        Write grade.json, student.html and teacher.html to this folder.
    gradescope
        Write what Gradescope reads of an autograder to this file (results.json).
    junit
        Write JUnit XML to this file.
    jobs
        How many scenes are graded side by side; one a processor by default.
    init
        Write an assignment with each key explained to this file, and nothing else.
    schema
        Print the JSON Schema that assignments obey, and nothing else.
    as_json
        Print the whole grade, with the solutions, as one JSON document instead of what a student is told.
    """
    if schema:
        print_json(json_schema())
        return 0
    if init is not None:
        return _start(init)
    _check_numbers(attempt, jobs, seed)
    if out is not None:
        expect_folder(out)
    program = _program(command, renderer_file)
    opened, path = _opened(assignment)
    due = _stage(opened, stage)
    topics = scenes_of(opened, path.parent, seed, due)
    if not topics:
        raise UsageError(f"--stage: nothing is due at the stage {quoted(str(stage))}.")
    with progress("Grading"):
        graded = _graded(program, opened, topics, Occasion(stage, attempt), jobs or os.cpu_count() or 1)
    _write(graded, out, gradescope, junit)
    if as_json:
        print_json(graded.model_dump(mode="json"))
    else:
        say("\n".join(grade_lines(for_student(graded))))
    if graded.status == "grader_error":
        return GRADER_ERROR
    return 0 if graded.score == graded.maximum else FAILED


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


def _write(graded: Grade, out: Path | None, gradescope: Path | None, junit: Path | None) -> None:
    """Each file whole or not at all; only grade.json and the teacher's page hold what is not for students."""
    told = for_student(graded)
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        write_whole(out / GRADE_FILE, graded.model_dump_json(indent=1))
        write_whole(out / STUDENT_PAGE, grade_page(told, for_teacher=False))
        write_whole(out / TEACHER_PAGE, grade_page(graded, for_teacher=True))
    if gradescope is not None:
        write_whole(gradescope, gradescope_results(told))
    if junit is not None:
        write_whole(junit, grade_junit(told))


def _program(command: tuple[str, ...], file: Path | None) -> ProgramRenderer:
    """The one program to grade. Raises UsageError with every mistake of its declaration."""
    if bool(command) == (file is not None):
        found = "both" if command else "neither"
        raise UsageError(f"grade: expected a command after -- or --renderer-file FILE, found {found}.")
    commands = [f"submission={shlex.join(command)}"] if command else []
    (program,) = programs_of(commands, [file] if file is not None else []).values()
    return program


def _opened(name_or_path: str) -> tuple[Assignment, Path]:
    try:
        path = assignment_path(name_or_path)
        return load_assignment(path), path
    except AssignmentError as error:
        raise UsageError(str(error)) from error


def _stage(assignment: Assignment, name: str | None) -> Stage | None:
    if name is None:
        return None
    known = {stage.id: stage for stage in assignment.stages}
    if name not in known:
        raise UsageError(f"--stage: the assignment has no stage {quoted(name)}; {suggestion(name, sorted(known))}")
    return known[name]


def _check_numbers(attempt: int, jobs: int | None, seed: int) -> None:
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
