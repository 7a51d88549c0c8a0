"""Control groups: limits on all processes of a program together, where the system lets us make such groups.

Of version 2 (one tree) and of version 1 (a tree for each controller), as `man 7 cgroups` describes them.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_TREES = Path("/sys/fs/cgroup")
MEMBERS = "cgroup.procs"
# The kernel needs a moment to let go of processes that have ended, and to take back their memory on a busy machine.
_REMOVAL_SECONDS = 10.0
_PAUSE_SECONDS = 0.01


@contextmanager
def control_groups(processes: int, memory_bytes: int) -> Iterator[list[Path]]:
    """New groups with these limits, as many as can be made here: none, one for both, or one for each.

    Yields the file of each that a process writes 0 to in order to join it.
    """
    together = {"pids.max": str(processes), "memory.max": str(memory_bytes)}
    apart = [
        ("pids", {"pids.max": str(processes)}),
        ("memory", {"memory.limit_in_bytes": str(memory_bytes)}),
    ]
    made = [group for group in [_first_made(_parents(""), together)] if group]
    if not made:
        made = [group for name, limits in apart if (group := _first_made(_parents(name), limits))]
    try:
        yield [group / MEMBERS for group in made]
    finally:
        for group in made:
            _remove(group)


def _parents(controller: str) -> list[Path]:
    """Groups in which a new one might be made: our own, the one around it, and the whole tree that we see.

    The empty name is that of version 2's tree.
    """
    for line in Path("/proc/self/cgroup").read_text(encoding="utf-8").splitlines():
        _, names, path = line.split(":", 2)
        if controller in names.split(","):
            tree = _TREES / names if names else _TREES
            own = tree / path.lstrip("/")
            return [place for place in dict.fromkeys((own, own.parent, tree)) if place.is_relative_to(tree)]
    return []


def _first_made(parents: list[Path], limits: Mapping[str, str]) -> Path | None:
    for parent in parents:
        group = parent / f"raytruth-{os.getpid()}-{secrets.token_hex(4)}"
        try:
            group.mkdir()
        except OSError:  # it is not ours to change
            continue
        if not (group / MEMBERS).exists():  # a folder, and no group
            group.rmdir()
            continue
        try:
            for name, limit in limits.items():
                _write(group / name, limit)
            return group
        except OSError:  # the controller is not switched on here
            _remove(group)
    return None


def _write(path: Path, text: str) -> None:
    """To a file that is there: the kernel makes them, and nobody else can."""
    with path.open("r+", encoding="ascii") as file:
        file.write(text)


def _remove(group: Path) -> None:
    deadline = time.monotonic() + _REMOVAL_SECONDS
    while group.exists() and time.monotonic() < deadline:
        with contextlib.suppress(OSError):
            group.rmdir()
            return
        time.sleep(_PAUSE_SECONDS)
