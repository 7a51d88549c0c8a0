"""The feasible sets of an image: what a renderer with a given error model may give each pixel.

The tracer's own source is evaluated in balls of the renderer's precision, along every way that an undecided comparison
can go: as it is, which gives what is due, and with the renderer's shortcuts, which gives what is declared. So the
tolerance follows from the arithmetic and from the pixel's conditioning.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb

from raytruth.comparisons.error_models.departures import NONE
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.shortcuts import has_shortcuts, without_departures, without_shortcuts
from raytruth.comparisons.feasible_sets.declared_outcomes import (
    Outcomes,
    all_due,
    beside_what_is_due,
    bounds_of,
    due_as_far_as,
    hits_beside_what_is_due,
    looking_different,
    proven,
    with_truth,
)
from raytruth.comparisons.feasible_sets.pixel_outcomes import PixelOutcomes, brightest_of
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.declared_outcomes import Bounds, DueHits
    from raytruth.comparisons.feasible_sets.plain_pixels import Colors
    from raytruth.comparisons.feasible_sets.rounded_rays import Pixel
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.reference_tracer.certified_image import CertifiedImage
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class FeasibleSet:
    """Boxes of feasible colours, one an outcome, at most K a pixel, and of feasible first hits, at most L a pixel.

    Unused places hold NaN. A pixel of which nothing can be said has no outcome at all, and is not judged.
    """

    low: NDArray[np.float64]
    """Shape (height, width, K, 3)."""
    high: NDArray[np.float64]
    due: NDArray[np.bool_]
    """Shape (height, width, K): whether the renderer's arithmetic alone leads to the outcome. The others come from a
    shortcut that it declares, and may be far from the truth."""
    merged: NDArray[np.bool_]
    """Shape (height, width): whether there were too many outcomes to tell apart, so that one box holds several."""
    hit_primitives: NDArray[np.int64]
    """Shape (height, width, L); -1: nothing is hit; -2: unused place."""
    hit_low: NDArray[np.float64]
    """Shape (height, width, L, 7): distance, position, normal."""
    hit_high: NDArray[np.float64]
    hit_due: NDArray[np.bool_]
    """As `due`, shape (height, width, L)."""

    @property
    def outcomes(self) -> NDArray[np.int64]:
        """How many outcomes each pixel has, 0 where it cannot be judged; shape (height, width)."""
        counts: NDArray[np.int64] = (~np.isnan(self.low[..., 0])).sum(axis=2)
        return counts

    def hull(self, *, due_only: bool = False) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The least box that holds all outcomes of a pixel: low and high ends, shape (height, width, 3) each.

        With `due_only`, all outcomes that are due; every pixel with an outcome has one of these, unless the renderer
        departs from the specification. NaN where there are none.
        """
        counted = self.due[..., np.newaxis] if due_only else True
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # of pixels without outcomes
            low, high = (np.where(counted, end, np.nan) for end in (self.low, self.high))
            return np.nanmin(low, axis=2), np.nanmax(high, axis=2)


UNUSED = -2
HIT_VALUES = 7
NO_VALUES = (arb("nan"),) * HIT_VALUES
FIRST_HIT_OUTPUT = OutputModel("float32")
"""What renderers tell of first hits, they tell in float32 at least."""


def feasible_set(
    scene: Scene,
    error_model: ErrorModel,
    behaviour: Behaviour = IDEAL,
    *,
    truth: CertifiedImage | None = None,
    with_colors: bool = True,
) -> FeasibleSet:
    """The feasible sets of all pixels of a scene; `behaviour` is what the renderer does besides its error model.

    They hold what the declared model may give, and what its arithmetic alone may give without the shortcuts that it
    declares: that is due. Of a renderer that departs from the specification they hold what it may give as declared and
    nothing else, not even the truth; of that is due what the specification may give, too. With `truth`, the certified
    image by the same rays, all other sets hold the truth, and what is due is found only where a declared outcome may
    look different from the truth, which is much quicker. Elsewhere all that is declared counts as due.
    Without colours only the feasible sets of first hits are made, and no pixel has an outcome.
    Raises ValueError for a behaviour that changes what the error model changes, too.
    """
    bound = radiance_bound(scene)
    pixels = [(column, row) for row in range(scene.camera.height) for column in range(scene.camera.width)]
    declared = PixelOutcomes(scene, error_model, behaviour, bound)
    colors, hits = declared.colors_and_hits(pixels, with_colors=with_colors)
    outcomes = [all_due(color) for color in colors]
    first_hits: list[DueHits] = [[(hit, True) for hit in of_pixel or ()] for of_pixel in hits]
    departs = error_model.departures != NONE
    if departs or has_shortcuts(error_model):
        ideal = PixelOutcomes(scene, without_departures(without_shortcuts(error_model)), behaviour, bound)
        places = looking_different(outcomes, pixels, truth)
        for place, due in _due_outcomes(ideal, pixels, colors, places, truth).items():
            if departs:
                outcomes[place] = due_as_far_as(with_truth(due, pixels[place], truth), outcomes[place])
            else:
                outcomes[place] = beside_what_is_due(outcomes[place], due)
        if error_model.ray_offset.ignores_near_hits:  # the one shortcut that camera rays take
            _, due_hits = ideal.colors_and_hits(pixels, with_colors=False)
            first_hits = [hits_beside_what_is_due(*both) for both in zip(hits, due_hits, strict=True)]
    if not departs:
        outcomes = [with_truth(of_pixel, pixel, truth) for of_pixel, pixel in zip(outcomes, pixels, strict=True)]
    return _as_arrays(scene, error_model, outcomes, first_hits)


