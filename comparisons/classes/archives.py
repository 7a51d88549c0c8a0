"""What students hand in, unpacked or copied: regular files and folders only, within limits. All of it is hostile."""

from __future__ import annotations

import bz2
import gzip
import lzma
import os
import stat
import tarfile
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import IO, TYPE_CHECKING, Any

from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.records.renderings import RendererError
from raytruth.scenes.wording import quoted

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

ENDINGS = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tar.xz", ".bundle")
_OPENERS: dict[bytes, Callable[..., Any]] = {b"\x1f\x8b": gzip.open, b"BZh": bz2.open, b"\xfd7zXZ": lzma.open}
_CHUNK = 1 << 16
_NO_FILE = "a link or a device"
# Version control and what macOS puts beside each file: not what is graded, and often most of the bytes.
_LEFT_OUT = {".git", "__MACOSX", ".DS_Store"}
# A tar file has half a kilobyte of header and as much of padding for each member, a few kilobytes with a long name.
_BYTES_OF_HEADERS = 4096
# Cloning reads and writes what the bundle holds; a class of clones on a busy machine takes seconds each.
_CLONE_SECONDS = 120.0
_CLONE_MEMORY = 1 << 32


@dataclass(frozen=True)
class Room:
    """How much may be unpacked."""

    files: int
    bytes: int
    ratio: float
    """How many times larger than the archive its content may be."""


# A tracer is some dozen files and a few hundred kilobytes; this leaves room for meshes, pictures and a library that is
# handed in with it. Source compresses some 5 times and a black picture hundreds of times, a bomb as far as deflate can:
# 1032 times. Small archives may have any ratio (unpacked within a mebibyte, they harm nobody).
SUBMISSION_ROOM = Room(files=5_000, bytes=1 << 28, ratio=500.0)
# A platform's export of a whole class: a thousand submissions of a few mebibytes.
EXPORT_ROOM = Room(files=1_000_000, bytes=1 << 34, ratio=500.0)
_HARMLESS_BYTES = 1 << 20


class ArchiveError(Exception):
    """What was handed in is refused; the message is one sentence."""


def is_archive(path: Path) -> bool:
    """Whether a file is one that can be unpacked, by the ending of its name."""
    return path.name.lower().endswith(ENDINGS) and path.is_file() and not path.is_symlink()


def unpack(path: Path, folder: Path, room: Room = SUBMISSION_ROOM, left_out: list[str] | None = None) -> None:
    """Unpack an archive, or copy a folder or a file, into a folder that is empty. Raises ArchiveError.

    Links, devices and paths that lead outside are refused; where `left_out` is given, as for the export of a class,
    they are left out instead, and a sentence for each is added to it.
    """
    unpacked = _Unpacked(path, folder, room, left_out)
    try:
        if path.is_symlink():
            raise ArchiveError(f"{quoted(path.name)} is a link; hand in the files themselves.")
        if path.is_dir():
            unpacked.copy(path)
        elif not path.is_file():
            raise ArchiveError(f"{quoted(path.name)} is no file, but a device; hand in files.")
        elif not is_archive(path):
            unpacked.add(path.name, path.open("rb"))
        elif path.name.lower().endswith(".zip"):
            _unzip(path, unpacked)
        elif path.name.lower().endswith(".bundle"):
            _clone(path, unpacked)
        else:
            _untar(path, unpacked)
    except (OSError, EOFError, ValueError, RuntimeError, zlib.error, lzma.LZMAError) as error:
        # RuntimeError: encrypted; ValueError and NotImplementedError (a RuntimeError): what the format allows no reader
        raise ArchiveError(f"{quoted(path.name)} cannot be unpacked: {_sentence(error)}.") from error
    except (zipfile.BadZipFile, tarfile.TarError) as error:
        raise ArchiveError(f"{quoted(path.name)} is damaged, or not what its name says: {_sentence(error)}.") from error


