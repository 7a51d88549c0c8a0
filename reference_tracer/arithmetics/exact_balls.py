"""Balls that remember how they were made, so that an exact tie is seen to be one.

However many bits a ball has, it cannot tell zero from what is tiny. A ball that remembers can be worked out exactly
(exact_values.py) from the scene's own numbers on: by the four operations, square roots, and the tangent of half the
field of view. That takes time, so only what an undecided comparison needs is worked out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import fmpq

from raytruth.reference_tracer.arithmetics.exact_values import NOT_A_NUMBER, ExactValues
from raytruth.reference_tracer.arithmetics.root_tower import NotExactError, constant

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reference_tracer.arithmetics.exact_values import Value


class ExactBall:
    """A ball, and what the number in it was made from: a method of ExactValues, and its operands."""

    __slots__ = ("ball", "operands", "operation", "value")

    def __init__(self, ball: Any, operation: Callable[..., Value] | None = None, *operands: ExactBall) -> None:
        self.ball = ball
        self.operation = operation
        self.operands = operands
        self.value: Value | None = None
        """The exact number, once it is worked out."""

    def is_number(self) -> bool:
        """Whether the ball holds one number only, which is then a rational one."""
        return bool(self.ball.is_exact() and self.ball.is_finite())

    def __add__(self, other: ExactBall) -> ExactBall:
        return ExactBall(self.ball + other.ball, ExactValues.add, self, other)

    def __sub__(self, other: ExactBall) -> ExactBall:
        return ExactBall(self.ball - other.ball, ExactValues.subtract, self, other)

    def __mul__(self, other: ExactBall) -> ExactBall:
        return ExactBall(self.ball * other.ball, ExactValues.multiply, self, other)

    def __truediv__(self, other: ExactBall) -> ExactBall:
        return ExactBall(self.ball / other.ball, ExactValues.divide, self, other)

    def __neg__(self) -> ExactBall:
        return ExactBall(-self.ball, ExactValues.negate, self)

    def __abs__(self) -> ExactBall:
        return ExactBall(abs(self.ball), ExactValues.absolute, self)


def exact_value(ball: ExactBall, values: ExactValues) -> Value:
    """The number in a ball, remembered by it. Raises NotExactError if it cannot be told."""
    waiting = [ball]
    while waiting:  # no recursion: a ray tree may be deeper than Python's stack
        newest = waiting[-1]
        if newest.value is None and newest.is_number():  # the ball says all, whatever it was made from
            newest.value = constant(exact_number(newest))
        if newest.value is None:
            missing = [operand for operand in newest.operands if operand.value is None]
            if missing:
                waiting += missing
                continue
            newest.value = _worked_out(newest, values)
        waiting.pop()
    assert ball.value is not None
    return ball.value


def exact_sign(a: ExactBall, b: ExactBall, values: ExactValues) -> int | None:
    """The sign of a - b, or None if one of them is not a number. Raises NotExactError if it cannot be told."""
    difference = values.subtract(exact_value(a, values), exact_value(b, values))
    return None if difference is NOT_A_NUMBER else values.sign(difference)


def _worked_out(ball: ExactBall, values: ExactValues) -> Value:
    """A number whose operands are worked out."""
    if ball.operation is None:
        raise NotExactError
    return ball.operation(values, *(operand.value for operand in ball.operands))


def exact_number(ball: ExactBall) -> Any:
    """The only number in a ball, as a rational one."""
    mantissa, exponent = ball.ball.man_exp()
    return fmpq(mantissa) * fmpq(2) ** int(exponent)
