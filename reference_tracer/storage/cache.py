"""Where what takes long to make is kept from run to run. All of it can be made again: it may be deleted at any time.

A folder that cannot be written stops nobody: a temporary one is used in its place, and all is made again next time.
"""

from __future__ import annotations

import atexit
import functools
import os
import shutil
import sys
from pathlib import Path
from tempfile import TemporaryFile, mkdtemp
from typing import TYPE_CHECKING

from platformdirs import user_cache_path

from raytruth.reference_tracer.storage.whole_files import unfinished_file

if TYPE_CHECKING:
    from collections.abc import Callable

VARIABLE = "RAYTRUTH_CACHE"
# Compiled kernels are the largest files that must be written for a command to work at all: some 100 kB each.
ROOM = bytes(2**20)


def named_cache_folder() -> Path:
    """$RAYTRUTH_CACHE, or the user's cache folder, whether it can be used or not."""
    return Path(os.environ.get(VARIABLE) or user_cache_path("raytruth"))


def cache_folder() -> Path:
    """The folder that is named or, where nothing can be written there, a temporary one, which is told once.

    Processes that this one starts use the same one. Raises OSError where no temporary folder can be made.
    """
    return _usable(named_cache_folder())


@functools.cache
def _usable(folder: Path) -> Path:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder) as file:
            file.write(ROOM)
    except OSError as error:
        substitute = Path(mkdtemp(prefix="raytruth-cache-"))
        atexit.register(shutil.rmtree, substitute, ignore_errors=True)
        os.environ[VARIABLE] = str(substitute)
        _tell(folder, error)
        return substitute
    return folder


def keep(path: Path, write: Callable[[Path], object]) -> None:
    """Have `write` write a file of the cache, whole or not at all; one that cannot be written is told and left out."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with unfinished_file(path) as file:
            write(file)
    except OSError as error:
        _tell(path.parent.parent, error)


@functools.cache
def _told(reason: str) -> None:
    """Once for each reason."""
    print(f"raytruth: {reason}", file=sys.stderr, flush=True)


def _tell(folder: Path, error: OSError) -> None:
    shown = str(folder) if str(folder).isprintable() else ascii(str(folder))
    reason = f"nothing is kept for the next run, since the cache folder {shown} cannot be written: {error.strerror}."
    _told(reason)
