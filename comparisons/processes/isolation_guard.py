"""The process between us and a program that may misbehave: it sets limits, and ends whatever the program leaves behind.

Run by isolation.py as `python -I -S isolation_guard.py STATUS_FD JOB COMMAND…`, where JOB is a Job in JSON. It uses the
standard library only, unless the program is to be confined. A descendant whose parent ends becomes a child of this
process, in whatever session or group it is, so that none escapes. What came of the program is written to STATUS_FD: its
return code as subprocess counts, and how many processes it left behind; or why it could not be confined.
"""

from __future__ import annotations

import ctypes
import json
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from collections.abc import Callable

# <linux/prctl.h>
PR_SET_PDEATHSIG = 1
PR_SET_CHILD_SUBREAPER = 36
PR_SET_NO_NEW_PRIVS = 38
# Helpers of a well-behaved program may end a little later than itself.
GRACE_SECONDS = 1.0
_PAUSE_SECONDS = 0.01
NOT_FOUND = 127
"""The status of a shell that finds no such command."""


def main() -> None:
    """Run the command under its limits, end all that it leaves behind, and report how it ended."""
    status, job = int(sys.argv[1]), json.loads(sys.argv[2])
    signal.signal(signal.SIGTERM, _stop)
    _set(PR_SET_CHILD_SUBREAPER, 1)
    _set(PR_SET_PDEATHSIG, signal.SIGTERM)
    try:
        returncode = _run(sys.argv[3:], _set_up(job))
        told = f"{returncode} {_wait_for_the_last()}"
    except (subprocess.SubprocessError, ImportError, OSError) as error:  # what subprocess makes of any in the child
        told = f"unconfined {error}"
    finally:
        _end_descendants()
    os.write(status, told.encode(errors="replace"))


def _set(option: int, value: int) -> None:
    """Set an attribute of this process, as prctl(2) does."""
    if ctypes.CDLL(None, use_errno=True).prctl(option, value, 0, 0, 0):
        raise OSError(ctypes.get_errno(), f"prctl option {option}")


def _set_up(job: dict[str, Any]) -> Callable[[], None]:
    """What the new process is to do before it becomes the program, which is safe: it has no threads."""
    limits = {resource.RLIMIT_CORE: 0, resource.RLIMIT_AS: job["memory"], resource.RLIMIT_FSIZE: job["file"]}
    confine = None
    if job["confinement"] is not None:
        sys.path += job["path"]
        from raytruth.comparisons.sandboxes.confinement import Confinement, prepared  # noqa: PLC0415 - only if needed

        confine = prepared(Confinement(**job["confinement"]))

    def set_up() -> None:
        if confine is not None:
            try:
                confine()
                _set(PR_SET_NO_NEW_PRIVS, 1)
            except OSError as error:
                print(error.strerror, file=sys.stderr, flush=True)
                raise  # subprocess tells of any error in the new process, but not which
        for limit, most in limits.items():
            hardest = resource.getrlimit(limit)[1]
            least = most if hardest == resource.RLIM_INFINITY else min(most, hardest)
            resource.setrlimit(limit, (least, least))

    return set_up


def _stop(*_: object) -> NoReturn:
    """Leaves main by way of its `finally`."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    sys.exit(1)


def _run(command: list[str], set_up: Callable[[], None]) -> int:
    try:
        return subprocess.Popen(command, preexec_fn=set_up).wait()  # noqa: PLW1509 - see _set_up
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
