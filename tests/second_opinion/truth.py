"""The certified truth at any point of an image, and what mpmath says about itself."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from flint import arb, ctx
from mpmath import mp

from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.tables import build_tables
from raytruth.reference_tracer.ties import RaisingDecisions, UndecidedComparisonError
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.reference_tracer.arithmetics.kernel import Kernel
    from raytruth.scenes.scene import Scene
    from tests.second_opinion.paper import Vector

    Overrides = Mapping[str, Callable[..., object]]

FEWEST_BITS, MOST_BITS = 128, 2048
# Half of the fewest bits: no fault of the source is as small. After 50 bounces the balls get there by more bits only.
WIDEST_BITS = -64
# 50 digits and more, so that mpmath's error is invisible beside the balls'.
DIGITS, MORE_DIGITS = 60, 80


def certified(scene: Scene, x: float, y: float, overrides: Overrides | None = None) -> list[Any]:
    """A narrow ball for each channel of the radiance at an image point, in pixels.

    Raises UndecidedComparisonError where MOST_BITS do not suffice.
    """
    bits = FEWEST_BITS
    while True:
        with ctx.workprec(bits):
            try:
                color = _radiance(scene, x, y, bits, overrides or {})
            except UndecidedComparisonError:
                if bits == MOST_BITS:
                    raise
            else:
                if bits == MOST_BITS or all(_is_narrow(channel) for channel in color):
                    return color
        bits *= 2


def _radiance(scene: Scene, x: float, y: float, bits: int, overrides: Overrides) -> list[Any]:
    features = required_features(scene)
    arithmetic, kernel = _kernel(features, bits, tuple(overrides.items()))
    data = build_tables(scene, features, arithmetic)
    return list(kernel.radiance_at(data, kernel.camera_frame(data), arb(x), arb(y)))


@cache
def _kernel(
    features: frozenset[str], bits: int, overrides: tuple[tuple[str, Callable[..., object]], ...]
) -> tuple[Arithmetic, Kernel]:
    arithmetic = ball_arithmetic(bits, RaisingDecisions())
    return arithmetic, make_kernel(arithmetic, features, Behaviour(dict(overrides)))


def _is_narrow(ball: Any) -> bool:
    return bool(ball.rad() <= arb(2) ** WIDEST_BITS * (1 + abs(ball)))


def with_own_error(evaluate: Callable[[], Vector]) -> list[Any]:
    """What mpmath computes, as balls: the radius is by how much it changes when it computes with fewer digits."""
    with mp.workdps(DIGITS):
        coarse = evaluate()
    with mp.workdps(MORE_DIGITS), ctx.workdps(MORE_DIGITS):
        fine = evaluate()
        return [arb(value, abs(arb(value) - arb(other))) for value, other in zip(fine, coarse, strict=True)]


def agree(truth: list[Any], opinion: list[Any]) -> bool:
    """Whether the balls of every channel have a value in common."""
    with ctx.workdps(MORE_DIGITS):
        return all(ball.is_finite() and ball.overlaps(other) for ball, other in zip(truth, opinion, strict=True))
