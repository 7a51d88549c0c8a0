"""Cells as they lie in a results directory: whole, or to be run again."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

from raytruth.comparisons.records.results import Cell

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

CELL_FILE = "cell.json"


def whole_cell(directory: Path, folder: str) -> Cell | None:
    """The cell in a folder; None where there is none, or where its record or an image of it is missing or damaged."""
    try:
        cell = Cell.model_validate_json((directory / folder / CELL_FILE).read_bytes())
    except (OSError, ValueError):
        return None
    if cell.images is not None and cell.images.digest != files_digest(directory / path for path in cell.images.paths):
        return None
    return cell


def whole_cells(directory: Path) -> Iterator[Cell]:
    """All of them that lie in the folders of their names."""
    for path in sorted(directory.glob(f"cells/*/*/{CELL_FILE}")):
        folder = path.parent.relative_to(directory).as_posix()
        cell = whole_cell(directory, folder)
        if cell is not None and cell.folder == folder:
            yield cell


def files_digest(paths: Iterable[Path]) -> str:
    """Of the content of files, in this order; one that cannot be read counts as empty, which no image is."""
    digest = hashlib.sha256()
    for path in paths:
        try:
            content = path.read_bytes()
        except OSError:
            content = b""
        digest.update(hashlib.sha256(content).digest())
    return digest.hexdigest()[:16]
