"""How many processes a guarded program has: one that starts others without end would leave no room to anyone."""

from __future__ import annotations

import contextlib
import os
import signal
from pathlib import Path

from raytruth.comparisons.sandboxes.sandbox import MOST_PROCESSES

# Between two looks. In this time two processors start some hundreds of processes.
LOOK_SECONDS = 0.05


class ProcessCount:
    """Looks after the processes that come from a guard, which leads a group of its own with all of them in it."""

    def __init__(self, guard: int) -> None:
        """`guard` is the number of the guard's process, which is not reaped as long as this is in use."""
        self._guard = guard
        self._threads_before = _threads_of_the_machine()

    def is_too_high(self) -> bool:
        """Whether they are more than MOST_PROCESSES; then those of the guard's group are killed.

        To count them takes long where they take all processors. So what is looked at first is how many threads the
        whole machine has, and the group is stopped while it is counted. Who is stopped does not take leave of its
        children either, so that none of their numbers can pass to others.
        """
        if _threads_of_the_machine() - self._threads_before <= MOST_PROCESSES:
            return False
        with contextlib.suppress(ProcessLookupError):  # the guard and all others have ended
            os.killpg(self._guard, signal.SIGSTOP)
            descendants = descendants_of(self._guard)
            if len(descendants) > MOST_PROCESSES:
                for process in descendants:
                    with contextlib.suppress(ProcessLookupError):  # it is not of the group, and has ended by itself
                        os.kill(process, signal.SIGKILL)
                return True
            os.killpg(self._guard, signal.SIGCONT)
        return False


def _threads_of_the_machine() -> int:
    """How many threads there are: a load of `1.86 1.27 0.84 2/311 4711` says 311."""
    return int(Path("/proc/loadavg").read_text(encoding="ascii").split()[3].partition("/")[2])


def descendants_of(process: int) -> list[int]:
    """The numbers of all processes that come from this one, which are children of any of its threads."""
    found = [process]
    for known in found:
        with contextlib.suppress(OSError):  # it has ended
            for thread in Path(f"/proc/{known}/task").iterdir():
                found += map(int, (thread / "children").read_text(encoding="ascii").split())
    return found[1:]
