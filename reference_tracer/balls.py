"""Ball arithmetic: numbers that carry a rigorous bound of their own error (Arb: Johansson 2017, through python-flint).

A comparison of two balls may be certain, or undecided because the balls overlap. An undecided one never takes a branch
by itself: it asks the decisions in force, which follow a script and then take the first way, keeping a record. Running
the same code once for every script explores every way that the arithmetic leaves open (`every_outcome`).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from reference_tracer.arithmetic import Arithmetic

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


class Decisions:
    """Answers to undecided comparisons: a script first, then True; all answers are recorded."""

    def __init__(self) -> None:
        self.answers: list[bool] = []
        self.position = 0

    def follow(self, script: list[bool]) -> None:
        """Start again, with this script."""
        self.answers = list(script)
        self.position = 0

    def next(self) -> bool:
        """The answer to an undecided comparison."""
        if self.position == len(self.answers):
            self.answers.append(True)
        self.position += 1
        return self.answers[self.position - 1]


def ball_arithmetic(
    precision_bits: int, decisions: Decisions, overrides: dict[str, Callable[..., Any]] | None = None
) -> Arithmetic:
    """Balls whose midpoints have `precision_bits` bits; sets the precision of this process.

    A ball holds what exact arithmetic gives. With the bits of a renderer's number type its radius also follows what
    that arithmetic may have done to the value, but it is no proof of that: a renderer rounds once more at each step.
    """
    ctx.prec = precision_bits
    unit_roundoff = arb(2) ** -precision_bits

    def number(value: float) -> Any:
        """A scene's number as the renderer stores it: exact if it fits, else within a unit roundoff."""
        exact = arb(value)
        rounded = +exact
        return exact if rounded.rad() == 0 else arb(exact.mid(), abs(exact) * unit_roundoff)

    functions = {
        **comparison_functions(decisions),
        "certainly_less": lambda a, b: a < b,
        "certainly_zero": lambda a: a == 0,
        "exp": lambda x: x.exp(),
        "floor": lambda x: _floor(x, decisions),
        "inf": arb(math.inf),
        "max": lambda a, b: a.max(b),
        "min": lambda a, b: a.min(b),
        "pi": arb.pi(),
        "power": _power,
        "sqrt": _sqrt,
        "tan": lambda x: x.tan(),
        **(overrides or {}),
    }
    return Arithmetic(f"balls of {precision_bits} bits", number, functions, decided_comparisons=True)


def every_outcome(run: Callable[[], Any], decisions: Decisions, limit: int) -> Iterator[Any]:
    """The results of `run` for every way its undecided comparisons can go; stops after `limit` of them.

    Each script ends in the opposite of one recorded answer, so no way is taken twice.
    """
    scripts: list[list[bool]] = [[]]
    for _ in range(limit):
        script = scripts.pop()
        decisions.follow(script)
        yield run()
        answers = decisions.answers
        scripts.extend([*answers[:place], not answers[place]] for place in range(len(script), len(answers)))
        if not scripts:
            return
    raise TooManyOutcomesError


class TooManyOutcomesError(Exception):
    """There are more outcomes than the limit."""


def comparison_functions(decisions: Decisions) -> dict[str, Callable[[Any, Any], bool]]:
    """The comparisons of the source; whole numbers are compared as they are."""

    def is_less(a: Any, b: Any) -> bool:
        if a < b:
            return True
        if a >= b:
            return False
        return decisions.next()

    def is_less_or_equal(a: Any, b: Any) -> bool:
        if a <= b:
            return True
        if a > b:
            return False
        return decisions.next()

    def is_equal(a: Any, b: Any) -> bool:
        if a == b:
            return True
        if a != b:
            return False
        return decisions.next()

    return {
        "is_less": is_less,
        "is_less_or_equal": is_less_or_equal,
        "is_greater": lambda a, b: is_less(b, a),
        "is_greater_or_equal": lambda a, b: is_less_or_equal(b, a),
        "is_equal": is_equal,
        "is_different": lambda a, b: not is_equal(a, b),
    }


def _floor(x: Any, decisions: Decisions) -> int:
    """The whole number below x; where that is undecided, one of two in a row, since only its parity is ever used."""
    if not x.is_finite():
        return int(decisions.next())
    lowest, highest = (int(end.floor().unique_fmpz()) for end in (x.lower(), x.upper()))
    if lowest == highest:
        return lowest
    return lowest + int(decisions.next())


def _sqrt(x: Any) -> Any:
    """The root of the part of x that is not negative: the source takes roots only of what it decided to be so."""
    if x >= 0:
        return x.sqrt()
    return _from_zero_to(x.upper().sqrt())


def _power(base: Any, exponent: Any) -> Any:
    """Base ** exponent for the part of the base that is not negative; exponents are positive."""
    if base > 0:
        return base**exponent
    upper = base.upper()
    if upper <= 0:
        return arb(0)
    return _from_zero_to(upper**exponent)


def _from_zero_to(largest: Any) -> Any:
    """A ball that holds everything between 0 and the ball `largest`."""
    half = largest.upper() / 2
    return arb(half.mid(), half.upper())
