"""Who agrees with whom, and with the truth, on one scene: read from a results directory alone.

Renderers of one family share code and count as one opinion. A reference whose values are feasible agrees with the
truth, and so with each other one that does. Two that are both outside of their feasible sets agree where their values
differ by no more than what their arithmetics allow both together.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.confirmation import JUDGED, families, left_open_by
from raytruth.reports.loading import ReportError, read_colours, read_evidence
from raytruth.reports.wording import listed, number, plural

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.comparisons.records.results import Cell, Results
    from raytruth.reports.confirmation import Pixel


@dataclass(frozen=True)
class Comparison:
    """Two references, or one and the truth; `largest` is a difference of colours, None where one gives none."""

    agree: bool
    largest: float | None
    pixels: int | None
    """How many pixels disagree; None where that is not known."""


@dataclass(frozen=True)
class Agreement:
    """Which references agree with the truth, and with each other, on one scene."""

    names: tuple[str, ...]
    with_truth: tuple[Comparison, ...]
    """How each reference agrees with the truth."""
    pairs: dict[tuple[int, int], Comparison | None]
    """How two references agree, by their places in `names`, the smaller first; None where one has no image."""
    sentences: tuple[str, ...]


def agreement_on(directory: Path, results: Results, scene: str) -> Agreement | None:
    """The agreement on a scene; None where no reference was judged."""
    known = families(results)
    cells = [c for c in results.cells if c.scene == scene and c.verdict in JUDGED and c.renderer in known]
    if not cells:
        return None
    opinions = [_opinion(directory, cell) for cell in cells]
    pairs = {
        (i, j): None if (a := opinions[i]) is None or (b := opinions[j]) is None else _compare(a, b)
        for i, j in combinations(range(len(cells)), 2)
    }
    sentences = (_confirmation(cells, known), *_wrong(cells, opinions, known), *_declared(cells))
    return Agreement(tuple(map(_name, cells)), tuple(map(_with_truth, cells)), pairs, sentences)


@dataclass(frozen=True)
class _Opinion:
    """The image of a reference, and what it is held to."""

    image: NDArray[np.float32]
    """Shape (height, width, 3)."""
    feasible: NDArray[np.bool_]
    """Shape (height, width): also where nothing can be said."""
    tolerance: NDArray[np.float32]
    """Half the width of the nearest outcome's box, shape (height, width, 3)."""
    certain: NDArray[np.bool_]
    """Whether there is one outcome, shape (height, width)."""


def _opinion(directory: Path, cell: Cell) -> _Opinion | None:
    """None where the cell has no image, or where its files cannot be read, which its own part of the page tells."""
    if cell.images is None:
        return None
    try:
        image = read_colours(directory, cell.images.render)
        distances = read_colours(directory, cell.images.tolerances)
        evidence = read_evidence(directory, cell.images.feasible)
    except ReportError:
        return None
    if not image.shape == distances.shape == (*evidence.nearest.shape, 3):
        return None
    nearest = evidence.nearest[..., np.newaxis, np.newaxis]
    low = np.take_along_axis(evidence.low, nearest, axis=2)[:, :, 0]
    high = np.take_along_axis(evidence.high, nearest, axis=2)[:, :, 0]
    certain = (~np.isnan(evidence.low[..., 0])).sum(axis=2) == 1
    with np.errstate(over="ignore", invalid="ignore"):
        feasible: NDArray[np.bool_] = distances.max(axis=2) <= 1
        tolerance: NDArray[np.float32] = ((high - low) / 2).astype(np.float32)
    return _Opinion(image, feasible, tolerance, certain)


def _compare(a: _Opinion, b: _Opinion) -> Comparison | None:
    if a.image.shape != b.image.shape:
        return None
    with np.errstate(over="ignore", invalid="ignore"):
        differences = np.abs(a.image.astype(np.float64) - b.image)
        near = (differences <= a.tolerance + b.tolerance).all(axis=2)
    agree = (a.feasible & b.feasible) | (~a.feasible & ~b.feasible & near)
    # At an edge right renderers may differ by all that there is.
    counted = differences[a.certain & b.certain if agree.all() else ~agree]
    largest = float(counted.max(initial=0.0)) if not np.isnan(counted).any() else float("nan")
    return Comparison(bool(agree.all()), largest, int((~agree).sum()))


