"""Running a program that may crash, hang, or fill memory and disk, without harm to us.

The limits hold for the program and for whatever it starts. Only a descendant that opens a session of its own
escapes being killed at the end; its memory and its files stay limited all the same.
"""

from __future__ import annotations

import os
import selectors
import signal
import subprocess
import time
from pathlib import Path
from typing import IO

from comparisons.renderer import RendererError

LOG_FILE = "log.txt"
# Renderers print some kilobytes; this leaves room for a verbose one and is nothing to a disk.
LOG_BYTES = 1 << 20
# The largest file that a right answer needs: 8192² pixels of float32 RGB are 0.8 GB.
FILE_BYTES = 1 << 30
_CHUNK_BYTES = 1 << 16
# The end of the log that an error message quotes: enough for the last line of a traceback with its message.
_QUOTED_LINES = 3
_QUOTED_CHARACTERS = 400

# The shell sets the limits and then becomes the program, since limits set between fork and exec in Python
# (`preexec_fn`) can deadlock when the caller has threads. Units: -v KiB, -f blocks of 512 bytes (POSIX).
_LIMIT_AND_RUN = 'ulimit -c 0 && ulimit -v "$1" && ulimit -f "$2" && shift 2 && exec "$@"'


def run_isolated(
    command: list[str],
    folder: Path,
    *,
    seconds: float,
    memory_bytes: int,
    output_bytes: int = LOG_BYTES,
    file_bytes: int = FILE_BYTES,
) -> None:
    """Run a command in a session of its own, in `folder`, with its standard output and error in `folder/log.txt`.

    `seconds` of wall-clock time, `memory_bytes` of address space per process, `output_bytes` of log, and `file_bytes`
    per file that it writes. Its standard input is empty. When this returns or raises, the process and its group are
    gone. Raises RendererError, in one sentence with the end of the log, unless it ends with exit status 0 within
    the limits.
    """
    limits = [str(memory_bytes // 1024), str(file_bytes // 512)]
    log_path = folder / LOG_FILE
    with log_path.open("wb") as log:
        process = subprocess.Popen(
            ["/bin/sh", "-c", _LIMIT_AND_RUN, "sh", *limits, *command],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        assert process.stdout is not None  # it was asked for above
        with process.stdout as output:
            try:
                limit_hit = _copy_until_exit(process.pid, output, log, seconds, output_bytes)
            finally:
                # The leader is not reaped yet, so that its group's number cannot have passed to others.
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
    failure = limit_hit or _describe_status(process.returncode)
    if failure:
        raise RendererError(f"{Path(command[0]).name} {failure}; {_end_of_log(log_path)}")


def _copy_until_exit(pid: int, output: IO[bytes], log: IO[bytes], seconds: float, output_bytes: int) -> str | None:
    """Copy the output to the log until the process ends; the limit that it hit instead, or None."""
    deadline = time.monotonic() + seconds
    room = output_bytes
    os.set_blocking(output.fileno(), False)
    exit_notice = os.pidfd_open(pid)
    try:
        with selectors.DefaultSelector() as selector:
            selector.register(output, selectors.EVENT_READ)
            selector.register(exit_notice, selectors.EVENT_READ)
            ended = False
            while not ended:
                ready = {key.fd for key, _ in selector.select(max(0.0, deadline - time.monotonic()))}
                # Looked at before the pipe is drained: what a process wrote before it ended is in the pipe by then.
                ended = exit_notice in ready
                while chunk := _read_available(output):
                    log.write(chunk[:room])
                    room -= len(chunk)
                    if room < 0:
                        return f"printed more than {output_bytes} bytes"
                    if time.monotonic() >= deadline:
                        break
                if chunk == b"" and output.fileno() in ready and not ended:
                    selector.unregister(output)  # closed by a process that goes on; only its end is awaited now
                if not ended and time.monotonic() >= deadline:
                    return f"did not end within its time limit of {seconds:g} s"
    finally:
        os.close(exit_notice)
    return None


def _read_available(output: IO[bytes]) -> bytes | None:
    """What can be read at once: None where nothing waits, empty at the end of the output."""
    try:
        return os.read(output.fileno(), _CHUNK_BYTES)
    except BlockingIOError:
        return None


def _describe_status(status: int) -> str | None:
    if status == 0:
        return None
    if status > 0:
        return f"ended with exit status {status}"
    try:
        return f"was ended by signal {signal.Signals(-status).name}"
    except ValueError:  # real-time signals have numbers only
        return f"was ended by signal {-status}"


def _end_of_log(path: Path) -> str:
    with path.open("rb") as log:
        log.seek(0, os.SEEK_END)
        log.seek(max(0, log.tell() - _CHUNK_BYTES))
        text = log.read().decode(errors="replace")
    printable = ("".join(c if c.isprintable() else " " for c in line).strip() for line in text.splitlines())
    lines = [line for line in printable if line][-_QUOTED_LINES:]
    if not lines:
        return "it printed nothing"
    return f"its log ends: {' / '.join(lines)[-_QUOTED_CHARACTERS:]}"
