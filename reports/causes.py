"""Cells in trouble, grouped by what likely is one cause: the same kind of difference at the same kind of place."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.ndimage

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.loading import ReportError
from raytruth.reports.wording import WAIVED, outcome

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from raytruth.comparisons.records.results import Cell, Results
    from raytruth.reports.cell_images import CellImages

TROUBLES = (Verdict.FAIL.value, Verdict.ERROR.value, Verdict.DECLARED.value, WAIVED)
"""The outcomes that somebody may want to look into, the most urgent first."""

NEIGHBOURS = np.ones((3, 3))
"""Pixels that touch at a corner belong to one region, too."""

NUMBER = re.compile(r"-?\d+(?:[.,]\d+)*(?:e[-+]?\d+)?")


@dataclass(frozen=True)
class CauseGroup:
    """Cells with one outcome and one kind of trouble."""

    outcome: str
    kind: str
    cells: tuple[Cell, ...]
    suspects: tuple[str, ...]
    """Features that all these scenes have, and no scene that passes on the same renderers."""


def kind_of_trouble(cell: Cell, images: CellImages | None) -> str:
    """Where and how a cell differs, in words that are the same for cells of the same kind."""
    if outcome(cell) not in {Verdict.FAIL, WAIVED} or images is None:
        return _without_numbers(cell.reason)
    try:
        return _kind_of_difference(images)
    except ReportError:
        return _without_numbers(cell.reason)


def grouped(results: Results, kinds: Mapping[str, str]) -> list[CauseGroup]:
    """The cells in trouble by outcome and kind, the most urgent outcome first, then the largest group.

    `kinds` has the kind of each of them under its folder.
    """
    found: dict[tuple[str, str], list[Cell]] = {}
    for cell in results.cells:
        if outcome(cell) in TROUBLES:
            found.setdefault((outcome(cell), kinds[cell.folder]), []).append(cell)
    groups = [
        CauseGroup(known, kind, tuple(cells), _suspects(results, cells)) for (known, kind), cells in found.items()
    ]
    return sorted(groups, key=lambda group: (TROUBLES.index(group.outcome), -len(group.cells)))


def _suspects(results: Results, cells: Iterable[Cell]) -> tuple[str, ...]:
    features = {scene.name: set(scene.features) for scene in results.scenes}
    columns = {(cell.renderer, cell.integrator) for cell in cells}
    passing = {c.scene for c in results.cells if c.verdict == Verdict.PASS and (c.renderer, c.integrator) in columns}
    if not passing:  # all features are under suspicion, which tells nothing
        return ()
    shared = set.intersection(*(features[cell.scene] for cell in cells))
    return tuple(sorted(shared.difference(*(features[scene] for scene in passing))))


def _kind_of_difference(images: CellImages) -> str:
    worst = images.distances.max(axis=-1)  # what is not a number fails
    failing = ~(worst <= 1)
    if not failing.any():
        return "No colour is wrong: the mean or the first hits are"
    return f"{_place(failing, worst >= 0)}, {_direction(images, failing)}"


def _place(failing: np.ndarray, judged: np.ndarray) -> str:
    if (failing | ~judged).all():
        return "Every pixel"
    _, regions = scipy.ndimage.label(failing, NEIGHBOURS)
    if regions == failing.sum():
        return "Single pixels"
    return "One region of pixels" if regions == 1 else "Several regions of pixels"


def _direction(images: CellImages, failing: np.ndarray) -> str:
    value = images.render[failing].astype(np.float64)
    if not np.isfinite(value).all():
        return "not a finite number"
    difference = value - images.truth[failing]
    if (difference <= 0).all():
        return "too dark"
    return "too bright" if (difference >= 0).all() else "brighter here and darker there"


def _without_numbers(reason: str) -> str:
    """The last part of a reason, which tells why, with every number left out."""
    return NUMBER.sub("…", reason.rpartition("; ")[2])
