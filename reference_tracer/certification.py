"""The proven value of a pixel: the tracer in ball arithmetic, with as many bits as the pixel needs.

A comparison that the balls leave undecided takes no branch: the pixel is evaluated again with twice the bits. What the
most bits leave undecided is an exact tie, for all that can be told: every way it can go is explored. If all agree, the
tie has no consequence and the pixel is certified all the same; else it is undecided, and says why.
"""

from __future__ import annotations

import functools
import math
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from raytruth.reference_tracer.arithmetics.balls import TooManyOutcomesError, ball_arithmetic, every_outcome
from raytruth.reference_tracer.rendering import prepare
from raytruth.reference_tracer.ties import NotedDecisions, RaisingDecisions, UndecidedComparisonError, explanation

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.reference_tracer.arithmetics.balls import Decisions
    from raytruth.scenes.scene import Scene

# 64 bits cost as much as 128: the work is Python's, not the numbers'.
FEWEST_BITS = 128
# The limit that issue and documents state. It tells values apart that differ by 2^-4000 of their size.
MOST_BITS = 4096
# Six independent ties in the ray tree of one pixel.
MOST_OUTCOMES = 64
# Outcomes agree if they differ by no more than what rounding them to float64 does, once for each of two.
TWO_ROUNDINGS = 2.0**-52
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
    """Every value that the tie leaves open; empty if there are too many or if one of them has no bound."""
    explanation: str
    """In words: which decisions are ties."""


@dataclass(frozen=True)
class CertifiedPixel(Enclosure):
    """A pixel's enclosure, rounding to float64 included.

    Undecided pixels have the least enclosure that holds all outcomes; NOTHING_KNOWN if there is none.
    """

    precision_bits: int
    undecided: Undecided | None = None


class Certifier:
    """Evaluates the pixels of one scene; keeps a kernel for each precision that was needed."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._evaluators: dict[int, _Evaluator] = {}

    def pixel(self, column: int, row: int, widest: float = math.inf) -> CertifiedPixel:
        """The colour through the centre of a pixel; more bits are used while its radius is above `widest`."""
        bits = FEWEST_BITS
        while bits <= MOST_BITS:
            if bits not in self._evaluators:
                self._evaluators[bits] = _Evaluator(self.scene, bits, RaisingDecisions())
            try:
                found = self._evaluators[bits].enclosure(column, row)
            except UndecidedComparisonError:
                found = NOTHING_KNOWN
            if max(found.radius) <= min(widest, LARGEST_FLOAT):
                return CertifiedPixel(found.middle, found.radius, bits)
            bits *= 2
        return self._explored(column, row)

    def _explored(self, column: int, row: int) -> CertifiedPixel:
        """The pixel by every way that its ties can go."""
        decisions = NotedDecisions()
        evaluator = _Evaluator(self.scene, MOST_BITS, decisions)
        try:
            ways = every_outcome(lambda: evaluator.enclosure(column, row), decisions, MOST_OUTCOMES)
            outcomes = tuple(dict.fromkeys(ways))
        except TooManyOutcomesError:
            outcomes = (NOTHING_KNOWN,)
        found = _hull(outcomes)
        if decisions.sentences and max(found.radius) <= TWO_ROUNDINGS * min(max(found.middle), LARGEST_FLOAT):
            return CertifiedPixel(found.middle, found.radius, MOST_BITS)  # ties without a consequence
        origin, direction = evaluator.primary_ray(column, row)
        known = outcomes if found != NOTHING_KNOWN else ()
        undecided = Undecided(origin, direction, known, explanation(decisions.sentences))
        return CertifiedPixel(found.middle, found.radius, MOST_BITS, undecided)


class _Evaluator:
    """A scene's kernel at one precision, which is in force while it runs."""

    def __init__(self, scene: Scene, bits: int, decisions: Decisions) -> None:
        self.arithmetic = ball_arithmetic(bits, decisions)
        self.prepared = prepare(scene, self.arithmetic)
        with self.arithmetic.in_force():
            self.frame = self.prepared.kernel.camera_frame(self.prepared.data)

    def enclosure(self, column: int, row: int) -> Enclosure:
        """The colour through the centre of a pixel."""
        with self.arithmetic.in_force():
            center = (arb(column + 0.5), arb(row + 0.5))
            color = self.prepared.kernel.radiance_at(self.prepared.data, self.frame, *center)
            return enclosure_of(color)

    def primary_ray(self, column: int, row: int) -> tuple[Color, Color]:
        """Origin and unit direction, rounded to floats."""
        with self.arithmetic.in_force():
            ray = self.prepared.kernel.primary_ray(self.frame, arb(column + 0.5), arb(row + 0.5))
        (x, y, z), (dx, dy, dz) = ([float(part.mid()) for part in vector] for vector in ray)
        return (x, y, z), (dx, dy, dz)


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
    """The least enclosure that holds all, but for roundings; NOTHING_KNOWN if one of them is."""
    if NOTHING_KNOWN in outcomes:
        return NOTHING_KNOWN
    if len(outcomes) == 1:
        return outcomes[0]
    with ctx.workprec(FEWEST_BITS):
        return enclosure_of([_union(outcomes, channel) for channel in range(3)])


def _union(outcomes: Sequence[Enclosure], channel: int) -> Any:
    balls = (arb(outcome.middle[channel], outcome.radius[channel]) for outcome in outcomes)
    return functools.reduce(lambda a, b: a.union(b), balls)
