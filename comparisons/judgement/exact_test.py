"""The verdict on an image: does every pixel lie in its feasible set?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.feasible_sets.feasible_set import UNUSED
from raytruth.comparisons.records.results import FirstHitComparison, Judgement, Verdict, WorstPixel

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.comparisons.records.renderings import FirstHits

UNJUDGED = -1.0
"""What a pixel that cannot be judged has in place of a distance in tolerances."""


@dataclass(frozen=True)
class NearestOutcomes:
    """Of each pixel the outcome that its value lies in or nearest to."""

    places: NDArray[np.int64]
    """Its place among the pixel's outcomes, shape (height, width)."""
    distances: NDArray[np.float64]
    """Each channel's distance from the middle of its box in half widths of the box, shape (height, width, 3).

    Up to 1 the value is in the box; infinity for a value that is not a number, or that differs where there is no
    tolerance at all; -1 where the pixel cannot be judged.
    """

    def in_tolerances(self) -> NDArray[np.float64]:
        """Each pixel's largest distance, shape (height, width): up to 1 the pixel is feasible."""
        worst: NDArray[np.float64] = self.distances.max(axis=2)
        return worst


def nearest_outcomes(image: ArrayLike, feasible: FeasibleSet) -> NearestOutcomes:
    """Where the values of an image of shape (height, width, 3) lie in their feasible sets."""
    distances = _channel_distances(np.asarray(image, dtype=np.float64), feasible.low, feasible.high)
    places = distances.max(axis=3).argmin(axis=2)
    nearest = np.take_along_axis(distances, places[:, :, np.newaxis, np.newaxis], axis=2)[:, :, 0]
    unjudged = (feasible.outcomes == 0)[..., np.newaxis]
    return NearestOutcomes(places, np.where(unjudged, UNJUDGED, nearest))


def distances_in_tolerances(image: ArrayLike, feasible: FeasibleSet) -> NDArray[np.float64]:
    """Each pixel's distance from its nearest outcome, shape (height, width): up to 1 it is feasible, -1 unjudged."""
    return nearest_outcomes(image, feasible).in_tolerances()


def judge_image(
    image: NDArray[np.float32], truth: NDArray[np.float64], feasible: FeasibleSet
) -> tuple[Judgement, NearestOutcomes]:
    """The counts and the worst pixel, and where each pixel's value lies."""
    nearest = nearest_outcomes(image, feasible)
    return judgement_of(nearest.in_tolerances(), image, truth, feasible), nearest


def judgement_of(
    distances: NDArray[np.float64], image: NDArray[np.float32], truth: NDArray[np.float64], feasible: FeasibleSet
) -> Judgement:
    """The counts and the worst pixel of an image whose pixels have these distances, shape (height, width)."""
    return Judgement(
        pixels=distances.size,
        failing=int((distances > 1).sum()),
        unjudged=int((feasible.outcomes == 0).sum()),
        capped=int(feasible.merged.sum()),
        ambiguous=int((feasible.outcomes > 1).sum()),
        worst=worst_pixel(image, truth, feasible, distances),
    )


def verdict_of(judgement: Judgement) -> tuple[Verdict, str]:
    """Pass if every judged pixel lies in its feasible set, and at least one could be judged."""
    judged = judgement.pixels - judgement.unjudged
    if judged == 0:
        return Verdict.FAIL, "no pixel could be judged: this arithmetic leaves everything open"
    pixels = "judged pixels" if judgement.unjudged else "pixels"
    aside = capped_in_words(judgement)
    if judgement.failing:
        return Verdict.FAIL, f"{judgement.failing} of {judged} {pixels} lie outside their feasible sets{aside}"
    return Verdict.PASS, f"all {judged} {pixels} lie in their feasible sets{aside}"


def capped_in_words(judgement: Judgement) -> str:
    """The counts of pixels that are not judged by each of their outcomes, in parentheses; nothing if there are none."""
    counts = {"in a box of several outcomes": judgement.capped, "not judged": judgement.unjudged}
    words = [f"{count} {what}" for what, count in counts.items() if count]
    return f" ({', '.join(words)})" if words else ""


def largest_error(image: NDArray[np.float32], truth: NDArray[np.float64], feasible: FeasibleSet) -> float:
    """The largest absolute difference of a channel over the judged pixels: from the truth, or the nearest outcome."""
    value = np.asarray(image, dtype=np.float64)
    from_truth = np.abs(value - truth)
    middles = 0.5 * (feasible.low + feasible.high)
    with np.errstate(invalid="ignore"):  # of two infinities
        from_outcomes = np.abs(value[:, :, np.newaxis] - middles)
    place = np.argmin(_filled(from_outcomes.max(axis=3)), axis=2)
    nearest = np.take_along_axis(from_outcomes, place[:, :, np.newaxis, np.newaxis], axis=2)[:, :, 0]
    ambiguous = (feasible.outcomes > 1)[:, :, np.newaxis]
    errors = np.where(ambiguous, np.minimum(nearest, from_truth), from_truth)
    return float(errors[feasible.outcomes > 0].max(initial=0.0))


