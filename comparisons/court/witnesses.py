"""Who is asked by the court: programs of others, each in a process of its own, and forms of ours."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from pydantic import ValidationError

from raytruth.comparisons.court.forms import all_forms
from raytruth.comparisons.court.questions import ANSWERS_FILE, Answer, Answers, write_questions
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.records.renderings import RendererError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.court.questions import Question

# Some dozen rays take milliseconds. Blender takes a second to start, Mitsuba's LLVM variant some more to compile for
# each new kind of scene; a hang must not stop the court for long.
TIME_LIMIT = 120.0
# As for renderers: Mitsuba's LLVM variant and Embree's threads reserve address space that they never use.
MEMORY_LIMIT = 8 << 30
# An answer is a line of a hundred characters.
ANSWERS_BYTES = 1 << 24

WORKERS = {
    "embree": ("embree", "fast"),
    "embree-robust": ("embree", "robust"),
    "mitsuba": ("mitsuba", "scalar_rgb"),
    "mitsuba-llvm": ("mitsuba", "llvm_ad_rgb"),
    "vtk": ("vtk",),
    "blender": ("blender",),
}
"""For each program the name of its worker in `workers/`, and what that is called with."""


@dataclass(frozen=True)
class Statement:
    """What one witness says of all questions, or why it says nothing."""

    witness: str
    version: str | None
    answers: tuple[Answer | None, ...]
    """None for a shape that the witness does not know, and for all where there is an error."""
    error: str | None = None


def statements(questions: tuple[Question, ...]) -> Iterator[Statement]:
    """Of all programs, one after the other, then of our forms."""
    for name, (worker, *arguments) in WORKERS.items():
        command = [sys.executable, "-P", "-m", f"raytruth.comparisons.court.workers.{worker}", *arguments]
        try:
            heard = hear(command, questions)
        except RendererError as error:
            yield Statement(name, None, (None,) * len(questions), str(error))
        else:
            yield Statement(name, heard.version, heard.answers)
    for name, form in all_forms().items():
        yield Statement(name, version("raytruth"), tuple(form(question) for question in questions))


def hear(command: list[str], questions: tuple[Question, ...]) -> Answers:
    """What a worker answers. Raises RendererError where it fails, or does not give one answer to each question."""
    with TemporaryDirectory(prefix="raytruth-") as name:
        folder = Path(name)
        write_questions(folder, questions)
        run_isolated(command, folder, seconds=TIME_LIMIT, memory_bytes=MEMORY_LIMIT, file_bytes=ANSWERS_BYTES)
        try:
            answers = Answers.model_validate_json((folder / ANSWERS_FILE).read_bytes())
        except (OSError, ValidationError) as error:
            raise RendererError(f"its {ANSWERS_FILE} cannot be read: {str(error).splitlines()[0]}") from error
    if len(answers.answers) != len(questions):
        raise RendererError(f"it gave {len(answers.answers)} answers to {len(questions)} questions")
    return answers
