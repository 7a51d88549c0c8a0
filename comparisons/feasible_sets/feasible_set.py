"""The feasible sets of an image: what a renderer with a given error model may give each pixel.

The tracer's own source is evaluated in balls of the renderer's precision, with the renderer's ray offsets, along every
way that an undecided comparison can go. So the tolerance follows from the arithmetic and from the pixel's conditioning.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.feasible_sets.feasible_pixel import FirstHit, PixelEvaluator, UndecidableError, widest
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.feasible_sets.rounded_rays import LinkedRays, PlainRays
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.rounded_rays import Box
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
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
        """The least box that holds all outcomes of each pixel; NaN where there are none; shape (height, width, 3).

        Or all outcomes that are due; every pixel with an outcome has one of these.
        """
        counted = self.due[..., np.newaxis] if due_only else True
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # of pixels without outcomes
            low, high = (np.where(counted, end, np.nan) for end in (self.low, self.high))
            return np.nanmin(low, axis=2), np.nanmax(high, axis=2)


UNUSED = -2
HIT_VALUES = 7
NO_VALUES = (arb("nan"),) * HIT_VALUES
# Of the image's largest value, a quarter of a step of an 8-bit picture: wider, and a test of the pixel would be weak.
WIDE = 2.0**-10
FLOAT32_BITS = 24
FIRST_HIT_OUTPUT = OutputModel("float32")
"""What renderers tell of first hits, they tell in float32 at least."""


def feasible_set(
    scene: Scene,
    error_model: ErrorModel,
    behaviour: Behaviour = IDEAL,
    *,
    with_colors: bool = True,
) -> FeasibleSet:
    """The feasible sets of all pixels of a scene; `behaviour` is what the renderer does besides its error model.

    All pixels are evaluated in plain balls, which is quick; in linked ones those of which plain ones say nothing, or
    cannot tell all outcomes apart, and those whose boxes are wide beside the image's brightest value.
    Without colours only the feasible sets of first hits are made, and no pixel has an outcome.
    Raises ValueError for a behaviour that changes what the error model changes, too.
    """
    bound = radiance_bound(scene)
    pixels = [(column, line) for line in range(scene.camera.height) for column in range(scene.camera.width)]
    model_of_light = error_model.of_light()
    plain = PixelEvaluator(PlainRays(scene, error_model, behaviour), bound, FLOAT32_BITS)
    plain_light = plain
    if with_colors and model_of_light is not error_model:
        plain_light = PixelEvaluator(PlainRays(scene, model_of_light, behaviour), bound, FLOAT32_BITS)
    colors: list[_Colors | None] = []
    hits = []
    for pixel in pixels:
        colors.append(_colors(plain_light, pixel, may_merge=False) if with_colors else None)
        hits.append(_first_hits(plain, pixel))
    # Made only where they are needed; often the error model is that of light, too.
    linked = cache(lambda model: PixelEvaluator(LinkedRays(scene, model, behaviour), bound, FLOAT32_BITS))
    if with_colors:
        unclear = {place for place, color in enumerate(colors) if color is None}
        for place in unclear:
            pixel = pixels[place]
            colors[place] = _colors(linked(model_of_light), pixel) or _colors(plain_light, pixel)
        widest_radius = WIDE * _brightest(colors)
        wide = {place for place, color in enumerate(colors) if color and widest(color.boxes) > widest_radius}
        for place in wide - unclear:
            colors[place] = _colors(linked(model_of_light), pixels[place]) or colors[place]
    for place, hit in enumerate(hits):
        if hit is None:
            hits[place] = _first_hits(linked(error_model), pixels[place])
    return _as_arrays(scene, error_model, colors, hits)


@dataclass(frozen=True)
class _Colors:
    """The feasible colours of one pixel, and whether they were too many to tell apart."""

    boxes: list[Box]
    merged: bool


def _colors(evaluator: PixelEvaluator, pixel: tuple[int, int], *, may_merge: bool = True) -> _Colors | None:
    try:
        return _Colors(*evaluator.colors(*pixel, may_merge=may_merge))
    except UndecidableError:
        return None


def _first_hits(evaluator: PixelEvaluator, pixel: tuple[int, int]) -> list[FirstHit] | None:
    try:
        return evaluator.first_hits(*pixel)
    except UndecidableError:
        return None


def _brightest(colors: list[_Colors | None]) -> float:
    """The largest value of the image, as far as it is known."""
    known = [box for color in colors if color for box in color.boxes]
    return max((float(channel.mid()) for box in known for channel in box), default=0.0)


Bounds = list[tuple[float, float]]


def _as_arrays(
    scene: Scene, error_model: ErrorModel, colors: list[_Colors | None], hits: list[list[FirstHit] | None]
) -> FeasibleSet:
    size = (scene.camera.height, scene.camera.width)
    boxes = [[_bounds(box) for box in color.boxes] if color else [] for color in colors]
    low, high = error_model.output.interval_read(*_gathered(boxes, size, 3))
    hit_bounds = [[_bounds(hit.values or NO_VALUES) for hit in of_pixel or ()] for of_pixel in hits]
    hit_low, hit_high = FIRST_HIT_OUTPUT.interval_read(*_gathered(hit_bounds, size, HIT_VALUES))
    primitives = np.full((len(hits), hit_low.shape[2]), UNUSED)
    for place, of_pixel in enumerate(hits):
        primitives[place, : len(of_pixel or ())] = [hit.primitive for hit in of_pixel or ()]
    merged = np.array([color is not None and color.merged for color in colors])
    return FeasibleSet(low, high, merged.reshape(size), primitives.reshape(hit_low.shape[:3]), hit_low, hit_high)


def _bounds(balls: Iterable[Any]) -> Bounds:
    """The balls' ends, widened by float64's own rounding."""
    bounds = []
    for ball in balls:
        middle, radius = float(ball.mid()), float(ball.rad())
        widened = radius + (abs(middle) + radius) * 2.0**-52
        bounds.append((middle - widened, middle + widened))
    return bounds


def _gathered(
    of_pixels: list[list[Bounds]], size: tuple[int, int], values: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Arrays of low and high ends, of shape (height, width, most boxes of a pixel, values)."""
    most = max(1, *(len(boxes) for boxes in of_pixels))
    both = np.full((len(of_pixels), most, values, 2), np.nan)
    for place, boxes in enumerate(of_pixels):
        if boxes:
            both[place, : len(boxes)] = boxes
    both = both.reshape(*size, most, values, 2)
    return both[..., 0], both[..., 1]
