from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.balls import square_root
from raytruth.reference_tracer.arithmetics.double_double_balls import (
    DoubleDoubleBall,
    absolute,
    add,
    mul,
    neg,
    sqrt,
    sub,
    to_float_ball,
    truediv,
    two_sum,
)
from raytruth.reference_tracer.arithmetics.double_double_comparisons import (
    certainly_less,
    certainly_zero,
    equal,
    floor,
    less,
    less_or_equal,
    maximum,
    minimum,
)
from raytruth.reference_tracer.arithmetics.float_ball_comparisons import UNDECIDED
from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, Ball
from tests.reference_tracer.arithmetics.ball_draws import (
    EXACT_BITS,
    NUMBER_OF_BALLS,
    ROUNDOFFS,
    SPECIAL_BALLS,
    drawn_balls,
    drawn_roundoffs,
    factors,
)
from tests.reference_tracer.kernels import kept_precision

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

pytestmark = [pytest.mark.usefixtures("exact_points"), pytest.mark.clause("ARI-11")]
with_fixture = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture
def exact_points() -> Iterator[None]:
    for _ in kept_precision():
        ctx.prec = EXACT_BITS
        yield


def quotient(x: Any, y: Any) -> Any:
    with ctx.workprec(300):
        return x / y


def root(x: Any, _: Any) -> Any:
    with ctx.workprec(300):
        return x.sqrt() if not x < 0 else None


OPERATIONS: dict[str, tuple[Callable[..., DoubleDoubleBall], Callable[[Any, Any], Any]]] = {
    "add": (add, lambda x, y: x + y),
    "sub": (sub, lambda x, y: x - y),
    "mul": (mul, lambda x, y: x * y),
    "truediv": (truediv, quotient),
    "sqrt": (lambda a, _, roundoff: sqrt(a, roundoff), root),
    "neg": (lambda a, _b, _: neg(a), lambda x, _: -x),
    "absolute": (lambda a, _b, _: absolute(a), lambda x, _: abs(x)),
    "maximum": (lambda a, b, _: maximum(a, b), max),
    "minimum": (lambda a, b, _: minimum(a, b), min),
}
ROUNDED = {"add", "sub", "mul", "truediv", "sqrt"}


def middle(a: DoubleDoubleBall) -> Any:
    return arb(a.high) + arb(a.low)


def drawn(seed: int) -> Iterator[DoubleDoubleBall]:
    """Two thirds of them have a lower word; radii are of 106 bits, of 53 or wide."""
    random = np.random.default_rng(seed)
    for ball in drawn_balls(seed):
        word = two_sum(ball.middle, ball.middle * 2.0**-53 * max(random.uniform(-1.5, 1.0), -1.0))
        low = word.low if random.random() < 0.67 else 0.0
        yield DoubleDoubleBall(word.high, low, ball.radius * float(random.choice([1.0, 2.0**-53])))


def doubled(a: Ball) -> DoubleDoubleBall:
    return DoubleDoubleBall(a.middle, 0.0, a.radius)


def points(a: DoubleDoubleBall, inner: float = 0.3) -> list[Any]:
    if a.radius == 0.0 or not abs(a.high) <= LARGEST:
        return [middle(a)]
    return [middle(a) + arb(min(a.radius, LARGEST)) * arb(part) for part in (-1.0, 1.0, inner)]


def holds(a: DoubleDoubleBall, value: Any) -> bool:
    if math.isnan(a.high) or (a.radius == math.inf and value.is_finite()):
        return True
    if not abs(a.high) <= LARGEST:
        return bool(value == arb(a.high))
    return bool(abs(value - middle(a)) <= arb(a.radius)) if value.is_finite() else a.radius == math.inf


def check_points(name: str, a: DoubleDoubleBall, b: DoubleDoubleBall, roundoff: float, inner: float = 0.3) -> None:
    operation, exact = OPERATIONS[name]
    result = operation(a, b, roundoff)
    assert not result.radius < 0.0
    assert not abs(result.low) > abs(result.high) * 2.0**-53
    for x in points(a, inner):
        for y in [arb(0)] if name in {"sqrt", "neg", "absolute"} else points(b, -inner):
            value = exact(x, y)
            for factor in factors(roundoff if name in ROUNDED else 0.0):
                assert value is None or holds(result, value * factor), (name, a, b, roundoff, result)


@pytest.mark.parametrize("name", OPERATIONS)
def test_a_result_holds_the_exact_value_at_points_of_balls_of_all_sizes(name: str) -> None:
    for a, b, roundoff in zip(drawn(41), drawn(42), drawn_roundoffs(43), strict=True):
        check_points(name, a, b, roundoff)


@pytest.mark.parametrize("name", OPERATIONS)
def test_a_result_holds_the_exact_value_of_infinities_denormals_zeros_and_nan(name: str) -> None:
    for a in map(doubled, SPECIAL_BALLS):
        for b in map(doubled, SPECIAL_BALLS):
            check_points(name, a, b, 0.0)


