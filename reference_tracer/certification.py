"""The proven value of a pixel: the tracer in ball arithmetic, with as many bits as the pixel needs.

A comparison that the balls leave undecided takes no branch: the pixel is evaluated again with balls that are worked out
exactly where they tie (exact_arithmetic.py), and if that does not decide either, with twice the bits. What is undecided
with the most bits is an exact tie, for all that can be told: every way it can go is explored. If all agree, the tie has
no consequence and the pixel is certified all the same; else it is undecided, and says why.
"""

from __future__ import annotations

import functools
import math
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from raytruth.reference_tracer.arithmetics.balls import TooManyOutcomesError, ball_arithmetic, every_outcome
from raytruth.reference_tracer.arithmetics.exact_arithmetic import ExactArithmetic
from raytruth.reference_tracer.camera_rays import CENTRES
from raytruth.reference_tracer.rendering import prepare
from raytruth.reference_tracer.ties import (
    ONE_HAS_NO_BOUND,
    TOO_MANY,
    NotedDecisions,
    RaisingDecisions,
    UndecidedComparisonError,
    explanation,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.reference_tracer.arithmetics.balls import Decisions
    from raytruth.reference_tracer.arithmetics.kernel import Frame
    from raytruth.reference_tracer.camera_rays import CameraRays
    from raytruth.scenes.scene import Scene

# 64 bits cost as much as 128: the work is Python's, not the numbers'.
FEWEST_BITS = 128
# The limit that issue and documents state. It tells values apart that differ by 2^-4000 of their size.
MOST_BITS = 4096
# Six independent ties in the ray tree of one pixel.
MOST_OUTCOMES = 64
# For exact values: about a second for a pixel at most, in units of root_tower.py, and as much for all its outcomes.
MOST_WORK = 400_000
# Fixed, and not what others have left: ways that begin with the same answers must be asked the same questions.
MOST_WORK_OF_A_WAY = MOST_WORK // MOST_OUTCOMES
# Outcomes agree if they differ by no more than what rounding them to float64 does, once for each of two.
TWO_ROUNDINGS = 2.0**-52
TWO_ROUNDINGS_NEAR_ZERO = math.ulp(0.0)
"""As TWO_ROUNDINGS, of values too small for a relative error: each moves them by half of the least float at most."""
LARGEST_FLOAT = sys.float_info.max

Color = tuple[float, float, float]
"""Linear RGB."""


@dataclass(frozen=True)
class Enclosure:
    """The true colour lies between middle - radius and middle + radius in each channel."""

    middle: Color
    radius: Color


NOTHING_KNOWN = Enclosure((math.inf,) * 3, (math.inf,) * 3)
"""The middle says nothing; it is no NaN, so that it equals itself."""


@dataclass(frozen=True)
class Undecided:
    """Why a pixel has no proven value."""

    origin: Color
    """Of the primary ray."""
    direction: Color
    """Of the primary ray, a unit vector rounded to float64."""
    outcomes: tuple[Enclosure, ...]
    """Every value that the tie leaves open; empty if they cannot be told, for a reason that the explanation gives."""
    explanation: str
    """In words: which decisions are ties, and why there are no outcomes if there are none."""


@dataclass(frozen=True)
class CertifiedPixel(Enclosure):
    """A pixel's enclosure, rounding to float64 included.

    Undecided pixels have the least enclosure that holds all outcomes; NOTHING_KNOWN if there is none.
    """

    precision_bits: int
    undecided: Undecided | None = None


class Certifier:
    """Evaluates the pixels of one scene; keeps a kernel for each precision that was needed."""

    def __init__(self, scene: Scene, camera_rays: CameraRays = CENTRES) -> None:
        self.scene = scene
        self.camera_rays = camera_rays
        self._evaluators: dict[tuple[int, bool], _Evaluator] = {}

    def pixel(self, column: int, row: int, widest: float = math.inf) -> CertifiedPixel:
        """The colour of a pixel's ray; more bits are used while its radius is above `widest`."""
        bits, work_left = FEWEST_BITS, MOST_WORK
        while bits <= MOST_BITS:
            try:
                found = self._evaluator(bits).enclosure(column, row)
            except UndecidedComparisonError:
                found, work = self._worked_out(column, row, bits, work_left)
                work_left -= work
            if max(found.radius) <= min(widest, LARGEST_FLOAT):
                return CertifiedPixel(found.middle, found.radius, bits)
            bits *= 2
        return self._explored(column, row, widest)

    def frame(self) -> Frame:
        """What all rays of the camera share, in balls of the fewest bits."""
        return self._evaluator(FEWEST_BITS).frame

    def _evaluator(self, bits: int, *, exactly: bool = False) -> _Evaluator:
        if (bits, exactly) not in self._evaluators:
            self._evaluators[bits, exactly] = self._made(bits, RaisingDecisions(), exactly)
        return self._evaluators[bits, exactly]

    @functools.cached_property
    def _exploration(self) -> tuple[NotedDecisions, _Evaluator]:
        decisions = NotedDecisions()
        return decisions, self._made(MOST_BITS, decisions, exactly=True)

    def _made(self, bits: int, decisions: Decisions, exactly: bool) -> _Evaluator:
        return _Evaluator(self.scene, self.camera_rays, bits, decisions, exactly=exactly)

    def _worked_out(self, column: int, row: int, bits: int, most_work: int) -> tuple[Enclosure, int]:
        """The pixel with its ties decided by exact values, or NOTHING_KNOWN if they cannot be; and the work of that."""
        if most_work <= 0:
            return NOTHING_KNOWN, 0
        evaluator = self._evaluator(bits, exactly=True)
        try:
            return evaluator.enclosure(column, row, most_work), evaluator.work()
        except UndecidedComparisonError:
            return NOTHING_KNOWN, evaluator.work()

    def _explored(self, column: int, row: int, widest: float) -> CertifiedPixel:
        """The pixel by every way that its ties can go, but for those that exact values decide."""
        decisions, evaluator = self._exploration
        decisions.sentences.clear()
        outcomes, obstacle = _every_enclosure(evaluator, column, row, decisions)
        found = NOTHING_KNOWN if obstacle else _hull(outcomes)
        if decisions.sentences and agree(found, widest):
            return CertifiedPixel(found.middle, found.radius, MOST_BITS)  # ties without a consequence
        origin, direction = evaluator.primary_ray(column, row)
        undecided = Undecided(origin, direction, outcomes, explanation(decisions.sentences, obstacle))
        return CertifiedPixel(found.middle, found.radius, MOST_BITS, undecided)


def _every_enclosure(
    evaluator: _Evaluator, column: int, row: int, decisions: NotedDecisions
) -> tuple[tuple[Enclosure, ...], str]:
    """All outcomes of a pixel and an empty text, or none and what keeps them from being told."""
    outcomes: dict[Enclosure, None] = {}

    def follow() -> Enclosure:
        return evaluator.enclosure(column, row, MOST_WORK_OF_A_WAY)

    try:
        for outcome in every_outcome(follow, decisions, MOST_OUTCOMES):
            if outcome == NOTHING_KNOWN:
                return (), ONE_HAS_NO_BOUND
            outcomes[outcome] = None
    except TooManyOutcomesError:
        return (), TOO_MANY
    return tuple(outcomes), ""


def agree(hull: Enclosure, widest: float = math.inf) -> bool:
    """Whether outcomes with this hull differ by no more than what rounding them to float64 does, once for each of two.

    `widest` is that much of the image's largest value, where it is known; else the pixel's own largest value counts.
    """
    of_scale = widest if widest < math.inf else TWO_ROUNDINGS * min(max(hull.middle), LARGEST_FLOAT)
    return max(hull.radius) <= max(of_scale, TWO_ROUNDINGS_NEAR_ZERO)


class _Evaluator:
    """A scene's kernel at one precision, which is in force while it runs."""

    def __init__(
        self, scene: Scene, camera_rays: CameraRays, bits: int, decisions: Decisions, *, exactly: bool
    ) -> None:
        self.bits = bits
        with ctx.workprec(bits):
            self.exact = ExactArithmetic(decisions) if exactly else None
            arithmetic = self.exact.arithmetic if self.exact else ball_arithmetic(bits, decisions)
            self.prepared = prepare(scene, arithmetic, camera_rays.behaviour())
            self.frame = self.prepared.kernel.camera_frame(self.prepared.data)

    def enclosure(self, column: int, row: int, most_work: int = 0) -> Enclosure:
        """The colour of a pixel's ray; exact values may take that much work."""
        kernel, data = self.prepared.kernel, self.prepared.data
        with ctx.workprec(self.bits):
            if self.exact:  # each pixel has roots of its own, and the camera's among them
                self.exact.restart(most_work)
                self.frame = kernel.camera_frame(data)
            color = kernel.radiance_at(data, self.frame, *self._center(column, row))
            return enclosure_of([self._ball(channel) for channel in color])

    def work(self) -> int:
        """Of exact values, for the pixel that was evaluated last."""
        return self.exact.work() if self.exact else 0

    def primary_ray(self, column: int, row: int) -> tuple[Color, Color]:
        """Origin and unit direction, rounded to floats."""
        with ctx.workprec(self.bits):
            ray = self.prepared.kernel.primary_ray(self.frame, *self._center(column, row))
        (x, y, z), (dx, dy, dz) = ([float(self._ball(part).mid()) for part in vector] for vector in ray)
        return (x, y, z), (dx, dy, dz)

    def _center(self, column: int, row: int) -> tuple[Any, Any]:
        number = self.prepared.arithmetic.number
        return number(column + 0.5), number(row + 0.5)

    def _ball(self, number: Any) -> Any:
        return number.ball if self.exact else number


def enclosure_of(color: Sequence[Any]) -> Enclosure:
    """Floats that enclose three balls; NOTHING_KNOWN if there are none."""
    red, green, blue = (enclosing_floats(channel) for channel in color)
    found = Enclosure((red[0], green[0], blue[0]), (red[1], green[1], blue[1]))
    return found if max(found.radius) <= LARGEST_FLOAT else NOTHING_KNOWN


def enclosing_floats(ball: Any) -> tuple[float, float]:
    """Middle and radius of an interval that holds the ball; the radius is infinite if floats hold no such interval."""
    middle = float(ball.mid())
    if not (ball.is_finite() and math.isfinite(middle)):
        return middle, math.inf
    distance = abs(ball - arb(middle)).upper()
    radius = float(distance)
    return middle, radius if arb(radius) >= distance else math.nextafter(radius, math.inf)


def _hull(outcomes: Sequence[Enclosure]) -> Enclosure:
    """The least enclosure that holds all, but for roundings."""
    if len(outcomes) == 1:
        return outcomes[0]
    with ctx.workprec(FEWEST_BITS):
        return enclosure_of([_union(outcomes, channel) for channel in range(3)])


def _union(outcomes: Sequence[Enclosure], channel: int) -> Any:
    balls = (arb(outcome.middle[channel], outcome.radius[channel]) for outcome in outcomes)
    return functools.reduce(lambda a, b: a.union(b), balls)
