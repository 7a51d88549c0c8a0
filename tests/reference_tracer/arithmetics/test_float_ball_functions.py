from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, ctx
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.balls import power as arb_power
from raytruth.reference_tracer.arithmetics.float_ball_functions import (
    HALF_PI,
    HALF_PI_LOW,
    LOG_TWO_HIGH,
    LOG_TWO_LOW,
    exp,
    power,
    tan,
)
from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, UNDERFLOW, Ball
from tests.reference_tracer.arithmetics.ball_draws import (
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

pytestmark = [pytest.mark.usefixtures("many_bits"), pytest.mark.clause("ARI-11")]
with_fixture = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture
def many_bits() -> Iterator[None]:
    for _ in kept_precision():
        ctx.prec = 300
        yield


def exact_power(x: Any, y: Any) -> Any:
    """Of the part that is not negative, as the source takes them."""
    return arb(0) if x <= 0 else x**y


FUNCTIONS: dict[str, tuple[Callable[[Ball, Ball, float], Ball], Callable[[Any, Any], Any]]] = {
    "exp": (lambda a, _, roundoff: exp(a, roundoff), lambda x, _: x.exp()),
    "tan": (lambda a, _, roundoff: tan(a, roundoff), lambda x, _: x.tan()),
    "power": (power, exact_power),
}


def check_points(name: str, a: Ball, b: Ball, roundoff: float, inner: float = 0.3) -> None:
    function, exact = FUNCTIONS[name]
    result = function(a, b, roundoff)
    assert not result.radius < 0.0
    for x in points(a, inner):
        for y in points(b, inner) if name == "power" else [arb(0)]:
            if name == "power" and not y > 0:
                continue
            for factor in factors(roundoff):
                assert holds(result, exact(x, y) * factor), (name, a, b, roundoff, result)


def arguments(name: str, seed: int) -> Iterator[tuple[Ball, Ball]]:
    """Balls that a function has finite values at: of moderate size, some of them tiny."""
    for a, b in zip(drawn_balls(seed, NUMBER_OF_BALLS), drawn_balls(seed + 1, NUMBER_OF_BALLS), strict=True):
        size = abs(a.middle)
        if name == "exp":
            shrink = 1.0 if size < 700.0 else 2.0**-1022
        elif name == "tan":
            shrink = 0.99 * math.pi / 2 / (size + a.radius) if size + a.radius > 1.5 else 1.0
        else:
            shrink = 1.0
        exponent = Ball(min(abs(b.middle) + 0.01, 300.0), min(b.radius, 0.4) if b.radius < 1e-3 else 0.0)
        yield Ball(a.middle * shrink, a.radius * shrink), exponent


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_result_holds_the_exact_value_at_points_of_balls(name: str) -> None:
    for (a, b), roundoff in zip(arguments(name, 11), drawn_roundoffs(13, NUMBER_OF_BALLS), strict=True):
        check_points(name, a, b, roundoff)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_result_holds_the_exact_value_of_infinities_denormals_zeros_and_nan(name: str) -> None:
    for a in SPECIAL_BALLS:
        for b in (Ball(1.0, 0.0), Ball(2.5, 1.0), Ball(math.inf, 0.0), Ball(math.nan, 1.0), Ball(1.0, math.inf)):
            check_points(name, a, b, 2.0**-24)


@with_fixture
@pytest.mark.parametrize("name", FUNCTIONS)
@given(
    a=st.builds(Ball, st.floats(-800, 800) | st.floats(-2, 2), st.sampled_from([0.0, 1e-300, 1e-17, 0.01, 0.03, 3.0])),
    b=st.builds(Ball, st.floats(0.001, 400), st.sampled_from([0.0, 1e-9, 0.25])),
    roundoff=st.sampled_from(ROUNDOFFS),
    inner=st.floats(-1, 1),
)
def test_a_result_holds_the_exact_value_at_points_of_any_balls(
    name: str, a: Ball, b: Ball, roundoff: float, inner: float
) -> None:
    check_points(name, a, b, roundoff, inner)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_radius_is_at_most_a_twentieth_larger_than_arbs(name: str) -> None:
    """Beside some roundings.

    The power x^y has those of the logarithm too, which are y·|log x| times as many. The tangent has those of the ends,
    which it makes larger by x·tan'(x)/tan(x).
    """
    compared = 0
    for (a, b), roundoff in zip(arguments(name, 14), drawn_roundoffs(16, NUMBER_OF_BALLS), strict=True):
        result = FUNCTIONS[name][0](a, b, roundoff)
        with ctx.workprec(53):
            x, y = arb(a.middle, a.radius), arb(b.middle, b.radius)
            same = (arb_power(x, y) if name == "power" else FUNCTIONS[name][1](x, y)) * arb(1, roundoff)
            if not same.is_finite() or not float(abs(same).upper()) <= LARGEST:
                continue
            arbs, size = float(same.rad()), float(abs(same).upper())
        if name == "power":
            if a.middle <= 0.0:
                continue
            roundings = 16.0 * (1.0 + (b.middle + b.radius) * abs(math.log(a.middle)))
        elif name == "tan" and a.middle:
            roundings = 16.0 + 8.0 * abs(2.0 * a.middle / math.sin(2.0 * a.middle))
        else:
            roundings = 8.0
        compared += 1
        allowed = 1.05 * arbs + roundings * 2.0**-53 * size + 6 * UNDERFLOW
        assert result.radius <= allowed, (name, a, b, roundoff, result, arbs)
    assert compared > NUMBER_OF_BALLS / 4


def test_what_is_exact_stays_so() -> None:
    assert exp(Ball(0.0, 0.0), 0.0).middle == 1.0
    assert tan(Ball(0.0, 0.0), 0.0) == power(Ball(-1.0, 0.5), Ball(7.0, 0.0), 0.0) == Ball(0.0, 0.0)
    assert exp(Ball(0.0, 0.0), 0.0).radius == 0.0


def test_powers_by_small_exponents_of_balls_that_are_just_narrow_are_held() -> None:
    for exponent in (0.01, 0.1, 0.4, 1.0):
        for middle in (0.1, 0.9, 3.0):
            check_points("power", Ball(middle, middle / 32.0 * 0.999), Ball(exponent, 0.0), 0.0)


def test_the_constants_are_what_they_say() -> None:
    assert holds(LOG_TWO_LOW, arb(2).log() - arb(LOG_TWO_HIGH))
    assert holds(HALF_PI_LOW, arb.pi() / 2 - arb(HALF_PI))
    assert (LOG_TWO_HIGH * 2.0**32).is_integer()
