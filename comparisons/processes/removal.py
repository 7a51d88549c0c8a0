"""Removing what a program of others left, which may be made so that it is hard to remove."""

from __future__ import annotations

import shutil
import subprocess
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


def remove(path: Path) -> None:
    """Remove a file, a link, or a folder with all in it, as far as we may; nothing where there is none.

    Folders may be deeper than Python can follow, and closed to their owner: chmod(1) and rm(1) cope with both.
    """
    if not path.is_dir() or path.is_symlink():
        path.unlink(missing_ok=True)
        return
    try:
        shutil.rmtree(path)
    except (OSError, RecursionError):
        for words in (["chmod", "-R", "u+rwx", "--"], ["rm", "-rf", "--"]):
            subprocess.run([*words, path], check=False, stdin=subprocess.DEVNULL, capture_output=True)
