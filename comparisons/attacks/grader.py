"""A grader that is there to be attacked: its files, a process and a server, none of which matters."""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
import socket
import subprocess
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from raytruth.comparisons.sandboxes.open_files import is_open_to_others
from raytruth.comparisons.sandboxes.sandbox import SandboxError, is_root
from raytruth.reference_tracer.storage.cache import cache_folder

if TYPE_CHECKING:
    from collections.abc import Iterator

# Where systems have a Python that everybody may run, for where ours lies in a folder that is closed to others.
_COMMON_PLACES = "/usr/bin:/usr/local/bin:/bin"
# A moment for a connection that was made to be seen.
_LISTENING_SECONDS = 0.05


@dataclass
class Grader:
    """What is attacked."""

    work: Path
    """The folder of the submission."""
    python: Path
    """The interpreter that the attacks run in."""
    files: dict[str, Path]
    """Files of the grader's by what they stand for, each with the secret in it; without one that cannot be written."""
    secret: str
    token: str
    """A name that nothing else on this machine has."""
    victim: subprocess.Popen[bytes]
    server: tuple[socket.socket, socket.socket, socket.socket]
    """That listen: by TCP, by UDP, and at a local name."""
    address: int
    """Where in the memory of the process its token lies."""

    @property
    def process(self) -> int:
        """The number of a process of the grader's."""
        return self.victim.pid

    @property
    def port(self) -> int:
        """Of the server, by TCP and by UDP."""
        return int(self.server[0].getsockname()[1])

    def file(self, name: str) -> dict[str, Any]:
        """What an attack on a file needs."""
        return {"path": str(self.files[name]), "pid": self.process, "secret": self.secret}

    def survivors(self) -> str:
        """Whether a process that was given the token is still there."""
        for place in Path("/proc").glob("[0-9]*/cmdline"):
            with contextlib.suppress(OSError):  # it has ended
                if self.token.encode() in place.read_bytes() and int(place.parent.name) != self.process:
                    return "left a process behind"
        return ""

    def connections(self) -> str:
        """Whether anybody has reached the server."""
        for link in self.server:
            link.settimeout(_LISTENING_SECONDS)
            with contextlib.suppress(OSError):  # nothing came
                if link.type == socket.SOCK_DGRAM:
                    link.recv(1)
                else:
                    link.accept()[0].close()
                return "reached a server on the grader's machine"
        return ""

    def rewritten(self) -> str:
        """Whether the results are another's."""
        results = self.files["results"]
        is_as_it_was = results.is_file() and self.secret in results.read_text(encoding="utf-8")
        return "" if is_as_it_was and list(results.parent.iterdir()) == [results] else "wrote to the folder of results"

    def ended(self) -> str:
        """Whether the process has been ended."""
        return "" if self.victim.poll() is None else "ended a process of the grader's"


@contextmanager
def attacked_grader() -> Iterator[Grader]:
    """A grader, for as long as it is attacked. Raises SandboxError where no Python can be run by others."""
    secret, token = secrets.token_hex(8), f"raytruth-{secrets.token_hex(8)}"
    with TemporaryDirectory(prefix="raytruth-") as name, contextlib.ExitStack() as stack:
        folder = Path(name).resolve()
        folder.chmod(0o711)  # whoever the submission runs as must be able to enter its own folder
        files = {word: folder / word / f"{word}.txt" for word in ("rubric", "others", "results", "private")}
        for path in files.values():
            path.parent.mkdir()
        files["private"].parent.chmod(0o700)
        files["truth"] = cache_folder().resolve() / f"{token}.txt"
        files["home"] = Path.home().resolve() / f".{token}"
        for word, path in list(files.items()):
            if os.access(path.parent, os.W_OK):
                stack.enter_context(_with_secret(path, secret))
            else:  # as a home folder that is not there
                del files[word]
        victim, address = stack.enter_context(_victim(token))
        server = stack.enter_context(_server(token))
        yield Grader(folder / "work", runnable_python(), files, secret, token, victim, server, address)


def runnable_python() -> Path:
    """A Python that whoever a submission runs as may run. Raises SandboxError if there is none."""
    found = shutil.which("python3", path=_COMMON_PLACES)
    for candidate in (sys.executable, *([found] if found else [])):
        path = Path(candidate).resolve()
        if not is_root() or is_open_to_others(path):
            return path
    raise SandboxError(f"other users may not run {sys.executable}, and there is no other Python in {_COMMON_PLACES}")


@contextmanager
def _with_secret(path: Path, secret: str) -> Iterator[None]:
    path.write_text(secret, encoding="utf-8")
    try:
        yield
    finally:
        path.unlink(missing_ok=True)


# It tells where in its memory the token lies, and waits.
_VICTIM = """
import ctypes, os, time
token = ctypes.create_string_buffer(os.environ["RAYTRUTH_TOKEN"].encode())
print(ctypes.addressof(token), flush=True)
time.sleep(600)
"""


@contextmanager
def _victim(token: str) -> Iterator[tuple[subprocess.Popen[bytes], int]]:
    """A process that waits, with the token in its environment and in its memory, and the address there."""
    words = [sys.executable, "-I", "-S", "-c", _VICTIM]
    environment = {**os.environ, "RAYTRUTH_TOKEN": token}
    with subprocess.Popen(words, env=environment, stdout=subprocess.PIPE) as victim:
        try:
            assert victim.stdout is not None  # it was asked for above
            yield victim, int(victim.stdout.readline())
        finally:
            victim.kill()


@contextmanager
def _server(token: str) -> Iterator[tuple[socket.socket, socket.socket, socket.socket]]:
    with (
        socket.create_server(("127.0.0.1", 0)) as stream,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagram,
        socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as local,
    ):
        datagram.bind(("127.0.0.1", stream.getsockname()[1]))
        local.bind(f"\0{token}")
        local.listen()
        yield stream, datagram, local
