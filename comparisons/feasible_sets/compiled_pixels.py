"""The outcomes of many pixels at once in plain balls, compiled: as PixelEvaluator finds them with PlainRays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from flint import arb, ctx

from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES, FirstHit
from raytruth.comparisons.feasible_sets.pixel_program import State, pixel_program
from raytruth.comparisons.feasible_sets.run_time_names import FEATURES
from raytruth.comparisons.feasible_sets.tree_memory import MOST_NODES, Limits, tree_memory
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.scripted_decisions import decisions_memory
from raytruth.reference_tracer.source.scene_data import SceneData
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from raytruth.comparisons.feasible_sets.feasible_pixel import PixelEvaluator
    from raytruth.comparisons.feasible_sets.pixel_program import PixelProgram
    from raytruth.comparisons.feasible_sets.rounded_rays import Box, Pixel, PlainRays
    from raytruth.comparisons.feasible_sets.set_arithmetics import SetArithmetic

# Of pixels: what is found of them takes some ten megabytes, and Python hears of an interruption in between.
BATCH = 2**10
SEVEN = 7
"""Numbers of a first hit: distance, position, normal."""


class FoundColors(NamedTuple):
    """What a pixel's colours may be: no boxes where nothing can be said, None where the evaluator had no room."""

    boxes: list[Box] | None
    merged: bool
    spent: bool


class CompiledPixels:
    """Evaluates the pixels of one scene under one error model, as the evaluator does that is given.

    Raises NotCompilableError for a behaviour that the compiler does not know.
    """

    def __init__(self, evaluator: PixelEvaluator, rays: PlainRays, balls: SetArithmetic) -> None:
        prepared, parts = rays.prepared, balls.parts
        made = pixel_program(rays.behaviour, balls)
        self.rays, self.balls = rays, balls
        self.entries = made.entry_points
        self.data = SceneData(_balls_of(prepared.data.numbers, balls), np.array(prepared.data.integers, dtype=np.int64))
        self.frame = tuple(tuple(map(balls.of_arb, vector)) for vector in rays.frame)
        self.decisions, self.tree = decisions_memory(), tree_memory(parts)
        self.kept_rays, self.remembered = np.zeros((MOST_NODES, 6, parts)), np.zeros((1, parts))
        constants, starts = _constants(made, rays, balls)
        features = required_features(prepared.scene)
        self.shared = (
            2.0**-rays.precision_bits,
            constants,
            starts,
            np.array([name in features for name in FEATURES], dtype=np.int64),
        )
        self.evaluator = evaluator

    def colors(self, pixels: Sequence[Pixel], *, may_merge: bool) -> list[FoundColors]:
        """The feasible colours of each pixel, a column and a row."""
        found: list[FoundColors] = []
        for batch in _batches(pixels):
            boxes = np.zeros((len(batch), MOST_OUTCOMES, 3, self.balls.parts))
            told = np.zeros((len(batch), 3), dtype=np.int64)
            self._call("color_pixels", batch, may_merge, boxes, told)
            found.extend(self._colors_of(*both) for both in zip(told.tolist(), boxes, strict=True))
        return found

    def first_hits(self, pixels: Sequence[Pixel]) -> list[list[FirstHit] | None]:
        """What each pixel's ray may meet first; empty where nothing can be said, None where there was no room."""
        found: list[list[FirstHit] | None] = []
        for batch in _batches(pixels):
            primitives = np.zeros((len(batch), MOST_OUTCOMES), dtype=np.int64)
            values = np.zeros((len(batch), MOST_OUTCOMES, SEVEN, self.balls.parts))
            told = np.zeros(len(batch), dtype=np.int64)
            self._call("hit_pixels", batch, True, primitives, values, told)
            found.extend(self._hits_of(*each) for each in zip(told.tolist(), primitives, values, strict=True))
        return found

    def _call(self, name: str, pixels: Sequence[Pixel], may_merge: bool, *results: Any) -> None:
        state = State(*self.shared, self.decisions, self.tree, self._limits(may_merge), self.kept_rays, self.remembered)
        places = np.array(pixels, dtype=np.int64).reshape(len(pixels), 2)
        camera_rays = np.zeros((1, 6, self.balls.parts))
        if self.rays.has_exact_camera:
            with self.rays.prepared.arithmetic.in_force():
                found = [self.rays.primary_ray(*pixel) for pixel in pixels]
            camera_rays = _balls_of([number for ray in found for vector in ray for number in vector], self.balls)
            camera_rays = camera_rays.reshape(len(pixels), 6, self.balls.parts)
        self.entries[name](state, self.data, self.frame, places, len(pixels), camera_rays, *results)

    def _limits(self, may_merge: bool) -> Limits:
        evaluator, bound = self.evaluator, self.evaluator.bound
        radius = -1.0 if self.rays.has_exact_camera else self.rays.image_radius
        if bound is None:
            return Limits(0, 0.0, 0.0, 0.0, 0.0, int(may_merge), evaluator.most_work, radius)
        radiance, growth = bound.radiance * evaluator.excess, bound.growth * evaluator.excess
        negligible, at_camera = evaluator.negligible_weight, bound.at_camera
        return Limits(1, negligible, radiance, growth, at_camera, int(may_merge), evaluator.most_work, radius)

    def _colors_of(self, told: list[int], boxes: NDArray[np.float64]) -> FoundColors:
        count, merged, spent = told
        if count < 0:
            return FoundColors(None, merged=False, spent=False)
        found = [self._in_arb(three) for three in boxes[:count].tolist()]
        return FoundColors([(red, green, blue) for red, green, blue in found], bool(merged), bool(spent))

    def _hits_of(self, count: int, primitives: NDArray[np.int64], values: NDArray[np.float64]) -> list[FirstHit] | None:
        if count < 0:
            return None
        return [
            FirstHit(primitive, () if primitive == NOTHING else tuple(self._in_arb(seven)))
            for primitive, seven in zip(primitives[:count].tolist(), values[:count].tolist(), strict=True)
        ]

    def _in_arb(self, numbers: list[list[float]]) -> list[Any]:
        with ctx.workprec(4 * 53):  # more than two floats have
            return [self.balls.to_arb(parts) for parts in numbers]


def _batches(pixels: Sequence[Pixel]) -> Iterator[Sequence[Pixel]]:
    return (pixels[first : first + BATCH] for first in range(0, len(pixels), BATCH))


def _constants(
    made: PixelProgram, rays: PlainRays, balls: SetArithmetic
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The numbers of the program's state, the lists of numbers behind them, and where these begin."""
    of_behaviour, bits = rays.behaviour.constants, rays.precision_bits
    with rays.prepared.arithmetic.in_force():
        literals = {name: stored_number(value, bits) for name, value in made.literals.items()}
        known = {**of_behaviour, **literals, "pi": arb.pi() * arb(1, arb(2) ** -bits)}
        numbers = [known[name] for name in made.numbers]
        starts = []
        for name in made.lists:
            starts.append(len(numbers))
            numbers.extend(of_behaviour[name])
        return _balls_of(numbers, balls), np.array([*starts, 0], dtype=np.int64)


def _balls_of(numbers: Sequence[Any], balls: SetArithmetic) -> NDArray[np.float64]:
    """Balls of Arb's, a row of floats each; a row at least, so that there is an array."""
    with ctx.workprec(4 * 53):
        return np.array([balls.of_arb(number) for number in numbers] or [balls.arithmetic.number(0.0)])
