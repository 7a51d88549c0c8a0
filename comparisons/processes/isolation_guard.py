"""The process between us and a program that may misbehave: it sets limits, and ends whatever the program leaves behind.

Run by isolation.py as `python -I -S isolation_guard.py STATUS_FD MEMORY_BYTES FILE_BYTES COMMAND…`. It uses the
standard library only. A descendant whose parent ends becomes a child of this process, in whatever session or group it
is, so that none escapes. What came of the program is written to STATUS_FD: its return code as subprocess counts, and
how many processes it left behind.
"""

from __future__ import annotations

import ctypes
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import NoReturn

# <linux/prctl.h>
PR_SET_PDEATHSIG = 1
PR_SET_CHILD_SUBREAPER = 36
# Helpers of a well-behaved program may end a little later than itself.
GRACE_SECONDS = 1.0
_PAUSE_SECONDS = 0.01
NOT_FOUND = 127
"""The status of a shell that finds no such command."""


def main() -> None:
    """Run the command under its limits, end all that it leaves behind, and report how it ended."""
    status, memory_bytes, file_bytes = (int(argument) for argument in sys.argv[1:4])
    signal.signal(signal.SIGTERM, _stop)
    library = ctypes.CDLL(None, use_errno=True)
    for option, value in ((PR_SET_CHILD_SUBREAPER, 1), (PR_SET_PDEATHSIG, signal.SIGTERM)):
        if library.prctl(option, value, 0, 0, 0):
            raise OSError(ctypes.get_errno(), f"prctl option {option}")
    limits = {resource.RLIMIT_CORE: 0, resource.RLIMIT_AS: memory_bytes, resource.RLIMIT_FSIZE: file_bytes}
    try:
        returncode = _run(sys.argv[4:], limits)
        left = _wait_for_the_last()
    finally:
        _end_descendants()
    os.write(status, f"{returncode} {left}".encode())


def _stop(*_: object) -> NoReturn:
    """Leaves main by way of its `finally`."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    sys.exit(1)


def _run(command: list[str], limits: dict[int, int]) -> int:
    def set_limits() -> None:
        for limit, most in limits.items():
            hardest = resource.getrlimit(limit)[1]
            least = most if hardest == resource.RLIM_INFINITY else min(most, hardest)
            resource.setrlimit(limit, (least, least))

    try:
        # Set between fork and exec, which is safe here: this process has no threads.
        return subprocess.Popen(command, preexec_fn=set_limits).wait()  # noqa: PLW1509 - as the comment says
    except OSError as error:
        print(f"{command[0]}: {error.strerror}: not found or not executable", file=sys.stderr, flush=True)
        return NOT_FOUND


def _wait_for_the_last() -> int:
    """How many descendants do not end within the grace."""
    deadline = time.monotonic() + GRACE_SECONDS
    while _children() and time.monotonic() < deadline:
        _reap()
        time.sleep(_PAUSE_SECONDS)
    return len(_children())


def _end_descendants() -> None:
    """Kill all children until no new ones come: those of a killed child become ours."""
    while children := _children():
        for child in children:
            os.kill(child, signal.SIGKILL)  # not reaped yet, so that its number cannot have passed to others
        _reap()
        time.sleep(_PAUSE_SECONDS)


def _children() -> list[int]:
    """The numbers of this process's children, zombies not counted."""
    _reap()
    return [int(number) for number in Path("/proc/thread-self/children").read_text(encoding="ascii").split()]


def _reap() -> None:
    """Take leave of all children that have ended."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:  # there are none
        pass


if __name__ == "__main__":
    main()
