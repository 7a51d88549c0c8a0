"""The outcomes of many pixels at once in plain balls, compiled: as PixelEvaluator finds them with PlainRays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from flint import arb, ctx

from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES, FirstHit
from raytruth.comparisons.feasible_sets.pixel_program import State, pixel_program
from raytruth.comparisons.feasible_sets.run_time_names import FEATURES, LEAST_PRECISION_BITS
from raytruth.comparisons.feasible_sets.tree_memory import MOST_NODES, Limits, tree_memory
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.float_ball_conversions import from_arb, to_arb
from raytruth.reference_tracer.arithmetics.float_balls import Ball
from raytruth.reference_tracer.arithmetics.scripted_decisions import decisions_memory
from raytruth.reference_tracer.source.scene_data import SceneData
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from raytruth.comparisons.feasible_sets.feasible_pixel import PixelEvaluator
    from raytruth.comparisons.feasible_sets.pixel_program import PixelProgram
    from raytruth.comparisons.feasible_sets.rounded_rays import Box, PlainRays

MOST_PRECISION_BITS = 48
"""Beyond, what the floats lose themselves, 2^-53 an operation, is more than a 32nd of a roundoff."""
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

    def __init__(self, evaluator: PixelEvaluator, rays: PlainRays) -> None:
        prepared = rays.prepared
        made = pixel_program(rays.behaviour)
        self.rays = rays
        self.entries = made.entry_points
        self.data = SceneData(_balls_of(prepared.data.numbers), np.array(prepared.data.integers, dtype=np.int64))
        self.frame = tuple(tuple(map(from_arb, vector)) for vector in rays.frame)
        self.decisions, self.tree = decisions_memory(), tree_memory()
        self.kept_rays, self.remembered = np.zeros((MOST_NODES, 6, 2)), np.zeros((1, 2))
        constants, starts = _constants(made, rays)
        features = required_features(prepared.scene)
        self.shared = (
            2.0**-rays.precision_bits,
            constants,
            starts,
            np.array([name in features for name in FEATURES], dtype=np.int64),
        )
        self.evaluator = evaluator

    def colors(self, pixels: Sequence[tuple[int, int]], *, may_merge: bool) -> list[FoundColors]:
        """The feasible colours of each pixel, a column and a row."""
        boxes = np.zeros((len(pixels), MOST_OUTCOMES, 3, 2))
        told = np.zeros((len(pixels), 3), dtype=np.int64)
        self._call("color_pixels", pixels, may_merge, boxes, told)
        return [_colors_of(*both) for both in zip(told.tolist(), boxes, strict=True)]

    def first_hits(self, pixels: Sequence[tuple[int, int]]) -> list[list[FirstHit] | None]:
        """What each pixel's ray may meet first; empty where nothing can be said, None where there was no room."""
        primitives = np.zeros((len(pixels), MOST_OUTCOMES), dtype=np.int64)
        values = np.zeros((len(pixels), MOST_OUTCOMES, SEVEN, 2))
        told = np.zeros(len(pixels), dtype=np.int64)
        self._call("hit_pixels", pixels, False, primitives, values, told)
        return [_hits_of(*each) for each in zip(told.tolist(), primitives, values, strict=True)]

    def _call(self, name: str, pixels: Sequence[tuple[int, int]], may_merge: bool, *results: Any) -> None:
        state = State(*self.shared, self.decisions, self.tree, self._limits(may_merge), self.kept_rays, self.remembered)
        places = np.array(pixels, dtype=np.int64).reshape(len(pixels), 2)
        camera_rays = np.zeros((1, 6, 2))
        if self.rays.has_exact_camera:
            found = [self.rays.primary_ray(*pixel) for pixel in pixels]
            camera_rays = _balls_of([number for ray in found for vector in ray for number in vector])
            camera_rays = camera_rays.reshape(len(pixels), 6, 2)
        self.entries[name](state, self.data, self.frame, places, len(pixels), camera_rays, *results)

    def _limits(self, may_merge: bool) -> Limits:
        evaluator, bound = self.evaluator, self.evaluator.bound
        radius = -1.0 if self.rays.has_exact_camera else self.rays.image_radius
        if bound is None:
            return Limits(0, 0.0, 0.0, 0.0, 0.0, int(may_merge), evaluator.most_work, radius)
        radiance, growth = bound.radiance * evaluator.excess, bound.growth * evaluator.excess
        negligible, at_camera = evaluator.negligible_weight, bound.at_camera
        return Limits(1, negligible, radiance, growth, at_camera, int(may_merge), evaluator.most_work, radius)


def serves(precision_bits: int) -> bool:
    """Whether balls of two floats are as tight as Arb's in an arithmetic of this precision."""
    return LEAST_PRECISION_BITS <= precision_bits <= MOST_PRECISION_BITS


def _constants(made: PixelProgram, rays: PlainRays) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
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
        return _balls_of(numbers), np.array([*starts, 0], dtype=np.int64)


def _balls_of(numbers: Sequence[Any]) -> NDArray[np.float64]:
    """Float balls of Arb's, shape (n, 2); a row at least, so that there is an array."""
    with ctx.workprec(4 * 53):
        return np.array([from_arb(number) for number in numbers] or [Ball(0.0, 0.0)])


def _colors_of(told: list[int], boxes: NDArray[np.float64]) -> FoundColors:
    count, merged, spent = told
    if count < 0:
        return FoundColors(None, False, False)
    found = [_box(three) for three in boxes[:count].tolist()]
    return FoundColors(found, bool(merged), bool(spent))


def _hits_of(count: int, primitives: NDArray[np.int64], values: NDArray[np.float64]) -> list[FirstHit] | None:
    if count < 0:
        return None
    return [
        FirstHit(primitive, () if primitive < 0 else tuple(to_arb(Ball(*pair)) for pair in pairs))
        for primitive, pairs in zip(primitives[:count].tolist(), values[:count].tolist(), strict=True)
    ]


def _box(balls: list[list[float]]) -> Box:
    red, green, blue = (to_arb(Ball(*pair)) for pair in balls)
    return red, green, blue
