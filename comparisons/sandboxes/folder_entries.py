"""All that lies below a folder which somebody else may have filled with malice."""

from __future__ import annotations

import contextlib
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


def entries_below(folder: Path) -> Iterator[tuple[int, os.DirEntry[str]]]:
    """Each entry after the number of folders that it lies in, which is 1 at the top. Links are not followed.

    A folder comes before what it holds. What cannot be listed, as it has gone or its path is too long, is left out.
    However deep folders are, this needs no recursion.
    """
    waiting = [(1, str(folder))]
    while waiting:
        depth, path = waiting.pop()
        with contextlib.suppress(OSError), os.scandir(path) as entries:
            for entry in entries:
                if entry.is_dir(follow_symlinks=False):
                    waiting.append((depth + 1, entry.path))
                yield depth, entry
