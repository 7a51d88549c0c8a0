"""Files that whoever a program runs as may read: where we are root, what is closed to others is copied for them."""

from __future__ import annotations

import os
import shutil
from contextlib import contextmanager
from pathlib import Path
from secrets import token_hex
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from raytruth.comparisons.sandboxes.folder_entries import entries_below
from raytruth.comparisons.sandboxes.sandbox import SandboxError, is_root

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_OTHERS_MAY_ENTER, _OTHERS_MAY_READ = 0o001, 0o004
# Of a submission. Its sources and what is built of them have some hundreds of files and megabytes.
_MOST_FILES, _MOST_BYTES = 10_000, 1 << 30


def is_open_to_others(path: Path) -> bool:
    """Whether the permissions of a file or folder, and of the folders that it lies in, let everybody read it."""
    real = path.resolve()
    folders = real.parents if real.is_file() else (real, *real.parents)
    may_enter = all(folder.stat().st_mode & _OTHERS_MAY_ENTER for folder in folders)
    return may_enter and bool(real.stat().st_mode & _OTHERS_MAY_READ)


@contextmanager
def opened(paths: Iterable[Path], folders: Iterable[Path] = ()) -> Iterator[tuple[tuple[Path, Path], ...]]:
    """Each path with what stands for it as long as this holds: itself, or a copy where we are root and it is closed.

    The copies lie as the files do to each other, in a folder whose name others cannot list. Where there are copies,
    each of `folders` is one of the paths, too: its copy holds nothing but copies. Raises SandboxError for what is too
    large to be copied.
    """
    shown = list(dict.fromkeys(paths))
    if not is_root() or all(is_open_to_others(path) for path in shown):
        yield tuple((path, path) for path in shown)
        return
    with TemporaryDirectory(prefix="raytruth-") as name:
        Path(name).chmod(0o711)
        copies = Path(name).resolve() / token_hex(16)
        copied = [(path, _copied(path, copies)) for path in shown]
        yield (*copied, *((folder, copies / folder.relative_to("/")) for folder in folders))


def _copied(path: Path, copies: Path) -> Path:
    copy = copies / path.relative_to("/")
    copy.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir():
        _check_size(path)
        shutil.copytree(path, copy, symlinks=True, dirs_exist_ok=True)
    else:
        shutil.copy2(path, copy)
    _open(copies)
    return copy


def _check_size(folder: Path) -> None:
    used = 0
    for files, (_, entry) in enumerate(entries_below(folder), start=1):
        used += entry.stat(follow_symlinks=False).st_size
        if files > _MOST_FILES or used > _MOST_BYTES:
            raise SandboxError(
                f"{folder} is closed to other users, and a submission never runs as root; it has more than "
                f"{_MOST_FILES} files or {_MOST_BYTES >> 30} GiB, too much to copy: let others read it (chmod -R o+rX)"
            )


def _open(folder: Path) -> None:
    """Let everybody read what the owner may read, and run what the owner may run. Links are left as they are."""
    folder.chmod(0o755)
    for _, entry in entries_below(folder):
        if not entry.is_symlink():
            mode = entry.stat(follow_symlinks=False).st_mode
            os.chmod(entry.path, mode | (mode & 0o500) >> 6 | (mode & 0o500) >> 3)  # noqa: PTH101 - a string
