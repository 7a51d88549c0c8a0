"""The arithmetic of linked numbers on a tape, to be compiled: the source's operations, and decided comparisons."""

from __future__ import annotations

from typing import Any

from flint import ctx

from raytruth.reference_tracer.arithmetics import linked_tape_operations as operations
from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
from raytruth.reference_tracer.arithmetics.balls import MARGIN_BITS
from raytruth.reference_tracer.arithmetics.float_ball_conversions import from_arb, stored
from raytruth.reference_tracer.arithmetics.float_balls import Ball
from raytruth.reference_tracer.arithmetics.linked_tape import LinkedNumber, number_of_ball
from raytruth.reference_tracer.arithmetics.scripted_decisions import decided, next_answer


class TapeConstants:
    """The constants of a tape, as they are asked for: a kernel's literals and a scene's numbers, each one its own."""

    def __init__(self, precision_bits: int) -> None:
        self.precision_bits = precision_bits
        self.balls: list[Ball] = []

    def stored(self, value: float) -> LinkedNumber:
        """A number as a renderer stores it."""
        return self._new(stored(value, self.precision_bits))

    def of_arb(self, ball: Any) -> LinkedNumber:
        """A number of which Arb's ball is known."""
        return self._new(from_arb(ball))

    def _new(self, ball: Ball) -> LinkedNumber:
        self.balls.append(ball)
        return LinkedNumber(len(self.balls) - 1)


def linked_tape_arithmetic(constants: TapeConstants) -> Arithmetic:
    """Linked numbers of a renderer whose operations err by 2^-bits at most, relatively, for the bits of the constants.

    A program in this arithmetic has a state with a tape of these constants, the roundoff, and decisions. π and infinity
    are to be among the constants.
    """
    bits = constants.precision_bits
    return Arithmetic(
        "linked numbers on a tape",
        constants.stored,
        {
            "certainly_less": operations.certainly_less,
            "certainly_zero": operations.certainly_zero,
            "exp": operations.linked_exponential,
            "float": number_of_integer,
            "floor": decided_floor,
            "max": operations.linked_maximum,
            "min": operations.linked_minimum,
            "sqrt": operations.linked_root,
            "tan": operations.linked_tangent,
        },
        compiled=True,
        decided_comparisons=True,
        in_force=lambda: ctx.workprec(bits + MARGIN_BITS),
        operations={
            "abs": operations.linked_size,
            "add": operations.linked_sum,
            "eq": is_equal,
            "le": is_less_or_equal,
            "lt": is_less,
            "mul": operations.linked_product,
            "neg": operations.linked_negative,
            "pow": operations.linked_power,
            "sub": operations.linked_difference,
            "truediv": operations.linked_quotient,
        },
    )


def number_of_integer(value: int) -> LinkedNumber:
    """The number itself: whole numbers in kernels count pixels, and are floats."""
    return number_of_ball(Ball(float(value), 0.0))


def is_less(a: LinkedNumber, b: LinkedNumber) -> bool:
    """Whether a < b."""
    return decided(operations.linked_less(a, b))


def is_less_or_equal(a: LinkedNumber, b: LinkedNumber) -> bool:
    """Whether a ≤ b."""
    return decided(operations.linked_less_or_equal(a, b))


def is_equal(a: LinkedNumber, b: LinkedNumber) -> bool:
    """Whether a = b."""
    return decided(operations.linked_equal(a, b))


def decided_floor(a: LinkedNumber) -> int:
    """The whole number below a; where that is undecided, one of two in a row."""
    below = operations.linked_floor(a)
    if below.is_one:
        return below.lowest
    return below.lowest + 1 if next_answer() else below.lowest
