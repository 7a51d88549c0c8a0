"""What a report was made from, as a digest: as long as that is the same, the report need not be made again."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.comparisons.records.kill_results import KILLS_FILE
from raytruth.comparisons.records.results import RESULTS_FILE
from raytruth.reports.kills import PAGE_FILE

if TYPE_CHECKING:
    from collections.abc import Iterator

OURS = Path(__file__).parent
# The digest stands in the head of the page.
_HEAD_BYTES = 4096


def made_from(directory: Path) -> str:
    """A digest of all that a report is made from.

    That are results.json, the kill matrix, the cells' files by names, sizes and times, and our own code.
    """
    digest = hashlib.sha256((directory / RESULTS_FILE).read_bytes())
    digest.update(str((directory / PAGE_FILE).exists()).encode())
    if (directory / KILLS_FILE).is_file():
        digest.update((directory / KILLS_FILE).read_bytes())
    for path in sorted(_finished_files(directory / "cells")):
        try:
            status = path.stat()
        except FileNotFoundError:  # a run goes on meanwhile, and has just judged the cell anew
            continue
        digest.update(f"{path.relative_to(directory)} {status.st_size} {status.st_mtime_ns}\n".encode())
    for path in sorted(path for path in OURS.rglob("*") if path.is_file() and path.suffix != ".pyc"):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _finished_files(folder: Path) -> Iterator[Path]:
    """All files below it but those that a run is writing, whose names or folders begin with a dot."""
    for parent, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        yield from (Path(parent, name) for name in files if not name.startswith("."))


def is_made_from(page: Path, digest: str) -> bool:
    """Whether the page is there and was made from what has this digest."""
    try:
        with page.open("rb") as file:
            return digest.encode() in file.read(_HEAD_BYTES)
    except OSError:
        return False
