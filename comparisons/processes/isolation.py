"""Running a program that may crash, hang, or fill memory and disk, without harm to us.

The limits hold for the program and for whatever it starts. A guard (isolation_guard.py) ends all its descendants,
also those in sessions of their own, and when this process is killed, too.
"""

from __future__ import annotations

import contextlib
import json
import os
import selectors
import signal
import subprocess
import sys
import time
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING

from raytruth.comparisons.processes.process_count import LOOK_SECONDS, ProcessCount
from raytruth.comparisons.processes.removal import remove
from raytruth.comparisons.processes.usage_watch import UsageWatch
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.sandboxes.sandbox import MOST_PROCESSES, SandboxError
from raytruth.comparisons.sandboxes.sandboxed_run import SandboxedRun, sandboxed_run

if TYPE_CHECKING:
    from collections.abc import Mapping

    from raytruth.comparisons.sandboxes.sandbox import Sandbox

LOG_FILE = "log.txt"
# Renderers print some kilobytes; this leaves room for a verbose one and is nothing to a disk.
LOG_BYTES = 1 << 20
# The largest file that a right answer needs: 8192² pixels of float32 RGB are 0.8 GB.
FILE_BYTES = 1 << 30
_CHUNK_BYTES = 1 << 16
# The end of the log that an error message quotes: enough for the last line of a traceback with its message.
_QUOTED_LINES = 3
_QUOTED_CHARACTERS = 400

# As long as a guard may take to end what it guards: it kills, and the kernel needs a moment to take memory back.
_STOP_SECONDS = 10.0

_GUARD = [sys.executable, "-I", "-S", str(Path(__file__).with_name("isolation_guard.py"))]
_SCRATCH = "scratch"
# What a shell adds to the number of the signal that has ended a program; so does bubblewrap.
_SIGNALLED = 128
_UNCONFINED = "unconfined "


@dataclass(frozen=True)
class _Limits:
    seconds: float
    memory_bytes: int
    output_bytes: int
    file_bytes: int


def run_isolated(
    command: list[str],
    folder: Path,
    *,
    seconds: float,
    memory_bytes: int,
    output_bytes: int = LOG_BYTES,
    file_bytes: int = FILE_BYTES,
    environment: Mapping[str, str] | None = None,
    sandbox: Sandbox | None = None,
) -> None:
    """Run a command in a session of its own, in `folder`; its standard output and error are then in `folder/log.txt`.

    `seconds` of wall-clock time, `memory_bytes` of address space per process, `output_bytes` of log, and `file_bytes`
    per file that it writes; of processes as many as process_count.py allows. It has our environment with the
    variables of `environment` in it. Its standard input is empty, its temporary files are removed. When this returns or
    raises, the process and all its descendants are gone. Raises RendererError, in one sentence with the end of the log,
    unless it ends with exit status 0 within the limits and leaves no process behind; then what it wrote, but for the
    log, is removed.

    In a sandbox it sees and writes what that allows, has little of our environment, and is held to the limits of
    usage_watch.py, too. Raises SandboxError where the sandbox cannot be set up.
    """
    limits = _Limits(seconds, memory_bytes, output_bytes, file_bytes)
    before = set(folder.iterdir())
    scratch = folder / _SCRATCH
    scratch.mkdir()
    extra = {**(environment or {}), "TMPDIR": str(scratch.resolve())}
    log = bytearray()
    try:
        with _started(command, folder, limits, extra, sandbox) as run:
            failure = _run_guarded(run, folder, log, limits, sandbox)
    finally:
        remove(scratch)
        _write_log(folder / LOG_FILE, bytes(log))
    if failure:
        for path in set(folder.iterdir()) - before - {folder / LOG_FILE}:
            remove(path)
        raise RendererError(f"{Path(command[0]).name} {failure}; {end_of_log(folder / LOG_FILE)}")


def _started(
    command: list[str], folder: Path, limits: _Limits, extra: Mapping[str, str], sandbox: Sandbox | None
) -> contextlib.AbstractContextManager[SandboxedRun]:
    """How it is started, in a sandbox or as it is."""
    if sandbox is None:
        return nullcontext(SandboxedRun(command, {**os.environ, **extra}, None))
    return sandboxed_run(sandbox, command, folder, folder / _SCRATCH, limits.memory_bytes, extra)


def _write_log(path: Path, log: bytes) -> None:
    """In place of whatever the program put there, which may be a link to a file of others."""
    if path.is_symlink() or path.exists():
        remove(path)
    with path.open("xb") as file:
        file.write(log)


