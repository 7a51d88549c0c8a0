"""One run of a program in a sandbox: what is made for it beforehand, and put right afterwards."""

from __future__ import annotations

import contextlib
import os
import shutil
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.comparisons.sandboxes.bubblewrap import wrapped
from raytruth.comparisons.sandboxes.confinement import Confinement
from raytruth.comparisons.sandboxes.control_groups import control_groups
from raytruth.comparisons.sandboxes.sandbox import SandboxError, is_root, kept_environment, missing_for
from raytruth.comparisons.sandboxes.user_ids import give, reserved_user
from raytruth.comparisons.sandboxes.visible_paths import PROCESSORS, SYSTEM, installed, without_hidden

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from raytruth.comparisons.sandboxes.sandbox import Sandbox

# Devices that are no way to anything: what is written vanishes, what is read is zeros or random.
_DEVICES = tuple(Path(f"/dev/{name}") for name in ("null", "zero", "full", "random", "urandom"))
# Where everybody may leave files; only their owner and root can remove them.
_SHARED = tuple(Path(name) for name in ("/tmp", "/var/tmp", "/dev/shm", "/run/lock"))


@dataclass(frozen=True)
class SandboxedRun:
    """How a command is started so that it ends up in the sandbox."""

    command: list[str]
    environment: dict[str, str]
    confinement: Confinement | None
    """None: in no sandbox."""


@contextmanager
def sandboxed_run(
    sandbox: Sandbox, command: Sequence[str], folder: Path, scratch: Path, memory_bytes: int, extra: Mapping[str, str]
) -> Iterator[SandboxedRun]:
    """Hand the folder, with the scratch folder in it, to the program, and take it back afterwards with all in it.

    Where we are root, the program gets a user id of its own. `extra` are variables of its environment. Raises
    SandboxError.
    """
    missing = missing_for(sandbox.rung)
    if missing is not None:
        raise SandboxError(f"there is no sandbox {sandbox.rung} here: {missing}")
    system = without_hidden((path for path in SYSTEM if path.exists()), sandbox.hidden)
    visible = (*((path, path) for path in installed(extra.get("PATH", os.environ.get("PATH", "")))), *sandbox.visible)
    with ExitStack() as stack:
        user = stack.enter_context(reserved_user()) if is_root() else None
        groups = stack.enter_context(control_groups(sandbox.processes, memory_bytes))
        if user is not None:
            stack.enter_context(_owned_by(user, folder))
        inside = sandbox.rung == "bubblewrap"
        yield SandboxedRun(
            wrapped(command, folder, scratch, system, visible, user) if inside else _with_copies(command, sandbox),
            {**kept_environment(os.environ, scratch.resolve()), **extra},
            Confinement(
                groups=tuple(map(str, groups)),
                user=None if inside else user,
                processes=sandbox.processes + (0 if is_root() else _threads_of(os.getuid())),
                landlock=sandbox.rung == "landlock",
                listable=tuple(map(str, sandbox.listable)),
                readable=tuple(map(str, (*system, PROCESSORS, Path("/proc"), *(shown for _, shown in visible)))),
                writable=tuple(map(str, (folder.resolve(), *_DEVICES))),
            ),
        )


def _with_copies(command: Sequence[str], sandbox: Sandbox) -> list[str]:
    """The words with the copies of files in place of the files, where nothing but a name leads to a copy."""
    words = list(command)
    for path, shown in sandbox.visible:
        if path != shown:
            words = [
                str(shown / Path(word).relative_to(path)) if Path(word).is_relative_to(path) else word for word in words
            ]
    return words


@contextmanager
def _owned_by(user: int, folder: Path) -> Iterator[None]:
    """A folder and what it holds belongs to the user meanwhile. What the user leaves in shared folders is removed."""
    give(folder, user)
    try:
        yield
    finally:
        give(folder, os.getuid())
        for shared in _SHARED:
            _remove_entries_of(user, shared)


def _remove_entries_of(user: int, folder: Path) -> None:
    with contextlib.suppress(FileNotFoundError), os.scandir(folder) as entries:
        for entry in entries:
            # Another may have removed it since it was listed, which is as well.
            with contextlib.suppress(FileNotFoundError):
                if entry.stat(follow_symlinks=False).st_uid != user:
                    continue
                if entry.is_dir(follow_symlinks=False):
                    shutil.rmtree(entry.path, ignore_errors=True)
                else:
                    os.unlink(entry.path)  # noqa: PTH108 - a string


def _threads_of(user: int) -> int:
    """How many threads a user has on this machine, which the kernel counts together."""
    found = 0
    for process in Path("/proc").iterdir():
        if process.name.isdecimal():
            with contextlib.suppress(OSError):  # it has ended
                if process.stat().st_uid == user:
                    found += len(list((process / "task").iterdir()))
    return found
