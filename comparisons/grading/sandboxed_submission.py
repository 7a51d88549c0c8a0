"""A submission in a sandbox: what of the machine's files is its own, and what it must not see."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.comparisons.renderers.program.command import counted_files
from raytruth.comparisons.sandboxes.open_files import is_open_to_others, opened
from raytruth.comparisons.sandboxes.sandbox import Sandbox, SandboxError, is_root
from raytruth.comparisons.sandboxes.visible_paths import installed, own_files, without_hidden

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
    from raytruth.comparisons.sandboxes.sandbox import Rung


@contextmanager
def in_sandbox(
    program: ProgramRenderer, rung: Rung, hidden: Iterable[Path], shown: Iterable[Path] = ()
) -> Iterator[ProgramRenderer]:
    """The program as it runs on a rung of the ladder, as long as this holds.

    It sees the folders of the files that its command names, what its declaration counts among its files, and `shown`;
    nothing of `hidden`, even if it lies in these. Raises SandboxError where it cannot be run there.
    """
    declared = program.declaration
    files = counted_files(declared.command, program.folder, declared.environment, declared.files)
    elsewhere = installed(declared.environment.get("PATH"))
    own = list(own_files(path for path in files if not any(path.is_relative_to(folder) for folder in elsewhere)))
    own += [path.resolve() for path in shown]
    if declared.uses("folder"):
        own.append(program.folder)
    visible = without_hidden(_outermost(own), hidden)
    with opened(visible) as names:
        sandbox = Sandbox(rung, names)
        _check(files[0], sandbox)
        yield replace(program, sandbox=sandbox)


def _outermost(paths: Iterable[Path]) -> list[Path]:
    """Those that lie in no other."""
    given = list(dict.fromkeys(path.absolute() for path in paths))
    return [path for path in given if not any(path != other and path.is_relative_to(other) for other in given)]


def _check(program: Path, sandbox: Sandbox) -> None:
    """Raise SandboxError where the user that a submission runs as may not run what its command begins with."""
    is_own = any(program.is_relative_to(name) for name, _ in sandbox.visible)
    if is_root() and sandbox.rung != "bubblewrap" and not is_own and not is_open_to_others(program):
        raise SandboxError(
            f"a submission never runs as root, and other users may not run {program.resolve()}; install it where all may"
        )
