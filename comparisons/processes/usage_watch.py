"""What all processes of a program take together, which no limit of a single process holds: memory and disk."""

from __future__ import annotations

import contextlib
import os
import time
from pathlib import Path

from raytruth.comparisons.processes.process_count import descendants_of
from raytruth.comparisons.sandboxes.folder_entries import entries_below

# Between two looks. A disk takes some hundreds of megabytes in this time, a memory a gigabyte.
_LOOK_SECONDS = 0.2
# A program may write its picture, and as much again to temporary files.
_FILES_AT_MOST = 2
# Of files and folders in its folder: a compiler's cache has hundreds; to count more would take us long.
MOST_FILES = 10_000
# Of folders in folders. A path has at most 4096 characters and a name 255 (<linux/limits.h>): what is not deeper than
# this takes 3584 of them, so that it can be counted below a work folder whose own path has up to 512.
DEEPEST = 14
_PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")
_BLOCK_BYTES = 512  # what st_blocks counts, stat(2)
_KIBIBYTE = 1 << 10
_MEBIBYTE = 1 << 20


class UsageWatch:
    """Looks now and then at how much a guarded program has written to its folder, and how much memory it has."""

    def __init__(self, guard: int, folder: Path, memory_bytes: int, file_bytes: int) -> None:
        """`memory_bytes` is for all its processes together. All its files together may have twice `file_bytes`."""
        self._guard = guard
        self._folder = folder
        self._memory_bytes = memory_bytes
        self._disk_bytes = _FILES_AT_MOST * file_bytes
        self._next_look = 0.0

    def excess(self) -> str | None:
        """Which limit is passed, as a clause; None if none is, or if the last look was a moment ago."""
        if time.monotonic() < self._next_look:
            return None
        used, files, deepest = _disk_use(self._folder)
        if used > self._disk_bytes:
            return f"wrote more than {self._disk_bytes / _MEBIBYTE:g} MiB in all"
        if files > MOST_FILES:
            return f"made more than {MOST_FILES} files"
        if deepest > DEEPEST:
            return f"made folders that are more than {DEEPEST} deep"
        if self._memory_use() > self._memory_bytes:
            return f"took more than {self._memory_bytes / _MEBIBYTE:g} MiB of memory in all its processes"
        self._next_look = time.monotonic() + _LOOK_SECONDS
        return None

    def _memory_use(self) -> int:
        """Of all processes, in bytes. What they share is counted once, but only where the quick count is too high."""
        processes = descendants_of(self._guard)
        quick = sum(_resident_bytes(process) for process in processes)
        if quick <= self._memory_bytes:
            return quick
        return sum(_proportional_bytes(process) for process in processes)


def _disk_use(folder: Path) -> tuple[int, int, int]:
    """The bytes that all below a folder takes, how many files there are, and how deep; if too many, of some."""
    used = files = deepest = 0
    for depth, entry in entries_below(folder):
        with contextlib.suppress(OSError):  # it is gone
            used += entry.stat(follow_symlinks=False).st_blocks * _BLOCK_BYTES
        files += 1
        deepest = max(deepest, depth)
        if files > MOST_FILES or deepest > DEEPEST:
            break
    return used, files, deepest


def _resident_bytes(process: int) -> int:
    with contextlib.suppress(OSError, IndexError):  # it has ended
        return int(Path(f"/proc/{process}/statm").read_text(encoding="ascii").split()[1]) * _PAGE_BYTES
    return 0


def _proportional_bytes(process: int) -> int:
    """What it has alone, and its part of what it shares; all that is resident where we may not ask."""
    with contextlib.suppress(OSError):
        for line in Path(f"/proc/{process}/smaps_rollup").read_text(encoding="ascii").splitlines():
            if line.startswith("Pss:"):
                return int(line.split()[1]) * _KIBIBYTE
    return _resident_bytes(process)
