"""The option --sandbox: a user's program in the sandbox that is chosen."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from raytruth.comparisons.attacks.ladder import chosen
from raytruth.comparisons.grading.sandboxed_submission import in_sandbox
from raytruth.comparisons.sandboxes.sandbox import SandboxError
from raytruth.errors import UsageError
from raytruth.output import tell
from raytruth.reports.sandbox_text import sandbox_sentence

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from raytruth.comparisons.attacks.ladder import Choice
    from raytruth.comparisons.records.sandbox_results import RungResult
    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer


def tell_sandbox(choice: Choice) -> RungResult:
    """The sandbox that programs run in, and what it holds, which is told. Raises UsageError if it does not work."""
    try:
        result = chosen(choice)
    except SandboxError as error:
        raise UsageError(f"--sandbox {choice}: {error}.") from error
    tell(sandbox_sentence(result))
    return result


@contextmanager
def sandboxed(
    program: ProgramRenderer, choice: Choice, hidden: Iterable[Path], shown: Iterable[Path]
) -> Iterator[tuple[ProgramRenderer, RungResult]]:
    """The program as it is to run, and what its sandbox holds, which is told. Raises UsageError if it does not work."""
    result = tell_sandbox(choice)
    try:
        if result.rung == "none":
            yield program, result
            return
        with in_sandbox(program, result.rung, hidden, shown) as confined:
            yield confined, result
    except SandboxError as error:
        raise UsageError(f"--sandbox {choice}: {error}.") from error
