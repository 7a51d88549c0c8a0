"""The arithmetic of balls that are worked out exactly where they leave a comparison undecided (exact_balls.py)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from flint import arb, fmpq

from raytruth.reference_tracer.arithmetics import balls
from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
from raytruth.reference_tracer.arithmetics.exact_balls import ExactBall, exact_number, exact_sign
from raytruth.reference_tracer.arithmetics.exact_values import ExactValues
from raytruth.reference_tracer.arithmetics.root_tower import NotExactError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from raytruth.reference_tracer.arithmetics.balls import Decisions

TANGENTS = {
    fmpq(1, 12): (2, -1, 3, 1),
    fmpq(1, 8): (-1, 1, 2, 1),
    fmpq(1, 6): (0, 1, 3, 3),
    fmpq(1, 4): (1, 0, 1, 1),
    fmpq(1, 3): (0, 1, 3, 1),
    fmpq(3, 8): (1, 1, 2, 1),
    fmpq(5, 12): (2, 1, 3, 1),
}
"""tan(q·π) = (a + b·√n)/m as q: (a, b, n, m), for angles up to a right one whose tangent takes one root at most."""


class ExactArithmetic:
    """Functions of the tracer's source over exact balls, at the precision that is in force when they are called.

    A comparison that neither balls nor exact values decide asks `decisions`, as in balls.py.
    """

    def __init__(self, decisions: Decisions) -> None:
        self.decisions = decisions
        self.values = ExactValues(0)
        self.pi = ExactBall(arb.pi())
        zero = ExactBall(arb(0))
        functions: Mapping[str, Any] = {
            "is_less": self.is_less,
            "is_less_or_equal": self.is_less_or_equal,
            "is_greater": lambda a, b: self.is_less(b, a),
            "is_greater_or_equal": lambda a, b: self.is_less_or_equal(b, a),
            "is_equal": self.is_equal,
            "is_different": lambda a, b: not self.is_equal(a, b),
            "certainly_less": lambda a, b: a.ball < b.ball,
            "certainly_zero": lambda a: a.ball == 0,
            "exp": lambda x: ExactBall(x.ball.exp()),
            "floor": self.floor,
            "inf": ExactBall(arb(math.inf)),
            "max": _larger,
            "min": _smaller,
            "pi": self.pi,
            "power": lambda a, b: ExactBall(balls.power(a.ball, b.ball)),
            "sqrt": lambda x: zero if self.is_zero(x) else _square_root(x),
            "tan": self.tangent,
        }
        self.arithmetic = Arithmetic(
            "exact balls", lambda value: ExactBall(arb(value)), functions, decided_comparisons=True
        )

    def restart(self, most_work: int) -> None:
        """Forget all roots, and do no more work than that from now on (`RootTower`).

        Of the balls made before, only those whose numbers are rational may still be used.
        """
        self.values = ExactValues(most_work)

    def work(self) -> int:
        """What has been done since then."""
        return self.values.tower.work

    def is_less(self, a: Any, b: Any) -> bool:
        """Whether a < b; whole numbers are compared as they are."""
        if not isinstance(a, ExactBall):
            return bool(a < b)
        if a.ball < b.ball:
            return True
        if a.ball >= b.ball:
            return False
        return self._sign_is_in((-1,), a, b)

    def is_less_or_equal(self, a: Any, b: Any) -> bool:
        """Whether a <= b; whole numbers are compared as they are."""
        if not isinstance(a, ExactBall):
            return bool(a <= b)
        if a.ball <= b.ball:
            return True
        if a.ball > b.ball:
            return False
        return self._sign_is_in((-1, 0), a, b)

    def is_equal(self, a: Any, b: Any) -> bool:
        """Whether a = b; whole numbers are compared as they are."""
        if not isinstance(a, ExactBall):
            return bool(a == b)
        if a.ball == b.ball:
            return True
        if a.ball != b.ball:
            return False
        return self._sign_is_in((0,), a, b)

    def floor(self, x: ExactBall) -> int:
        """The whole number below x; of a ball that none decides, as `balls.decided_floor`."""
        nearest = (x.ball + 0.5).mid().floor().unique_fmpz()
        if nearest is not None and x.ball.contains(arb(nearest)):
            try:
                sign = exact_sign(x, ExactBall(arb(nearest)), self.values)
            except NotExactError:
                sign = None
            if sign is not None:
                return int(nearest) - (sign < 0)
        return balls.decided_floor(x.ball, self.decisions)

    def is_zero(self, x: ExactBall) -> bool:
        """Whether a number is proven to be zero."""
        if not x.ball.contains(arb(0)):
            return False
        try:
            return exact_sign(x, ExactBall(arb(0)), self.values) == 0
        except NotExactError:
            return False

    def tangent(self, x: ExactBall) -> ExactBall:
        """The tangent of an angle: by a root, if it is known; else the symbol of the exact values."""
        form = TANGENTS.get(self._part_of_pi(x))
        if form is not None:
            a, b, n, divisor = (ExactBall(arb(number)) for number in form)
            return (a + b * _square_root(n)) / divisor
        tangent = ExactBall(x.ball.tan())
        tangent.value = self.values.tower.symbol(tangent.ball)
        return tangent

    def _part_of_pi(self, x: ExactBall) -> Any:
        """The rational q if x was made as q·π, by rational factors and divisors; None else."""
        if x is self.pi:
            return fmpq(1)
        if x.operation is ExactValues.multiply:
            factor, rest = x.operands
            part = self._part_of_pi(rest)
            return None if part is None or not factor.is_number() else part * exact_number(factor)
        if x.operation is ExactValues.divide:
            rest, divisor = x.operands
            part = self._part_of_pi(rest)
            return None if part is None or not divisor.is_number() else part / exact_number(divisor)
        return None

    def _sign_is_in(self, signs: tuple[int, ...], a: ExactBall, b: ExactBall) -> bool:
        try:
            return exact_sign(a, b, self.values) in signs
        except NotExactError:
            return self.decisions.next()


def _larger(a: ExactBall, b: ExactBall) -> ExactBall:
    if a.ball >= b.ball:
        return a
    return b if a.ball <= b.ball else ExactBall(a.ball.max(b.ball), ExactValues.larger, a, b)


def _smaller(a: ExactBall, b: ExactBall) -> ExactBall:
    if a.ball <= b.ball:
        return a
    return b if a.ball >= b.ball else ExactBall(a.ball.min(b.ball), ExactValues.smaller, a, b)


def _square_root(x: ExactBall) -> ExactBall:
    return ExactBall(balls.square_root(x.ball), ExactValues.square_root, x)
