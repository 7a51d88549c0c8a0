"""A function called in a process of its own, so that nothing that happens there reaches what else is graded.

On a cluster its workers do the same: so a result does not depend on where a submission is graded.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import threading
from typing import TYPE_CHECKING, Any

from raytruth.comparisons.processes.interruption import INTERRUPTED

if TYPE_CHECKING:
    from collections.abc import Callable

# The end of what Python prints when it fails: the last line with the kind of error.
_QUOTED_CHARACTERS = 400

_lifelines: set[int] = set()
"""Ends of pipes: a process goes on as long as its one is open."""
_closing = threading.Lock()


class ApartError(Exception):
    """A process of its own has failed; the message is a clause with the last line that it printed."""


def apart(function: Callable[..., Any], *arguments: Any) -> Any:
    """What the function returns. Raises ApartError where its process ends otherwise.

    The process ends when this one does: it reads a pipe whose other end is closed then. What goes in and comes out goes
    through pipes, too: files could be written by the program that is graded.
    """
    reader, writer = os.pipe()
    _lifelines.add(writer)
    try:
        ended = subprocess.run(
            [sys.executable, "-m", "raytruth.comparisons.classes.apart", str(reader)],
            input=pickle.dumps((function, arguments)),
            capture_output=True,
            pass_fds=[reader],
            start_new_session=True,  # an interruption is for the run, which tells of it
            check=False,
        )
    finally:
        os.close(reader)
        _close(writer)
    if ended.returncode == 0:
        return pickle.loads(ended.stdout)
    lines = ended.stderr.decode(errors="replace").strip().splitlines()
    told = lines[-1][-_QUOTED_CHARACTERS:] if lines else "it printed nothing"
    raise ApartError(f"its process ended with status {ended.returncode}: {told}")


def end_all() -> None:
    """End all processes that this one has started here."""
    for writer in list(_lifelines):
        _close(writer)


def _close(writer: int) -> None:
    """Close the end of a pipe that is open: once, since its number may be another file's afterwards."""
    with _closing:
        if writer in _lifelines:
            _lifelines.remove(writer)
            os.close(writer)


def main(lifeline: int) -> None:
    """Call what stands on standard input, and write the result to standard output, where nothing else goes."""
    threading.Thread(target=_end_with_parent, args=(lifeline,), daemon=True).start()
    function, arguments = pickle.loads(sys.stdin.buffer.read())
    answer = os.dup(sys.stdout.fileno())
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    result = pickle.dumps(function(*arguments))
    with os.fdopen(answer, "wb") as file:
        file.write(result)


def _end_with_parent(lifeline: int) -> None:
    os.read(lifeline, 1)  # nothing is ever written there: this returns when the last writer is gone
    os._exit(INTERRUPTED)  # what renders in a process of its own is ended by its guard


if __name__ == "__main__":
    main(int(sys.argv[1]))
