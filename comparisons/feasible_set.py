"""The feasible set of a pixel: every value that a renderer with a given error model may give it.

The tracer's own source is evaluated in balls of the renderer's precision, with the renderer's ray offsets, along every
way that an undecided comparison can go. So the tolerance follows from the arithmetic and from the pixel's conditioning.
"""

from __future__ import annotations

import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb

from reference_tracer.balls import Decisions, TooManyOutcomesError, ball_arithmetic, every_outcome
from reference_tracer.rendering import PreparedScene, prepare
from reference_tracer.traversal import NOTHING

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from comparisons.error_model import ErrorModel
    from scenes.scene import Scene

# A pixel where more things than this can happen is not judged, but counted and shown. Sixty-four allows six
# independent undecided comparisons.
MOST_OUTCOMES = 64
ROWS_IN_A_TASK = 4


@dataclass(frozen=True)
class FeasibleSet:
    """Boxes of feasible colours: one an outcome, at most K a pixel.

    `low` and `high` have shape (height, width, K, 3), NaN where a pixel has fewer outcomes; `unjudged` (height, width)
    marks pixels with too many.
    """

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    unjudged: NDArray[np.bool_]

    @property
    def outcomes(self) -> NDArray[np.int64]:
        """How many outcomes each pixel has; shape (height, width)."""
        return np.isfinite(self.low[..., 0]).sum(axis=2)


def feasible_set(
    scene: Scene,
    error_model: ErrorModel,
    overrides: Mapping[str, Callable[..., object]] | None = None,
    jobs: int | None = None,
) -> FeasibleSet:
    """The feasible set of all pixels of a scene, computed in `jobs` processes (default: one a core)."""
    height = scene.camera.height
    jobs = jobs or os.cpu_count() or 1
    bands = [(first, min(first + ROWS_IN_A_TASK, height)) for first in range(0, height, ROWS_IN_A_TASK)]
    arguments = (scene, error_model, dict(overrides or {}))
    if jobs == 1:
        _start(*arguments)
        rows = [row for band in bands for row in _band(band)]
    else:
        # A fresh interpreter: threads of a forked one may hold locks for ever.
        with ProcessPoolExecutor(jobs, get_context("spawn"), _start, arguments) as pool:
            rows = [row for band in pool.map(_band, bands) for row in band]
    return _gather(rows)


_worker: Any = None
"""What a worker process prepares once for all its bands."""


def _start(scene: Scene, error_model: ErrorModel, overrides: Mapping[str, Callable[..., object]]) -> None:
    global _worker  # noqa: PLW0603 - a worker process has one scene
    decisions = Decisions()
    arithmetic = ball_arithmetic(error_model.precision_bits, decisions, _offsets(error_model))
    _worker = prepare(scene, arithmetic, overrides), decisions, error_model


def _band(band: tuple[int, int]) -> list[list[list[tuple[tuple[float, float], ...]] | None]]:
    prepared, decisions, error_model = _worker
    width = prepared.scene.camera.width
    return [
        [_outcomes(prepared, decisions, error_model, column, row) for column in range(width)]
        for row in range(band[0], band[1])
    ]


def _outcomes(
    prepared: PreparedScene, decisions: Decisions, error_model: ErrorModel, column: int, row: int
) -> list[tuple[tuple[float, float], ...]] | None:
    """The boxes of one pixel, or None if there are too many."""
    boxes = []
    try:
        for color in every_outcome(lambda: prepared.radiance_at(column + 0.5, row + 0.5), decisions, MOST_OUTCOMES):
            if not all(channel.is_finite() for channel in color):
                return None
            boxes.append(tuple(_bounds(channel, error_model.output_bits) for channel in color))
    except TooManyOutcomesError:
        return None
    return boxes


def _bounds(ball: Any, output_bits: int) -> tuple[float, float]:
    """The ball's ends, widened by the rounding of the output and by one float64 rounding of their own."""
    middle, radius = float(ball.mid()), float(ball.rad())
    widened = radius + abs(middle) * (2.0**-output_bits + 2.0**-52)
    return middle - widened, middle + widened


def _offsets(error_model: ErrorModel) -> dict[str, Callable[..., Any]]:
    """The renderer's way of leaving a surface, in place of the ideal one."""
    replaced: dict[str, Callable[..., Any]] = {}
    if error_model.ray_offset > 0.0:

        def departure(_primitive: int, point: Any, normal: Any) -> tuple[Any, int]:
            largest = abs(point[0]).max(abs(point[1])).max(abs(point[2]))
            offset = (largest + 1) * error_model.ray_offset
            moved = tuple(p + n * offset for p, n in zip(point, normal, strict=True))
            return moved, NOTHING

        replaced["departure"] = departure
    if error_model.shadow_shortening > 0.0:
        replaced["shadow_ray_end"] = lambda: arb(1 - error_model.shadow_shortening)
    return replaced


def _gather(rows: list[list[list[tuple[tuple[float, float], ...]] | None]]) -> FeasibleSet:
    most = max(len(boxes) if boxes else 1 for row in rows for boxes in row)
    shape = (len(rows), len(rows[0]), most, 3)
    low, high = np.full(shape, np.nan), np.full(shape, np.nan)
    unjudged = np.zeros(shape[:2], dtype=np.bool_)
    for y, row in enumerate(rows):
        for x, boxes in enumerate(row):
            if boxes is None:
                unjudged[y, x] = True
                continue
            bounds = np.array(boxes)
            low[y, x, : len(boxes)] = bounds[..., 0]
            high[y, x, : len(boxes)] = bounds[..., 1]
    return FeasibleSet(low, high, unjudged)
