"""Ball arithmetic: numbers that carry a rigorous bound of their own error (Arb: Johansson 2017, through python-flint).

A comparison of two balls may be certain, or undecided because the balls overlap. An undecided one never takes a branch
by itself: it asks the decisions in force, which follow a script and then take the first way, keeping a record. Running
the same code once for every script explores every way that the arithmetic leaves open (`every_outcome`).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


class Decisions:
    """Answers to comparisons that balls leave open: those of a script first, then True; all answers are recorded."""

    def __init__(self) -> None:
        self.answers: list[bool] = []
        self.position = 0
        self.comparisons = 0
        """How many comparisons there were, decided or not: a measure of work that depends on no clock."""

    def follow(self, script: list[bool]) -> None:
        """Begin a new evaluation, whose undecided comparisons are answered by this script."""
        self.answers = list(script)
        self.position = 0

    def next(self) -> bool:
        """The answer to an undecided comparison."""
        if self.position == len(self.answers):
            self.answers.append(True)
        self.position += 1
        return self.answers[self.position - 1]


# More than the arithmetic that is followed: what the balls lose themselves is then far below a unit roundoff.
MARGIN_BITS = 32


def ball_arithmetic(precision_bits: int, decisions: Decisions) -> Arithmetic:
    """Balls that enclose what exact arithmetic gives, with midpoints of `precision_bits` bits."""
    with ctx.workprec(precision_bits):
        functions = _functions(decisions)
    return Arithmetic(
        f"balls of {precision_bits} bits",
        arb,
        functions,
        decided_comparisons=True,
        in_force=lambda: ctx.workprec(precision_bits),
    )


def rounded_ball_arithmetic(precision_bits: int, decisions: Decisions) -> Arithmetic:
    """Balls that hold what a renderer may get whose operations err by at most 2^-precision_bits, relatively.

    Each result of an operation is widened by that much.
    """
    about_one = arb(1, arb(2) ** -precision_bits)

    def rounded(result: Any) -> Any:
        return result * about_one if type(result) is arb else result  # whole numbers are exact

    with ctx.workprec(precision_bits + MARGIN_BITS):
        functions = _functions(decisions)
        functions |= {name: _rounding(functions[name], about_one) for name in ("exp", "pi", "power", "sqrt", "tan")}
    return Arithmetic(
        f"rounded balls of {precision_bits} bits",
        lambda value: stored_number(value, precision_bits),
        {**functions, "rounded": rounded, "roundoff_factor": about_one},
        decided_comparisons=True,
        rounded_operations=True,
        in_force=lambda: ctx.workprec(precision_bits + MARGIN_BITS),
    )


def stored_number(value: float, precision_bits: int) -> Any:
    """A scene's number as a renderer stores it: exact if it fits, else within a unit roundoff."""
    exact = arb(value)
    if not math.isfinite(value) or (math.frexp(value)[0] * 2.0**precision_bits).is_integer():
        return exact
    return exact * arb(1, arb(2) ** -precision_bits)


def _functions(decisions: Decisions) -> dict[str, Any]:
    return {
        **comparison_functions(decisions),
        "certainly_less": lambda a, b: a < b,
        "certainly_zero": lambda a: a == 0,
        "exp": lambda x: x.exp(),
        "floor": lambda x: decided_floor(x, decisions),
        "inf": arb(math.inf),
        "max": lambda a, b: a.max(b),
        "min": lambda a, b: a.min(b),
        "pi": arb.pi(),
        "power": power,
        "sqrt": square_root,
        "tan": lambda x: x.tan(),
    }


def _rounding(function: Any, about_one: Any) -> Any:
    """A function, or a constant, whose result is rounded."""
    if not callable(function):
        return function * about_one
    return lambda *arguments: function(*arguments) * about_one


def every_outcome(
    run: Callable[[], Any], decisions: Decisions, limit: int, *, all_or_none: bool = False
) -> Iterator[Any]:
    """The results of `run` for every way its undecided comparisons can go; stops after `limit` of them.

    Each script ends in the opposite of one recorded answer, so no way is taken twice. Every script that waits leads to
    a way of its own at least: who can use all ways or none need not run those that are too many.
    """
    scripts: list[list[bool]] = [[]]
    for taken in range(1, limit + 1):
        script = scripts.pop()
        decisions.follow(script)
        yield run()
        answers = decisions.answers
        scripts.extend([*answers[:place], not answers[place]] for place in range(len(script), len(answers)))
        if not scripts:
            return
        if all_or_none and taken + len(scripts) > limit:
            break
    raise TooManyOutcomesError


class TooManyOutcomesError(Exception):
    """There are more outcomes than the limit."""


def comparison_functions(decisions: Decisions) -> dict[str, Callable[[Any, Any], bool]]:
    """The source's comparisons of balls, by name: what balls leave open is asked of the decisions."""

    def is_less(a: Any, b: Any) -> bool:
        decisions.comparisons += 1
        if a < b:
            return True
        if a >= b:
            return False
        return decisions.next()

    def is_less_or_equal(a: Any, b: Any) -> bool:
        decisions.comparisons += 1
        if a <= b:
            return True
        if a > b:
            return False
        return decisions.next()

    def is_equal(a: Any, b: Any) -> bool:
        decisions.comparisons += 1
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


def decided_floor(x: Any, decisions: Decisions) -> int:
    """The whole number below x; where that is undecided, one of two in a row, since only its parity is ever used."""
    ends: list[Any] = [end.floor().unique_fmpz() for end in (x.lower(), x.upper())] if x.is_finite() else [None]
    if None in ends:  # unknown, or beyond what the precision can tell apart
        return int(decisions.next())
    lowest, highest = map(int, ends)
    if lowest == highest:
        return lowest
    return lowest + int(decisions.next())


def square_root(x: Any) -> Any:
    """The root of the part of x that is not negative: the source takes roots only of what it decided to be so."""
    if x >= 0:
        return x.sqrt()
    return from_zero_to(x.upper().sqrt())


def power(base: Any, exponent: Any) -> Any:
    """Base ** exponent for the part of the base that is not negative; exponents are positive."""
    if base > 0:
        return base**exponent
    upper = base.upper()
    if upper <= 0:
        return arb(0)
    return from_zero_to(upper**exponent)


def from_zero_to(largest: Any) -> Any:
    """A ball that holds everything between 0 and the ball `largest`."""
    half = largest.upper() / 2
    return arb(half.mid(), half.upper())