DOUBLES = st.builds(
    lambda high, part, radius: DoubleDoubleBall(*two_sum(high, high * part * 2.0**-53), radius),
    st.floats(allow_nan=False, allow_infinity=False, min_value=-1e300, max_value=1e300),
    st.floats(-1, 1),
    st.floats(0.0) | st.just(0.0),
)


@with_fixture
@pytest.mark.parametrize("name", OPERATIONS)
@given(a=DOUBLES, b=DOUBLES, roundoff=st.sampled_from(ROUNDOFFS), inner=st.floats(-1, 1))
def test_a_result_holds_the_exact_value_at_points_of_any_balls(
    name: str, a: DoubleDoubleBall, b: DoubleDoubleBall, roundoff: float, inner: float
) -> None:
    check_points(name, a, b, roundoff, inner)


@pytest.mark.parametrize("name", OPERATIONS)
def test_a_radius_is_at_most_a_twentieth_larger_than_arbs(name: str) -> None:
    """Beside 16·u² of the result, for numbers of common size. Where a ball is wide, it is Arb's of 53 bits."""
    compared = 0
    for a, b in zip(drawn(44), drawn(45), strict=True):
        if not all(2.0**-300 < abs(number.high) < 2.0**300 for number in (a, b)):
            continue
        result = OPERATIONS[name][0](a, b, 0.0)
        with ctx.workprec(106):
            x, y = arb(middle(a), a.radius), arb(middle(b), b.radius)
            exact = {"truediv": lambda x, y: x / y, "sqrt": lambda x, _: square_root(x)}.get(name, OPERATIONS[name][1])
            exact = {"maximum": lambda x, y: x.max(y), "minimum": lambda x, y: x.min(y)}.get(name, exact)
            same = exact(x, y)
        if not same.is_finite():
            continue
        compared += 1
        arbs = float(same.rad())
        is_wide = arbs > abs(result.high) / 64
        unit = 2.0**-51 if is_wide or name in {"maximum", "minimum"} else 2.0**-102
        assert result.radius <= 1.05 * arbs + 1.5 * unit * (abs(result.high) + arbs) + 2.0**-660, (name, a, b, result)
    assert compared > NUMBER_OF_BALLS / 8


COMPARISONS: dict[str, tuple[Callable[[DoubleDoubleBall, DoubleDoubleBall], int], Callable[[Any, Any], bool]]] = {
    "less": (less, lambda x, y: x < y),
    "less_or_equal": (less_or_equal, lambda x, y: x <= y),
    "equal": (equal, lambda x, y: x == y),
}


@pytest.mark.parametrize("name", COMPARISONS)
def test_a_comparison_is_decided_as_at_all_points(name: str) -> None:
    compare, holding = COMPARISONS[name]
    decided = 0
    for a, other in zip(drawn(51), drawn(52), strict=True):
        near = DoubleDoubleBall(*two_sum(a.high, a.low + a.radius * 1.5 + abs(a.high) * 2.0**-90), a.radius * 0.4)
        for b in (other, near, a):
            answer = compare(a, b)
            decided += answer != UNDECIDED
            if answer != UNDECIDED:
                assert all(holding(x, y) == bool(answer) for x in points(a) for y in points(b, -0.3)), (name, a, b)
            if a.radius == 0.0 and b is a and abs(a.high) < 2.0**400:
                assert answer == (name != "less")
    assert decided > NUMBER_OF_BALLS
    for a in map(doubled, SPECIAL_BALLS):
        for b in map(doubled, SPECIAL_BALLS):
            answer = compare(a, b)
            if answer != UNDECIDED:
                assert all(holding(x, y) == bool(answer) for x in points(a) for y in points(b, -0.3)), (name, a, b)


@pytest.mark.parametrize(
    ("low", "radius", "lowest", "is_one"),
    [
        (0.0, 0.0, 3, True),
        (-(2.0**-80), 0.0, 2, True),
        (2.0**-80, 0.0, 3, True),
        (-(2.0**-80), 2.0**-81, 2, True),
        (0.0, 2.0**-80, 2, False),
        (2.0**-80, 2.0**-79, 2, False),
    ],
)
def test_a_floor_is_right_where_a_float_would_round_up(low: float, radius: float, lowest: int, is_one: bool) -> None:
    assert floor(DoubleDoubleBall(3.0, low, radius)) == (lowest, is_one)
    assert floor(DoubleDoubleBall(3.5, 0.0, 0.1)) == (3, True)
    assert floor(DoubleDoubleBall(3.5, 0.0, 2.0**60)) == (0, False)


def test_what_is_exact_stays_so_and_a_third_has_twice_the_bits() -> None:
    one, three = DoubleDoubleBall(1.0, 0.0, 0.0), DoubleDoubleBall(3.0, 0.0, 0.0)
    third = truediv(one, three, 0.0)
    assert 0.0 < third.radius < 2.0**-102
    assert to_float_ball(third).radius < 2.0**-53
    assert sub(third, DoubleDoubleBall(third.high, third.low, 0.0), 0.0).high == 0.0
    assert mul(DoubleDoubleBall(0.1, 0.0, 0.0), DoubleDoubleBall(0.3, 0.0, 0.0), 0.0).radius == 0.0
    assert certainly_zero(sub(three, three, 0.0))
    assert certainly_less(third, one)
