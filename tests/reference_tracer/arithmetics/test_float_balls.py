from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, ctx
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.balls import square_root
from raytruth.reference_tracer.arithmetics.float_balls import (
    LARGEST,
    SMALLEST,
    UNDERFLOW,
    UNIT_ROUNDOFF,
    Ball,
    absolute,
    add,
    hull,
    lower,
    mul,
    neg,
    sqrt,
    sub,
    truediv,
    upper,
)
from tests.reference_tracer.arithmetics.ball_draws import (
    BALLS,
    EXACT_BITS,
    NUMBER_OF_BALLS,
    ROUNDOFFS,
    SPECIAL_BALLS,
    drawn_balls,
    drawn_roundoffs,
    factors,
    holds,
    points,
)
from tests.reference_tracer.kernels import kept_precision

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

pytestmark = [pytest.mark.usefixtures("exact_points"), pytest.mark.clause("ARI-11")]
with_fixture = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])

# Quotients and roots are seldom exact, and need not have all of the bits.
FUNCTION_BITS = 300


def quotient(x: Any, y: Any) -> Any:
    with ctx.workprec(FUNCTION_BITS):
        return x / y


def root(x: Any, _: Any) -> Any:
    """Of what is negative there is none to be held."""
    with ctx.workprec(FUNCTION_BITS):
        return x.sqrt() if not x < 0 else None


OPERATIONS: dict[str, tuple[Callable[[Ball, Ball, float], Ball], Callable[[Any, Any], Any]]] = {
    "add": (add, lambda x, y: x + y),
    "sub": (sub, lambda x, y: x - y),
    "mul": (mul, lambda x, y: x * y),
    "truediv": (truediv, quotient),
    "sqrt": (lambda a, _, roundoff: sqrt(a, roundoff), root),
    "neg": (lambda a, _b, _: neg(a), lambda x, _: -x),
    "abs": (lambda a, _b, _: absolute(a), lambda x, _: abs(x)),
}
ROUNDED = {"add", "sub", "mul", "truediv", "sqrt"}


@pytest.fixture
def exact_points() -> Iterator[None]:
    for _ in kept_precision():
        ctx.prec = EXACT_BITS
        yield


def check_points(name: str, a: Ball, b: Ball, roundoff: float, inner: float = 0.3) -> None:
    """The result holds the exact value at each point, rounded up, down and not at all."""
    operation, exact = OPERATIONS[name]
    result = operation(a, b, roundoff)
    assert not result.radius < 0.0
    others = points(b, -inner) if name in {"add", "sub", "mul", "truediv"} else [arb(0)]
    for x in points(a, inner):
        for y in others:
            value = exact(x, y)
            for factor in factors(roundoff if name in ROUNDED else 0.0):
                assert value is None or holds(result, value * factor), (name, a, b, roundoff, result)


@pytest.mark.parametrize("name", OPERATIONS)
def test_a_result_holds_the_exact_value_at_points_of_balls_of_all_sizes(name: str) -> None:
    pairs = zip(drawn_balls(1), drawn_balls(2), drawn_roundoffs(3), strict=True)
    count = 0
    for a, b, roundoff in pairs:
        check_points(name, a, b, roundoff)
        count += 1
    assert count == NUMBER_OF_BALLS


@pytest.mark.parametrize("name", OPERATIONS)
@pytest.mark.parametrize("roundoff", [0.0, 2.0**-24])
def test_a_result_holds_the_exact_value_of_infinities_denormals_zeros_and_nan(name: str, roundoff: float) -> None:
    for a in SPECIAL_BALLS:
        for b in SPECIAL_BALLS:
            check_points(name, a, b, roundoff)


@with_fixture
@pytest.mark.parametrize("name", OPERATIONS)
@given(a=BALLS, b=BALLS, roundoff=st.sampled_from(ROUNDOFFS), inner=st.floats(-1, 1))
def test_a_result_holds_the_exact_value_at_points_of_any_balls(
    name: str, a: Ball, b: Ball, roundoff: float, inner: float
) -> None:
    check_points(name, a, b, roundoff, inner)


ARBS: dict[str, Callable[[Any, Any], Any]] = {
    **{name: OPERATIONS[name][1] for name in ("add", "sub", "mul", "neg", "abs")},
    "truediv": lambda x, y: x / y,
    "sqrt": lambda x, _: square_root(x),
}


