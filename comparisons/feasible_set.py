"""The feasible sets of an image: what a renderer with a given error model may give each pixel.

The tracer's own source is evaluated in balls of the renderer's precision, with the renderer's ray offsets, along every
way that an undecided comparison can go. So the tolerance follows from the arithmetic and from the pixel's conditioning.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from comparisons.feasible_pixel import FirstHit, PixelEvaluator, UndecidableError
from comparisons.output_model import OutputModel
from comparisons.radiance_bound import radiance_bound
from comparisons.ray_offsets import offset_overrides
from reference_tracer.balls import Decisions, ball_arithmetic
from reference_tracer.rendering import prepare

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from numpy.typing import NDArray

    from comparisons.error_model import ErrorModel
    from scenes.scene import Scene


@dataclass(frozen=True)
class FeasibleSet:
    """Boxes of feasible colours, one an outcome, at most K a pixel, and of feasible first hits, at most L a pixel.

    Unused places hold NaN. A pixel of which nothing can be said has no outcome at all, and is not judged.
    """

    low: NDArray[np.float64]
    """Shape (height, width, K, 3)."""
    high: NDArray[np.float64]
    hit_primitives: NDArray[np.int64]
    """Shape (height, width, L); -1: nothing is hit; -2: unused place."""
    hit_low: NDArray[np.float64]
    """Shape (height, width, L, 7): distance, position, normal."""
    hit_high: NDArray[np.float64]

    @property
    def outcomes(self) -> NDArray[np.int64]:
        """How many outcomes each pixel has, 0 where it cannot be judged; shape (height, width)."""
        counts: NDArray[np.int64] = np.isfinite(self.low[..., 0]).sum(axis=2)
        return counts

    def hull(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The least box that holds all outcomes of each pixel; NaN where there are none; shape (height, width, 3)."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # of pixels without outcomes
            return np.nanmin(self.low, axis=2), np.nanmax(self.high, axis=2)


UNUSED = -2
HIT_VALUES = 7
FLOAT32_BITS = 24
FIRST_HIT_OUTPUT = OutputModel("float32")
"""What renderers tell of first hits, they tell in float32 at least."""


def feasible_set(
    scene: Scene, error_model: ErrorModel, overrides: Mapping[str, Callable[..., object]] | None = None
) -> FeasibleSet:
    """The feasible sets of all pixels of a scene; `overrides` replace functions of the tracer's source."""
    decisions = Decisions()
    arithmetic = ball_arithmetic(error_model.precision_bits, decisions, offset_overrides(error_model, decisions))
    evaluator = PixelEvaluator(prepare(scene, arithmetic, overrides), decisions, radiance_bound(scene), FLOAT32_BITS)
    pixels = [(column, line) for line in range(scene.camera.height) for column in range(scene.camera.width)]
    colors = [_color_bounds(evaluator, pixel) for pixel in pixels]
    hits = [_hit_bounds(evaluator, pixel) for pixel in pixels]
    size = (scene.camera.height, scene.camera.width)
    low, high = error_model.output.interval_read(*_gathered(colors, size, 3))
    hit_bounds = _gathered([[bounds for _, bounds in of_pixel] for of_pixel in hits], size, HIT_VALUES)
    hit_low, hit_high = FIRST_HIT_OUTPUT.interval_read(*hit_bounds)
    primitives = np.full(hit_low.shape[:3], UNUSED)
    for (column, line), of_pixel in zip(pixels, hits, strict=True):
        primitives[line, column, : len(of_pixel)] = [primitive for primitive, _ in of_pixel]
    return FeasibleSet(low, high, primitives, hit_low, hit_high)


Bounds = list[tuple[float, float]]


def _color_bounds(evaluator: PixelEvaluator, pixel: tuple[int, int]) -> list[Bounds]:
    try:
        return [_bounds(box) for box in evaluator.colors(*pixel)]
    except UndecidableError:
        return []


def _hit_bounds(evaluator: PixelEvaluator, pixel: tuple[int, int]) -> list[tuple[int, Bounds]]:
    try:
        hits = evaluator.first_hits(*pixel)
    except UndecidableError:
        return []
    if not all(value.is_finite() for hit in hits for value in hit.values):
        return []  # a triangle seen edge on may be met anywhere
    return [(hit.primitive, _hit_values(hit)) for hit in hits]


def _hit_values(hit: FirstHit) -> Bounds:
    return _bounds(hit.values) if hit.values else [(np.nan, np.nan)] * HIT_VALUES


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