def _with_truth(cell: Cell) -> Comparison:
    part = cell.judgement if cell.judgement is not None else cell.first_hits
    if part is None:
        return Comparison(cell.verdict == Verdict.PASS, cell.largest_error, None)
    declared = part.declared if isinstance(part.declared, int) else part.declared.count if part.declared else 0
    return Comparison(cell.verdict == Verdict.PASS, cell.largest_error, part.failing + declared)


def _confirmation(cells: list[Cell], known: Mapping[str, str]) -> str:
    """How many opinions there are, and how many agree with the truth."""
    by_project: dict[str, list[Cell]] = {}
    for cell in cells:
        by_project.setdefault(known[cell.renderer], []).append(cell)
    right = {name: left for name in sorted(by_project) if (left := left_open_by(by_project[name])) is not None}
    if not right:
        return "No independent reference agrees with the truth here."
    names = listed([_with_limits(name, left, by_project[name]) for name, left in right.items()])
    if len(by_project) == 1:
        return f"One independent reference agrees with the truth: {names}."
    everyone = "Both" if len(right) == 2 else f"All {len(right)}"
    count = everyone if len(right) == len(by_project) else f"{len(right)} of {len(by_project)}"
    return f"{count} independent references {'agree' if len(right) > 1 else 'agrees'} with the truth: {names}."


def _with_limits(project: str, left_open: frozenset[Pixel], cells: Iterable[Cell]) -> str:
    """A project's name, and how far its agreement goes."""
    if left_open:
        return f"{project} (but for {len(left_open)} {plural('pixel', len(left_open))})"
    seen = any(cell.images is not None and cell.verdict == Verdict.PASS for cell in cells)
    return project if seen else f"{project} (first hits only)"


def _declared(cells: list[Cell]) -> list[str]:
    """A sentence for each reference that is as declared, not as due."""
    return [
        f"{_name(cell)} is as declared, not as due, and confirms nothing at those pixels: {cell.reason}."
        for cell in cells
        if cell.verdict == Verdict.DECLARED
    ]


def _wrong(cells: list[Cell], opinions: list[_Opinion | None], known: Mapping[str, str]) -> list[str]:
    """A sentence for each reference that is wrong, with the pixel."""
    return [
        _wrong_sentence(cell, opinion, cells, opinions, known)
        for cell, opinion in zip(cells, opinions, strict=True)
        if cell.verdict == Verdict.FAIL
    ]


def _wrong_sentence(
    cell: Cell, opinion: _Opinion | None, cells: list[Cell], opinions: list[_Opinion | None], known: Mapping[str, str]
) -> str:
    judgement = cell.judgement
    if judgement is None or judgement.worst is None or opinion is None or not judgement.failing:
        return f"{_name(cell)} is wrong: {cell.reason}."
    x, y = judgement.worst.x, judgement.worst.y
    others = [
        (_name(other), view)
        for other, view in zip(cells, opinions, strict=True)
        if view is not None
        and known[other.renderer] != known[cell.renderer]
        and view.image.shape == opinion.image.shape
    ]
    says = f"it says {_colour(judgement.worst.value)}, the truth is {_colour(judgement.worst.truth)}"
    right = [f"{name} says {_colour(view.image[y, x].tolist())}" for name, view in others if view.feasible[y, x]]
    at = (slice(y, y + 1), slice(x, x + 1))
    allies = [
        name
        for name, view in others
        if not view.feasible[y, x] and (pair := _compare(_cut(view, at), _cut(opinion, at))) is not None and pair.agree
    ]
    sentence = (
        f"{_name(cell)} is wrong at {judgement.failing:,} of {judgement.pixels:,} pixels, "
        f"worst at ({x}, {y}): {', '.join([says, *right])}."
    )
    if allies:
        return f"{sentence} {listed(allies)} {'says' if len(allies) == 1 else 'say'} the same: look at the truth first."
    return sentence


def _cut(opinion: _Opinion, at: tuple[slice, slice]) -> _Opinion:
    return _Opinion(opinion.image[at], opinion.feasible[at], opinion.tolerance[at], opinion.certain[at])


def _name(cell: Cell) -> str:
    return f"{cell.renderer}/{cell.integrator}"


def _colour(values: Iterable[float]) -> str:
    return f"({', '.join(number(value) for value in values)})"