class _Unpacked:
    """A folder that files are put into, as far as there is room."""

    def __init__(self, source: Path, folder: Path, room: Room, left_out: list[str] | None) -> None:
        self._name, self._folder, self._room, self._left_out = source.name, folder, room, left_out
        self._files = self._bytes = 0
        self._packed = source.stat().st_size if source.is_file() else None

    @property
    def most_bytes(self) -> int:
        """How many bytes there may be in all: so many, and so many times more than the archive has."""
        if self._packed is None:
            return self._room.bytes
        return min(self._room.bytes, max(_HARMLESS_BYTES, int(self._room.ratio * self._packed)))

    def place(self, name: str) -> Path | None:
        """Where a member goes; None if it is left out. Counts it. Raises ArchiveError for a path that leads outside."""
        pure = PurePosixPath(name.replace("\\", "/"))
        if pure.is_absolute() or ".." in pure.parts or "\0" in name or ":" in (pure.parts or ("",))[0]:
            self.refuse(name, "a path that leads out of it")
            return None
        self._files += 1
        if self._files > self._room.files:
            raise ArchiveError(f"{quoted(self._name)} holds more than {self._room.files} files.")
        if not pure.parts or not _LEFT_OUT.isdisjoint(pure.parts) or pure.name.startswith("._"):
            return None
        return self._folder / pure

    def refuse(self, name: str, why: str) -> None:
        """Raise ArchiveError because of a member, or note that it is left out."""
        sentence = f"{quoted(self._name)} holds {quoted(name)}, {why}."
        if self._left_out is None:
            raise ArchiveError(sentence)
        self._left_out.append(sentence)

    def add(self, name: str, content: IO[bytes], *, is_executable: bool = False) -> None:
        """Write a member whose bytes come from a stream, which is closed. Its announced size does not count."""
        with content:
            target = self.place(name)
            if target is None:
                return
            target.parent.mkdir(parents=True, exist_ok=True)
            with target.open("xb") as file:  # of two members of one name nobody could tell which is meant
                while chunk := content.read(_CHUNK):
                    self._bytes += len(chunk)
                    if self._bytes > self.most_bytes:
                        raise ArchiveError(f"{quoted(self._name)} holds more than {self.most_bytes} bytes, unpacked.")
                    file.write(chunk)
            target.chmod(0o755 if is_executable else 0o644)

    def copy(self, folder: Path) -> None:
        """Add all files of a folder."""
        for path in files_below(folder):
            name, mode = path.relative_to(folder).as_posix(), path.lstat().st_mode
            if stat.S_ISREG(mode):
                self.add(name, path.open("rb"), is_executable=bool(mode & stat.S_IXUSR))
            else:
                self.refuse(name, _NO_FILE)


def files_below(folder: Path) -> Iterator[Path]:
    """All that is not a folder, in an order that is the same each time; links to folders count as what they are."""
    for root, folders, files in os.walk(folder):
        links = [name for name in folders if (Path(root) / name).is_symlink()]
        folders[:] = sorted(name for name in folders if name not in links and name not in _LEFT_OUT)
        yield from (Path(root) / name for name in sorted([*files, *links]) if name not in _LEFT_OUT)


def _unzip(path: Path, unpacked: _Unpacked) -> None:
    with zipfile.ZipFile(path) as archive:
        for member in archive.infolist():
            kind = stat.S_IFMT(member.external_attr >> 16)
            if kind not in {0, stat.S_IFREG, stat.S_IFDIR}:
                unpacked.refuse(member.filename, _NO_FILE)
            elif member.is_dir():
                unpacked.place(member.filename)
            else:
                is_executable = bool((member.external_attr >> 16) & stat.S_IXUSR)
                unpacked.add(member.filename, archive.open(member), is_executable=is_executable)


def _untar(path: Path, unpacked: _Unpacked) -> None:
    with path.open("rb") as file:
        start = file.read(6)
    opener = next((it for magic, it in _OPENERS.items() if start.startswith(magic)), None)
    most = unpacked.most_bytes + SUBMISSION_ROOM.files * _BYTES_OF_HEADERS
    content = opener(path, "rb") if opener else path.open("rb")
    # A header may say that gigabytes of names follow, and tarfile reads them into memory: so they are counted here.
    counted: Any = _Counted(content, most, path.name)  # it has all of a file that is used
    with content, tarfile.open(fileobj=counted, mode="r|") as archive:
        for member in archive:
            stream = archive.extractfile(member) if member.isreg() else None
            if member.isdir():
                unpacked.place(member.name)
            elif stream is None:
                unpacked.refuse(member.name, _NO_FILE)
            else:
                unpacked.add(member.name, stream, is_executable=bool(member.mode & stat.S_IXUSR))


class _Counted:
    """A stream that gives no more than so many bytes."""

    def __init__(self, stream: IO[bytes], most: int, name: str) -> None:
        self._stream, self._left, self._name = stream, most, name

    def read(self, size: int) -> bytes:
        """At most `size` bytes. Raises ArchiveError where there are more than there may be."""
        data = self._stream.read(min(size, self._left + 1))
        self._left -= len(data)
        if self._left < 0:
            raise ArchiveError(f"{quoted(self._name)} holds more than there is room for, unpacked.")
        return data


def _clone(path: Path, unpacked: _Unpacked) -> None:
    """The files of a git bundle's head, without its history; nothing of the student's is run."""
    settings = ["core.symlinks=false", "core.hooksPath=/dev/null", "protocol.allow=never", "protocol.file.allow=always"]
    words = ["git", *(word for setting in settings for word in ("-c", setting)), "clone", "--quiet"]
    with TemporaryDirectory(prefix="raytruth-") as name:
        try:
            run_isolated(
                [*words, "--no-recurse-submodules", "--", str(path.resolve()), "clone"],
                Path(name),
                seconds=_CLONE_SECONDS,
                memory_bytes=_CLONE_MEMORY,
                file_bytes=unpacked.most_bytes,
                environment={"GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1", "GIT_TERMINAL_PROMPT": "0"},
            )
        except RendererError as error:
            raise ArchiveError(f"{quoted(path.name)} is no git bundle that can be cloned: {error}.") from error
        unpacked.copy(Path(name) / "clone")


def _sentence(error: Exception) -> str:
    return str(getattr(error, "strerror", None) or error or type(error).__name__).rstrip(".")
