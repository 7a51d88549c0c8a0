"""A submission in a sandbox: what of the machine's files is its own, and what it must not see."""

from __future__ import annotations

import os
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

from raytruth.comparisons.renderers.program.command import counted_files
from raytruth.comparisons.sandboxes.open_files import is_open_to_others, opened
from raytruth.comparisons.sandboxes.sandbox import Sandbox, SandboxError, is_root
from raytruth.comparisons.sandboxes.visible_paths import installation_of, installed, own_files, without_hidden

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

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
    declared, secrets = program.declaration, tuple(hidden)
    search_path = declared.environment.get("PATH", os.environ.get("PATH", ""))
    files = counted_files(declared.command, program.folder, declared.environment, declared.files)
    elsewhere = installed(search_path)
    own = list(own_files(path for path in files if not any(path.is_relative_to(folder) for folder in elsewhere)))
    if declared.uses("folder"):
        own.append(program.folder)
    own = _outermost(own)
    visible = without_hidden(own, secrets)
    in_part = tuple(path for path in own if path.is_dir() and path not in visible)
    others = [*installation_of(files[0], search_path), *(path.resolve() for path in shown)]
    others = list(without_hidden(others, secrets))
    with opened(visible, in_part) as names:
        sandbox = Sandbox(rung, (*names, *((path, path) for path in others)), in_part, secrets)
        _check([files[0], *others], sandbox)
        yield replace(program, sandbox=sandbox)


def _outermost(paths: Iterable[Path]) -> list[Path]:
    """Those that lie in no other."""
    given = list(dict.fromkeys(path.absolute() for path in paths))
    return [path for path in given if not any(path != other and path.is_relative_to(other) for other in given)]


def _check(paths: Iterable[Path], sandbox: Sandbox) -> None:
    """Raise SandboxError where the user that a submission runs as may not read what it needs, by its own name."""
    if not is_root() or sandbox.rung == "bubblewrap":
        return
    copied = [name for name, shown in sandbox.visible if name != shown]
    for path in paths:
        if not is_open_to_others(path) and not any(path.is_relative_to(name) for name in copied):
            raise SandboxError(
                f"a submission never runs as root, and other users may not read {path.resolve()}; put it where all may"
            )