@pytest.mark.parametrize("name", OPERATIONS)
def test_a_radius_is_at_most_a_twentieth_larger_than_arbs(name: str) -> None:
    """Beside that a rounding of the middle, since Arb knows which products are exact, and ours does not.

    The radii of quotients by the smallest divisors hold what a denormal numerator loses, which Arb's never does.
    """
    compared = 0
    for a, b, roundoff in zip(drawn_balls(4), drawn_balls(5), drawn_roundoffs(6), strict=True):
        result = OPERATIONS[name][0](a, b, roundoff)
        with ctx.workprec(53):
            same = ARBS[name](arb(a.middle, a.radius), arb(b.middle, b.radius))
            if name in ROUNDED and roundoff:
                same = same * arb(1, roundoff)
            if not same.is_finite() or not float(abs(same).upper()) <= LARGEST:
                continue
            arbs = float(same.rad())
        if name == "truediv" and min(abs(a.middle), abs(b.middle)) < 2.0**-960:
            continue
        compared += 1
        rounding = UNIT_ROUNDOFF * (abs(result.middle) + arbs)
        assert result.radius <= 1.05 * arbs + 1.5 * rounding + 3 * UNDERFLOW, (name, a, b, roundoff, result, arbs)
    assert compared > NUMBER_OF_BALLS / 4


def test_what_is_exact_stays_so() -> None:
    zero, x, wide = Ball(0.0, 0.0), Ball(0.1, 0.0), Ball(0.1, 0.5)
    for roundoff in ROUNDOFFS:
        assert mul(zero, wide, roundoff) == mul(wide, zero, roundoff) == zero
        assert truediv(zero, x, roundoff) == sqrt(zero, roundoff) == add(zero, zero, roundoff) == sub(x, x, roundoff)
        assert sub(x, x, roundoff) == zero
    assert add(zero, x, 0.0) == x
    assert add(Ball(1.0, 0.0), Ball(2.0**-40, 0.0), 0.0).radius == 0.0
    assert mul(zero, Ball(0.0, math.inf), 0.0) == zero


def test_what_overflows_may_be_any_number_and_what_has_no_value_is_unknown() -> None:
    large, infinity = Ball(LARGEST, 0.0), Ball(math.inf, 0.0)
    for result in (add(large, large, 0.0), mul(large, large, 0.0), truediv(large, Ball(0.5, 0.0), 0.0)):
        assert result == Ball(0.0, math.inf)
    for result in (
        truediv(large, Ball(1.0, 1.0), 0.0),
        sqrt(Ball(-1.0, 0.5), 0.0),
        sub(infinity, infinity, 0.0),
        mul(Ball(0.0, 0.0), infinity, 0.0),
        truediv(infinity, infinity, 0.0),
    ):
        assert math.isnan(result.middle)
    assert add(infinity, large, 0.0) == infinity
    assert truediv(large, infinity, 0.0) == Ball(0.0, 0.0)


@with_fixture
@given(a=BALLS)
def test_the_ends_of_a_ball_are_outside_it_and_next_to_it(a: Ball) -> None:
    if abs(a.middle) <= LARGEST and a.radius <= LARGEST:
        least, most = arb(a.middle) - arb(a.radius), arb(a.middle) + arb(a.radius)
        assert arb(lower(a)) <= least
        assert arb(upper(a)) >= most
        assert not lower(a) < -LARGEST or least < -arb(LARGEST) * (1 - arb(2) ** -50)
        if lower(a) >= -LARGEST:
            assert least - arb(lower(a)) <= abs(least) * arb(2) ** -50
    elif a.radius == 0.0:
        assert str(lower(a)) == str(upper(a)) == str(a.middle)


@with_fixture
@given(a=st.floats(allow_nan=False), b=st.floats(allow_nan=False))
def test_a_hull_holds_both_ends_and_is_hardly_wider(a: float, b: float) -> None:
    ball = hull(min(a, b), max(a, b))
    assert holds(ball, arb(a)) or math.isinf(a)
    assert holds(ball, arb(b)) or math.isinf(b)
    if abs(a) < 2.0**1000 and abs(b) < 2.0**1000:
        assert ball.radius <= abs(a - b) * (0.5 + 2.0**-40) + 2 * UNDERFLOW + abs(ball.middle) * 2 * UNIT_ROUNDOFF
    assert (ball.radius == 0.0) == (a == b)
    assert SMALLEST > 0.0


@pytest.mark.clause("PRJ-2")
def test_the_worked_number_of_the_page_on_balls_is_what_comes_out() -> None:
    text = (Path(__file__).parents[3] / "docs" / "ball-arithmetic.md").read_text(encoding="utf-8")
    for roundoff in (0.0, 2.0**-24):
        product = mul(Ball(2.0, 0.5), Ball(3.0, 0.25), roundoff)
        assert product.middle == 6.0
        assert f"{product.radius!r}" in text
    assert UNDERFLOW == 2.0**-1071
