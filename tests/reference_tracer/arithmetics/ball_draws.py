"""Balls of floats of all sizes and kinds, points of them, and whether a ball of floats holds an exact value."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb
from hypothesis import settings
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, SMALLEST, Ball

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

# Sums and products of floats are exact with so many bits: the exponents of a product of three reach from -3222 to 3072.
EXACT_BITS = 6400
NUMBER_OF_BALLS = 1_000_000 if settings.default.max_examples > 1000 else 8_000
ROUNDOFFS = (0.0, 2.0**-11, 2.0**-24, 2.0**-51, 2.0**-53)

SPECIAL_MIDDLES = (0.0, 1.0, -3.0, 0.5, SMALLEST, -(2.0**-1022), LARGEST, -LARGEST, math.inf, -math.inf, math.nan)
SPECIAL_RADII = (0.0, SMALLEST, 2.0**-60, 1.0, LARGEST, math.inf)
SPECIAL_BALLS = [Ball(middle, radius) for middle in SPECIAL_MIDDLES for radius in SPECIAL_RADII]

BALLS = st.builds(Ball, st.floats(), st.floats(0.0))
"""For hypothesis: any middle and any radius."""


def drawn_balls(seed: int, count: int = NUMBER_OF_BALLS) -> Iterator[Ball]:
    """Half of them of moderate size, the others of any, denormals too; radii from none to twice the middle."""
    random = np.random.default_rng(seed)
    for start in range(0, count, 10_000):
        size = min(10_000, count - start)
        extent = np.where(random.random(size) < 0.5, 8.0, 1070.0)
        middles = random.uniform(1.0, 2.0, size) * 2.0 ** np.clip(random.uniform(-1, 1, size) * extent, -1070, 1022)
        middles *= random.choice([-1.0, 1.0], size)
        middles = np.where(random.random(size) < 0.05, np.round(middles), middles)
        relative = 2.0 ** random.uniform(-70.0, 1.0, size)
        radii = np.abs(middles) * np.where(random.random(size) < 0.15, 0.0, relative)
        yield from map(Ball, middles.tolist(), radii.tolist())


def drawn_roundoffs(seed: int, count: int = NUMBER_OF_BALLS) -> list[float]:
    chosen: list[float] = np.random.default_rng(seed).choice(ROUNDOFFS, count).tolist()
    return chosen


def points(ball: Ball, inner: float = 0.3) -> list[Any]:
    """Both ends, the middle and one more point, exactly; of an infinite radius some points."""
    if not abs(ball.middle) <= LARGEST:
        return [arb(ball.middle)]
    if ball.radius == 0.0:
        return [arb(ball.middle)]
    radius = ball.radius if ball.radius <= LARGEST else LARGEST
    return [arb(ball.middle) + arb(radius) * arb(part) for part in (-1.0, 1.0, 0.0, inner)]


def holds(ball: Ball, value: Any) -> bool:
    """Whether a ball holds a value; what has none, or is infinite, is held by what promises nothing finite."""
    if math.isnan(ball.middle) or (ball.radius == math.inf and value.is_finite()):
        return True
    if not abs(ball.middle) <= LARGEST:
        return bool(value == arb(ball.middle))
    if not value.is_finite():
        return ball.radius == math.inf
    return bool(abs(value - arb(ball.middle)) <= arb(ball.radius))


def factors(roundoff: float) -> Sequence[Any]:
    """What rounding may multiply a result by, at most and at least, and nothing."""
    return (arb(1),) if roundoff == 0.0 else (arb(1), arb(1) - arb(roundoff), arb(1) + arb(roundoff))
