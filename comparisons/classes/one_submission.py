"""One submission of a class from what was handed in to its grade, all in this process."""

from __future__ import annotations

import time
from concurrent.futures import Executor, Future
from contextlib import nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Literal

from raytruth.comparisons.attacks.ladder import chosen
from raytruth.comparisons.classes.archives import ArchiveError
from raytruth.comparisons.classes.likeness import explained_by, telling_pixels
from raytruth.comparisons.classes.preparation import BuildError, NoProgramError, prepared
from raytruth.comparisons.grading.grade import grade_submission
from raytruth.comparisons.grading.sandboxed_submission import in_sandbox
from raytruth.comparisons.grading.scene_grading import GradedPicture
from raytruth.comparisons.renderers.program.declared_model import output_model_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from raytruth.comparisons.attacks.ladder import Choice
    from raytruth.comparisons.classes.exports import Submission
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.grade import Occasion
    from raytruth.comparisons.records.grade_results import Grade
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class Confined:
    """What submissions are built and run in."""

    sandbox: Choice = "auto"
    hidden: tuple[Path, ...] = ()
    """What they must not see there."""


@dataclass(frozen=True)
class Job:
    """A submission, and all that it is graded by."""

    submission: Submission
    assignment: Assignment
    topics: Mapping[str, Sequence[Scene]]
    occasion: Occasion
    confined: Confined


@dataclass(frozen=True, eq=False)
class Outcome:
    """A grade with the pictures that it is for, or why there is none."""

    status: Literal["graded", "refused", "no_program", "build_failed", "grader_error"]
    reason: str = ""
    grade: Grade | None = None
    pictures: Mapping[str, NDArray[np.float32]] | None = None
    """The telling pixels of each scene's picture, for comparing submissions with one another."""
    seconds: float = 0.0
    """From unpacking to the grade."""


class _InThisProcess(Executor):
    """Does at once what it is asked for, and keeps the pictures that come of it.

    What fails is not caught: it ends this process, which works for one submission and no other.
    """

    def __init__(self) -> None:
        self.pictures: dict[str, GradedPicture] = {}

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """The result, already there."""
        future: Future[Any] = Future()
        result = fn(*args, **kwargs)
        if isinstance(result, GradedPicture):
            self.pictures[result.scene.name] = result
        future.set_result(result)
        return future


def graded_here(job: Job) -> Outcome:
    """Grade a submission in this process; what it has unpacked and built is gone afterwards."""
    start = time.perf_counter()
    outcome = _outcome(job)
    return replace(outcome, seconds=time.perf_counter() - start)


def _outcome(job: Job) -> Outcome:
    """Raises SandboxError where there is no sandbox to run it in."""
    held = chosen(job.confined.sandbox)
    rung = None if held.rung == "none" else held.rung
    with TemporaryDirectory(prefix="raytruth-") as name:
        try:
            program = prepared(job.submission, Path(name), job.assignment, rung)
        except ArchiveError as error:
            return Outcome("refused", str(error))
        except NoProgramError as error:
            return Outcome("no_program", str(error))
        except BuildError as error:
            return Outcome("build_failed", str(error))
        worker = _InThisProcess()
        with nullcontext(program) if rung is None else in_sandbox(program, rung, job.confined.hidden) as confined:
            grade = grade_submission(confined, job.assignment, job.topics, job.occasion, worker)
    grade = grade.model_copy(update={"submission": job.submission.student, "sandbox": held})
    declared = output_model_of(program.declaration)
    told = explained_by(grade, declared)
    pictures = {
        name: telling_pixels(it.scene, it.submitted.image, declared, told)
        for name, it in worker.pictures.items()
        if it.submitted.image is not None
    }
    return Outcome(grade.status, "", grade, pictures)