def _run_guarded(
    run: SandboxedRun, folder: Path, log: bytearray, limits: _Limits, sandbox: Sandbox | None
) -> str | None:
    """What went wrong, in a clause; None if nothing did."""
    reader, writer = os.pipe()
    job = {
        "memory": limits.memory_bytes,
        "file": limits.file_bytes,
        "confinement": run.confinement and run.confinement._asdict(),
        # Where our own package lies is not told by sys.path if it is installed from a folder that one works in.
        "path": [*(place for place in sys.path if place), str(Path(__file__).parents[3])],
    }
    with os.fdopen(reader, "rb") as status:
        try:
            guard = subprocess.Popen(
                [*_GUARD, str(writer), json.dumps(job), *run.command],
                cwd=folder,
                env=run.environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                pass_fds=[writer],
                start_new_session=True,
            )
        finally:
            os.close(writer)
        assert guard.stdout is not None  # it was asked for above
        watch = UsageWatch(guard.pid, folder, limits.memory_bytes, limits.file_bytes) if sandbox else None
        with guard.stdout as output:
            try:
                limit_hit = _copy_until_exit(guard.pid, output, log, limits, watch)
            finally:
                _end(guard)
        told = status.read().decode()
        if told.startswith(_UNCONFINED):
            reason = bytes(log).decode(errors="replace").strip() or told.removeprefix(_UNCONFINED)
            raise SandboxError(f"the sandbox could not be set up: {reason}")
        return limit_hit or _describe_status(told, by_shell=sandbox is not None and sandbox.rung == "bubblewrap")


def _end(guard: subprocess.Popen[bytes]) -> None:
    """Have the guard end all that it guards, and see to it that it ends itself; nothing to do where it has ended."""
    try:
        # It is not reaped yet, so that neither its number nor its group's can have passed to others.
        guard.send_signal(signal.SIGCONT)
        guard.terminate()
        guard.wait(_STOP_SECONDS)
    except subprocess.TimeoutExpired:
        pass
    finally:
        with contextlib.suppress(ProcessLookupError):  # the group is empty
            os.killpg(guard.pid, signal.SIGKILL)
        guard.wait()


def _copy_until_exit(
    pid: int, output: IO[bytes], log: bytearray, limits: _Limits, watch: UsageWatch | None
) -> str | None:
    """Copy the output to the log until the process ends; the limit that it hit instead, or None."""
    deadline = time.monotonic() + limits.seconds
    os.set_blocking(output.fileno(), False)
    exit_notice = os.pidfd_open(pid)
    processes = ProcessCount(pid)
    try:
        with selectors.DefaultSelector() as selector:
            selector.register(output, selectors.EVENT_READ)
            selector.register(exit_notice, selectors.EVENT_READ)
            ended = False
            while not ended:
                ready = {key.fd for key, _ in selector.select(min(LOOK_SECONDS, max(0.0, deadline - time.monotonic())))}
                if processes.is_too_high():
                    return f"had more than {MOST_PROCESSES} processes at once"
                if watch is not None and (excess := watch.excess()):
                    return excess
                # Looked at before the pipe is drained: what a process wrote before it ended is in the pipe by then.
                ended = exit_notice in ready
                while chunk := _read_available(output):
                    room = limits.output_bytes - len(log)
                    log += chunk[:room]
                    if len(chunk) > room:
                        return f"printed more than {limits.output_bytes} bytes"
                    if time.monotonic() >= deadline:
                        break
                if chunk == b"" and output.fileno() in ready and not ended:
                    selector.unregister(output)  # closed by a process that goes on; only its end is awaited now
                if not ended and time.monotonic() >= deadline:
                    return f"did not end within its time limit of {limits.seconds:g} s"
    finally:
        os.close(exit_notice)
    return None


def _read_available(output: IO[bytes]) -> bytes | None:
    """What can be read at once: None where nothing waits, empty at the end of the output."""
    try:
        return os.read(output.fileno(), _CHUNK_BYTES)
    except BlockingIOError:
        return None


def _describe_status(status: str, *, by_shell: bool) -> str | None:
    """What a guard's words mean, as a clause; None if all went well. `by_shell`: signals are told as shells do."""
    if not status:
        return "ended the process that guards it"
    returncode, left = (int(number) for number in status.split())
    if by_shell and returncode > _SIGNALLED:
        returncode = _SIGNALLED - returncode
    if returncode > 0:
        return f"ended with exit status {returncode}"
    if returncode < 0:
        return f"was ended by signal {_signal_name(-returncode)}"
    if left:
        return f"left {left} {'process' if left == 1 else 'processes'} behind"
    return None


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:  # real-time signals have numbers only
        return str(number)


def end_of_log(path: Path) -> str:
    """What a program said last, as a clause on one line."""
    with path.open("rb") as log:
        log.seek(0, os.SEEK_END)
        log.seek(max(0, log.tell() - _CHUNK_BYTES))
        text = log.read().decode(errors="replace")
    printable = ("".join(c if c.isprintable() else " " for c in line).strip() for line in text.splitlines())
    lines = [line for line in printable if line][-_QUOTED_LINES:]
    if not lines:
        return "it printed nothing"
    return f"its log ends: {' / '.join(lines)[-_QUOTED_CHARACTERS:]}"
