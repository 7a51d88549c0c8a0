"""Does every pixel of an image lie in its feasible set?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.judgement.declared_pixels import as_declared, declared_pixels
from raytruth.comparisons.records.results import Judgement, WorstPixel

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet

UNJUDGED = -1.0
"""What a pixel that cannot be judged has in place of a distance in tolerances."""


@dataclass(frozen=True)
class NearestOutcomes:
    """For each pixel the outcome that its value lies in, or else is nearest to."""

    places: NDArray[np.int64]
    """Its place among the pixel's outcomes, shape (height, width)."""
    distances: NDArray[np.float64]
    """Each channel's distance from the middle of its box in half widths of the box, shape (height, width, 3).

    Up to 1 the value is in the box; infinity for a value that is not a number, or that differs where there is no
    tolerance at all; -1 where the pixel cannot be judged.
    """

    is_due: NDArray[np.bool_]
    """Whether that outcome is due at the pixel, and not only as declared; shape (height, width)."""

    def by_shortcut(self) -> NDArray[np.bool_]:
        """Which pixels only a declared shortcut explains, shape (height, width)."""
        distances = self.in_tolerances()
        explained: NDArray[np.bool_] = (distances >= 0) & (distances <= 1) & ~self.is_due
        return explained

    def in_tolerances(self) -> NDArray[np.float64]:
        """Each pixel's largest distance, shape (height, width): up to 1 the pixel is feasible."""
        worst: NDArray[np.float64] = self.distances.max(axis=2)
        return worst


def nearest_outcomes(image: ArrayLike, feasible: FeasibleSet) -> NearestOutcomes:
    """Where the values of an image of shape (height, width, 3) lie in their feasible sets.

    A value that lies in several boxes is taken for what is due, if one of them is.
    """
    distances = _channel_distances(np.asarray(image, dtype=np.float64), feasible.low, feasible.high)
    worst = distances.max(axis=3)
    is_due = feasible.due & (worst <= 1)
    places = np.where(is_due, -1.0, worst).argmin(axis=2)  # -1 is less than any distance
    nearest = np.take_along_axis(distances, places[:, :, np.newaxis, np.newaxis], axis=2)[:, :, 0]
    unjudged = (feasible.outcomes == 0)[..., np.newaxis]
    nearest_is_due = np.take_along_axis(feasible.due, places[..., np.newaxis], axis=2)[..., 0]
    return NearestOutcomes(places, np.where(unjudged, UNJUDGED, nearest), nearest_is_due)


def distances_in_tolerances(image: ArrayLike, feasible: FeasibleSet) -> NDArray[np.float64]:
    """Each pixel's distance from its nearest outcome, shape (height, width): up to 1 it is feasible, -1 unjudged."""
    return nearest_outcomes(image, feasible).in_tolerances()


def judge_image(
    image: NDArray[np.float32], truth: NDArray[np.float64], feasible: FeasibleSet
) -> tuple[Judgement, NearestOutcomes]:
    """Judge an image of shape (height, width, 3): counts and worst pixel, and where each pixel's value lies."""
    nearest = nearest_outcomes(image, feasible)
    declared = as_declared(image, truth, nearest.by_shortcut())
    return judgement_of(nearest.in_tolerances(), image, truth, feasible, declared), nearest


def judgement_of(
    distances: NDArray[np.float64],
    image: NDArray[np.float32],
    truth: NDArray[np.float64],
    feasible: FeasibleSet,
    declared: NDArray[np.bool_],
) -> Judgement:
    """The judgement of an image by its pixels' distances in tolerances, shape (height, width).

    `declared`, of the same shape, says which pixels are as declared, not as due.
    """
    return Judgement(
        pixels=distances.size,
        failing=int((distances > 1).sum()),
        unjudged=int((feasible.outcomes == 0).sum()),
        capped=int(feasible.merged.sum()),
        ambiguous=int((feasible.outcomes > 1).sum()),
        declared=declared_pixels(image, truth, declared),
        worst=worst_pixel(image, truth, feasible, distances),
    )


def largest_error(image: NDArray[np.float32], truth: NDArray[np.float64], feasible: FeasibleSet) -> float:
    """The largest difference of a channel over the judged pixels: from the truth, or from the nearest due outcome."""
    value = np.asarray(image, dtype=np.float64)
    from_truth = np.abs(value - truth)
    with np.errstate(invalid="ignore"):  # of two infinities: the middle of a box without bounds is not a number
        middles = np.where(feasible.due[..., np.newaxis], 0.5 * (feasible.low + feasible.high), np.nan)
        from_outcomes = np.abs(value[:, :, np.newaxis] - middles)
    place = np.argmin(_filled(from_outcomes.max(axis=3)), axis=2)
    nearest = np.take_along_axis(from_outcomes, place[:, :, np.newaxis, np.newaxis], axis=2)[:, :, 0]
    ambiguous = (feasible.outcomes > 1)[:, :, np.newaxis]
    errors = np.where(ambiguous, np.fmin(nearest, from_truth), from_truth)
    return float(errors[feasible.outcomes > 0].max(initial=0.0))


def box_distances(
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
    boxes = box_distances(
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