def _due_outcomes(
    ideal: PixelOutcomes,
    pixels: Sequence[Pixel],
    colors: Sequence[Colors | None],
    places: Sequence[int],
    truth: CertifiedImage | None,
) -> dict[int, Outcomes]:
    """What is due at these places: the outcomes without shortcuts, or the truth where nothing can be said of them.

    What took too long with shortcuts would take as long without, so that the truth does there, too.
    """
    due = {place: proven(pixels[place], truth) for place in places}
    spent = {place for place in places if (color := colors[place]) and color.spent}
    sought = [place for place in places if place not in spent or not due[place].boxes]
    found, _ = ideal.colors_and_hits(
        [pixels[place] for place in sought], with_hits=False, brightest=brightest_of(colors)
    )
    return due | {place: all_due(color) for place, color in zip(sought, found, strict=True) if color}


def _as_arrays(scene: Scene, error_model: ErrorModel, outcomes: list[Outcomes], hits: list[DueHits]) -> FeasibleSet:
    size = (scene.camera.height, scene.camera.width)
    ends = _gathered([of_pixel.boxes for of_pixel in outcomes], size, 3)
    low, high = error_model.output.interval_read(*_flushed(*ends, error_model.smallest))
    primitives = [[hit.primitive for hit, _ in of_pixel] for of_pixel in hits]
    hit_bounds = [[bounds_of(hit.values or NO_VALUES) for hit, _ in of_pixel] for of_pixel in hits]
    hit_low, hit_high = FIRST_HIT_OUTPUT.interval_read(*_gathered(hit_bounds, size, HIT_VALUES))
    return FeasibleSet(
        low=low,
        high=high,
        due=_in_places([of_pixel.due for of_pixel in outcomes], low.shape[:3], True),
        merged=np.array([of_pixel.merged for of_pixel in outcomes]).reshape(size),
        hit_primitives=_in_places(primitives, hit_low.shape[:3], UNUSED),
        hit_low=hit_low,
        hit_high=hit_high,
        hit_due=_in_places([[is_due for _, is_due in of_pixel] for of_pixel in hits], hit_low.shape[:3], True),
    )


def _flushed(
    low: NDArray[np.float64], high: NDArray[np.float64], smallest: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Boxes that hold also what is off by the smallest number that is kept; 0 and no less of what is not negative."""
    return np.where(low >= 0.0, np.maximum(low - smallest, 0.0), low - smallest), high + smallest


def _in_places(of_pixels: Sequence[Sequence[Any]], shape: tuple[int, ...], unused: Any) -> NDArray[Any]:
    """An array of shape (height, width, places); places that a pixel does not need hold `unused`."""
    array = np.full((len(of_pixels), shape[2]), unused)
    for pixel, values in enumerate(of_pixels):
        array[pixel, : len(values)] = values
    return array.reshape(shape)


def _gathered(
    of_pixels: Sequence[Sequence[Bounds]], size: tuple[int, int], values: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Arrays of low and high ends, of shape (height, width, most boxes of a pixel, values)."""
    most = max(1, *(len(boxes) for boxes in of_pixels))
    both = np.full((len(of_pixels), most, values, 2), np.nan)
    for place, boxes in enumerate(of_pixels):
        if boxes:
            both[place, : len(boxes)] = boxes
    both = both.reshape(*size, most, values, 2)
    return both[..., 0], both[..., 1]
