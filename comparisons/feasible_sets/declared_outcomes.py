"""Which outcomes of a pixel are due, and which come only from a shortcut that a renderer declares."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.measures.visibility import differs_visibly

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from raytruth.comparisons.feasible_sets.feasible_pixel import FirstHit
    from raytruth.comparisons.feasible_sets.plain_pixels import Colors
    from raytruth.comparisons.feasible_sets.rounded_rays import Pixel
    from raytruth.reference_tracer.certified_image import CertifiedImage

Bounds = list[tuple[float, float]]
"""The ends of intervals, here one a colour channel."""
DueHits = list[tuple["FirstHit", bool]]
"""First hits, each with whether it is due."""


@dataclass(frozen=True)
class Outcomes:
    """The feasible colours of one pixel as boxes, and whether each is due; none where the pixel cannot be judged."""

    boxes: list[Bounds]
    due: list[bool]
    merged: bool


def all_due(color: Colors | None) -> Outcomes:
    """Outcomes for a pixel's feasible colours, all of them taken for due; none where nothing is known of the pixel."""
    boxes = [bounds_of(box) for box in color.boxes] if color else []
    return Outcomes(boxes, [True] * len(boxes), color is not None and color.merged)


def looking_different(outcomes: Sequence[Outcomes], pixels: Sequence[Pixel], truth: CertifiedImage | None) -> list[int]:
    """The places of pixels of which an outcome may visibly differ from the truth, or the truth is unknown or a tie."""
    places = [place for place, of_pixel in enumerate(outcomes) if of_pixel.boxes]
    if truth is None or not places:
        return places
    columns, rows = np.array([pixels[place] for place in places]).T
    counts = np.array([len(outcomes[place].boxes) for place in places])
    ends = np.array([box for place in places for box in outcomes[place].boxes])  # shape (outcomes, 3, 2)
    middles = np.repeat(truth.middle[rows, columns], counts, axis=0)
    differs = differs_visibly(ends, middles[..., np.newaxis]).any(axis=(1, 2))
    of_pixels = np.logical_or.reduceat(differs, np.cumsum(counts) - counts)
    looks_so = of_pixels | ~truth.decided[rows, columns]
    return [place for place, is_so in zip(places, looks_so.tolist(), strict=True) if is_so]


def with_truth(outcomes: Outcomes, pixel: Pixel, truth: CertifiedImage | None) -> Outcomes:
    """The outcomes of a pixel, of which one that is due holds its proven value, if that is known.

    A renderer that rounds an index of refraction when it stores it computes for another one than the truth does. So its
    outcomes may all lie beside the truth: then the nearest is widened up to there, or the truth is one more outcome
    where one could see the difference.
    """
    proof = proven(pixel, truth).boxes
    due = [place for place, is_due in enumerate(outcomes.due) if is_due]
    if not proof or not due or any(_is_in(proof[0], outcomes.boxes[place]) for place in due):
        return outcomes
    hulls = {place: _hull(outcomes.boxes[place], proof[0]) for place in due}
    nearest = min(due, key=lambda place: max(high - low for low, high in hulls[place]))
    if differs_visibly(outcomes.boxes[nearest], proof[0]).any():
        return replace(outcomes, boxes=[*outcomes.boxes, *proof], due=[*outcomes.due, True])
    boxes = [hulls[place] if place == nearest else box for place, box in enumerate(outcomes.boxes)]
    return replace(outcomes, boxes=boxes)


def proven(pixel: Pixel, truth: CertifiedImage | None) -> Outcomes:
    """The pixel's proven value as its one outcome, which is due; no outcome where that value is unknown or a tie.

    It stands in where the arithmetic leaves everything open even without its shortcuts.
    """
    column, row = pixel
    if truth is None or not truth.decided[row, column]:
        return Outcomes([], [], merged=False)
    middle, radius = truth.middle[row, column].tolist(), truth.radius[row, column].tolist()
    return Outcomes([list(map(_widened, middle, radius))], [True], merged=False)


def beside_what_is_due(declared: Outcomes, due: Outcomes) -> Outcomes:
    """All outcomes of a pixel: what is due, then the declared ones outside of that; these alone if none is due."""
    if not due.boxes:
        return declared
    others = [box for box in declared.boxes if not any(_is_in(box, other) for other in due.boxes)]
    is_due = [True] * len(due.boxes) + [False] * len(others)
    return Outcomes([*due.boxes, *others], is_due, due.merged or declared.merged)


def due_as_far_as(due: Outcomes, outcomes: Outcomes) -> Outcomes:
    """The outcomes of a renderer that departs from the specification: what they have in common with what is due is due.

    Of an outcome that is due in part, that part comes first, as a box of its own.
    """
    whole = [any(_is_in(box, other) for other in due.boxes) for box in outcomes.boxes]
    partly = [box for box, is_due in zip(outcomes.boxes, whole, strict=True) if not is_due]
    common = [_common(box, other) for box in partly for other in due.boxes]
    parts = [part for part in common if all(low <= high for low, high in part)]
    return Outcomes([*parts, *outcomes.boxes], [True] * len(parts) + whole, outcomes.merged)


def hits_beside_what_is_due(declared: list[FirstHit] | None, due: list[FirstHit] | None) -> DueHits:
    """All first hits of a pixel: those due, then declared ones of other primitives; none where either is unknown."""
    if declared is None or due is None:
        return []
    primitives = {hit.primitive for hit in due}
    return [*((hit, True) for hit in due), *((hit, False) for hit in declared if hit.primitive not in primitives)]


def bounds_of(balls: Iterable[Any]) -> Bounds:
    """The ends of each ball, below and above, widened by what float64 rounds."""
    return [_widened(float(ball.mid()), float(ball.rad())) for ball in balls]


def _widened(middle: float, radius: float) -> tuple[float, float]:
    radius += (abs(middle) + radius) * 2.0**-52
    return middle - radius, middle + radius


def _hull(box: Bounds, other: Bounds) -> Bounds:
    return [(min(a, low), max(b, high)) for (a, b), (low, high) in zip(box, other, strict=True)]


def _common(box: Bounds, other: Bounds) -> Bounds:
    return [(max(a, low), min(b, high)) for (a, b), (low, high) in zip(box, other, strict=True)]


def _is_in(box: Bounds, other: Bounds) -> bool:
    return all(low <= a and b <= high for (a, b), (low, high) in zip(box, other, strict=True))
