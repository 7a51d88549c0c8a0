"""The arithmetics that the evaluator is compiled for, and which of them serves an error model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.comparisons.feasible_sets import box_double_doubles
from raytruth.comparisons.feasible_sets.run_time_names import LEAST_PRECISION_BITS
from raytruth.reference_tracer.arithmetics.compilation import number_type
from raytruth.reference_tracer.arithmetics.float_ball_conversions import from_arb, to_arb
from raytruth.reference_tracer.arithmetics.float_balls import Ball
from raytruth.reference_tracer.arithmetics.rounded_double_doubles import ROUNDED_DOUBLE_DOUBLES
from raytruth.reference_tracer.arithmetics.rounded_float_balls import ROUNDED_FLOAT_BALLS
from raytruth.reference_tracer.arithmetics.truth_arithmetic import double_double_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.reference_tracer.compiler.types import Type

# What floats lose themselves, 2^-53 an operation, is then a 32nd of a roundoff at most.
MOST_FLOAT_BITS = 48
# The same of double-double balls, whose radii have a float's precision: so this is only where floats' own formats end.
MOST_BITS = 53


@dataclass(frozen=True, eq=False)
class SetArithmetic:
    """A kind of balls, each a number of floats."""

    arithmetic: Arithmetic
    of_arb: Callable[[Any], tuple[float, ...]]
    to_arb: Callable[[list[float]], Any]
    """A ball of Arb's that holds all of the ball with these parts."""
    names: Mapping[str, Any]
    """Functions of box_balls.py, for these balls."""

    @property
    def ball(self) -> Type:
        """The type of a ball."""
        return number_type(self.arithmetic)

    @property
    def parts(self) -> int:
        """Of how many floats a ball is."""
        return len(self.arithmetic.number(0.0))


def _of_float_ball(parts: list[float]) -> Any:
    return to_arb(Ball(*parts))


def _of_double_double(parts: list[float]) -> Any:
    high, low, radius = parts
    return to_arb(Ball(high, radius)) + arb(low)


FLOATS = SetArithmetic(ROUNDED_FLOAT_BALLS, from_arb, _of_float_ball, {})
DOUBLE_DOUBLES = SetArithmetic(
    ROUNDED_DOUBLE_DOUBLES,
    double_double_of,
    _of_double_double,
    {
        function.__name__: function
        for function in (
            box_double_doubles.ball_common,
            box_double_doubles.ball_hull,
            box_double_doubles.ball_sum,
            box_double_doubles.exact_ball,
            box_double_doubles.from_black,
            box_double_doubles.is_finite,
            box_double_doubles.is_under,
            box_double_doubles.pixel_center,
            box_double_doubles.upper_end,
        )
    },
)


def set_arithmetic(precision_bits: int) -> SetArithmetic | None:
    """The quickest in which sets are as tight as in Arb's balls; None where Arb alone serves."""
    if LEAST_PRECISION_BITS <= precision_bits <= MOST_FLOAT_BITS:
        return FLOATS
    return DOUBLE_DOUBLES if MOST_FLOAT_BITS < precision_bits <= MOST_BITS else None
