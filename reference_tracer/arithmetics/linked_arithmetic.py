"""The arithmetic of linked balls: the functions that the tracer's source needs, over them (linked_balls.py)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
from raytruth.reference_tracer.arithmetics.balls import (
    MARGIN_BITS,
    comparison_functions,
    decided_floor,
    from_zero_to,
    stored_number,
)
from raytruth.reference_tracer.arithmetics.linked_balls import (
    ANYTHING,
    ONE,
    ZERO,
    ZERO_TO_ONE,
    LinkedBall,
    difference,
    enclosure,
)

if TYPE_CHECKING:
    from raytruth.reference_tracer.arithmetics.balls import Decisions


def linked_arithmetic(precision_bits: int, decisions: Decisions) -> Arithmetic:
    """Linked balls for a renderer whose operations err by at most 2^-precision_bits, relatively.

    Its function `ball` makes a number of a ball.
    """

    class RoundedLinkedBall(LinkedBall):
        __slots__ = ()
        roundoff = arb(0, arb(2) ** -precision_bits)
        about_one = arb(1, arb(2) ** -precision_bits)

    def ball(value: Any) -> LinkedBall:
        return RoundedLinkedBall(value.mid(), value, (), ZERO if value.is_exact() else value - value.mid())

    with ctx.workprec(precision_bits + MARGIN_BITS):
        pi = ball(arb.pi() * RoundedLinkedBall.about_one)
    functions = {
        **_comparisons(decisions),
        "ball": ball,
        "certainly_less": lambda a, b: a.range < b.range,
        "certainly_zero": lambda a: a.range == 0,
        "exp": _exp,
        "floor": lambda x: decided_floor(enclosure(x), decisions),
        "inf": ball(arb(math.inf)),
        "max": _max,
        "min": _min,
        "pi": pi,
        "power": _power,
        "sqrt": _sqrt,
        "tan": _tan,
    }
    return Arithmetic(
        f"linked balls of {precision_bits} bits",
        lambda value: ball(stored_number(value, precision_bits)),
        functions,
        decided_comparisons=True,
        in_force=lambda: ctx.workprec(precision_bits + MARGIN_BITS),
    )


def _comparisons(decisions: Decisions) -> dict[str, Any]:
    """The source's comparisons: what ranges leave open is looked at more closely; whole numbers are just compared."""
    plain = comparison_functions(decisions)

    def is_less(a: Any, b: Any) -> bool:
        if isinstance(a, LinkedBall):
            if a.range < b.range:
                return True
            if a.range >= b.range:
                return False
            a, b = difference(a, b), ZERO
        return plain["is_less"](a, b)

    def is_less_or_equal(a: Any, b: Any) -> bool:
        if isinstance(a, LinkedBall):
            if a.range <= b.range:
                return True
            if a.range > b.range:
                return False
            a, b = difference(a, b), ZERO
        return plain["is_less_or_equal"](a, b)

    def is_equal(a: Any, b: Any) -> bool:
        if isinstance(a, LinkedBall):
            if a.range == b.range:
                return True
            if a.range != b.range:
                return False
            a, b = difference(a, b), ZERO
        return plain["is_equal"](a, b)

    return {
        "is_less": is_less,
        "is_less_or_equal": is_less_or_equal,
        "is_greater": lambda a, b: is_less(b, a),
        "is_greater_or_equal": lambda a, b: is_less_or_equal(b, a),
        "is_equal": is_equal,
        "is_different": lambda a, b: not is_equal(a, b),
    }


def _exp(x: LinkedBall) -> LinkedBall:
    exact = x.range.exp()
    return x.rounded(x.center.exp(), exact, (x, exact))


def _tan(x: LinkedBall) -> LinkedBall:
    exact = x.range.tan()
    return x.rounded(x.center.tan(), exact, (x, ONE + exact * exact))


def _sqrt(x: LinkedBall) -> LinkedBall:
    """The root of max(x, 0): the source takes roots only of what it decided to be not negative."""
    if not x.range > 0:
        enclosure(x)
    center = x.center.max(ZERO).sqrt()
    if x.range > 0:
        exact = x.range.sqrt()
        return x.rounded(center, exact, (x, ONE / (exact + exact)))
    return x.rounded(center, from_zero_to(x.range.upper().max(ZERO).sqrt()), (x, ANYTHING))


def _power(base: LinkedBall, exponent: LinkedBall) -> LinkedBall:
    """max(base, 0) ** exponent, for a positive exponent."""
    center = base.center.max(ZERO) ** exponent.center if base.center > 0 else ZERO
    if base.range > 0:
        exact = base.range**exponent.range
        slope = exponent.range * base.range ** (exponent.range - 1)
        return base.rounded(center, exact, (base, slope), (exponent, exact * base.range.log()))
    upper = base.range.upper()
    if upper <= 0:
        return base.rounded(ZERO, ZERO)
    # By the base it is 0 at most, where the base is negative; by the exponent it is of no use so near to 0.
    steep = exponent.range * upper ** (exponent.range - 1) if exponent.range > 1 else ANYTHING
    links = [(base, from_zero_to(steep) if steep.is_finite() else ANYTHING)]
    if exponent.links or not exponent.range.is_exact():
        links.append((exponent, ANYTHING))
    return base.rounded(center, from_zero_to(upper**exponent.range), *links)


def _max(a: LinkedBall, b: LinkedBall) -> LinkedBall:
    if a.range >= b.range:
        return a
    if b.range >= a.range:
        return b
    return a.__class__(a.center.max(b.center), a.range.max(b.range), ((a, ZERO_TO_ONE), (b, ZERO_TO_ONE)))


def _min(a: LinkedBall, b: LinkedBall) -> LinkedBall:
    if a.range <= b.range:
        return a
    if b.range <= a.range:
        return b
    return a.__class__(a.center.min(b.center), a.range.min(b.range), ((a, ZERO_TO_ONE), (b, ZERO_TO_ONE)))