def judge_first_hits(hits: FirstHits, feasible: FeasibleSet) -> FirstHitComparison:
    """The first hits against their feasible sets: primitive, distance, position and normal of one outcome must fit."""
    with np.errstate(invalid="ignore"):
        values = np.concatenate([hits.depth[..., np.newaxis], hits.position, hits.normal], axis=2)
    places = feasible.hit_primitives != UNUSED
    same_primitive = places & (feasible.hit_primitives == hits.primitive[..., np.newaxis])
    nothing = hits.primitive < 0
    fits = _box_distances(values, feasible.hit_low, feasible.hit_high) <= 1
    agrees = (same_primitive & (fits | nothing[..., np.newaxis])).any(axis=2)
    judged = places.any(axis=2)
    certain = judged & (places.sum(axis=2) == 1)
    compared = certain & ~nothing & same_primitive[..., 0]
    middles = 0.5 * (feasible.hit_low + feasible.hit_high)[..., 0, :]
    differences = np.abs(values - middles)[compared]
    largest = differences.max(axis=0) if len(differences) else np.zeros(values.shape[2])
    return FirstHitComparison(
        compared=int(judged.sum()),
        primitive_mismatches=int((judged & ~same_primitive.any(axis=2)).sum()),
        ambiguous=int((judged & ~certain).sum()),
        largest_depth_error=float(largest[0]),
        largest_position_error=float(largest[1:4].max()),
        largest_normal_error=float(largest[4:].max()),
        failing=int((judged & ~agrees).sum()),
    )


def verdict_of_first_hits(hits: FirstHitComparison) -> tuple[Verdict, str]:
    """Pass if every judged first hit lies in its feasible set, and at least one could be judged."""
    if hits.compared == 0:
        return Verdict.FAIL, "no first hit could be judged: this arithmetic leaves everything open"
    if hits.failing:
        return Verdict.FAIL, f"{hits.failing} of {hits.compared} first hits lie outside their feasible sets"
    return Verdict.PASS, f"all {hits.compared} first hits lie in their feasible sets"


def _box_distances(
    values: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distance of values (h, w, c) from boxes (h, w, k, c) in the worst channel: (h, w, k)."""
    worst: NDArray[np.float64] = _channel_distances(values, low, high).max(axis=3)
    return worst


def _channel_distances(
    values: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distance of values (h, w, c) from boxes (h, w, k, c) in half widths: (h, w, k, c), infinity for unused boxes.

    At most 1 exactly where the value is in the box, also where that ends in infinity, as where half floats overflow.
    """
    value = values[:, :, np.newaxis]
    inside = (low <= value) & (value <= high)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        middle, half_width = 0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low
        difference = np.abs(value - middle)
        in_widths = np.where(difference == 0, 0.0, difference / half_width)
    beyond_one = np.nextafter(1.0, 2.0)
    judged = np.where(inside, np.fmin(in_widths, 1.0), np.fmax(in_widths, beyond_one))
    undefined = np.isnan(low) | np.isnan(high) | np.isnan(value)
    distances: NDArray[np.float64] = np.where(undefined, np.inf, judged)
    return distances


def _filled(distances: NDArray[np.float64]) -> NDArray[np.float64]:
    """Infinity in place of what is not a number."""
    return np.where(np.isnan(distances), np.inf, distances)


def worst_pixel(
    image: NDArray[np.float32], truth: NDArray[np.float64], feasible: FeasibleSet, distances: NDArray[np.float64]
) -> WorstPixel:
    """The pixel with the largest distance in tolerances, and the box of its outcomes that is nearest."""
    y, x = np.unravel_index(int(np.argmax(distances)), distances.shape)
    boxes = _box_distances(
        image[y : y + 1, x : x + 1].astype(np.float64),
        feasible.low[y : y + 1, x : x + 1],
        feasible.high[y : y + 1, x : x + 1],
    )
    place = int(np.argmin(boxes[0, 0]))
    return WorstPixel(
        x=int(x),
        y=int(y),
        value=_triple(image[y, x]),
        truth=_triple(truth[y, x]),
        low=_triple(feasible.low[y, x, place]),
        high=_triple(feasible.high[y, x, place]),
        tolerances=float(distances[y, x]),
    )


def _triple(values: ArrayLike) -> tuple[float, float, float]:
    red, green, blue = np.asarray(values, dtype=np.float64).tolist()
    return red, green, blue
