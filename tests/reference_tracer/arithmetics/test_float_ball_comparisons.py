from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, ctx
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.float_ball_comparisons import (
    UNDECIDED,
    certainly_less,
    certainly_zero,
    equal,
    floor,
    less,
    less_or_equal,
    maximum,
    minimum,
)
from raytruth.reference_tracer.arithmetics.float_ball_conversions import from_arb, from_interval, stored, to_arb
from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, UNDERFLOW, UNIT_ROUNDOFF, Ball
from tests.reference_tracer.arithmetics.ball_draws import (
    BALLS,
    EXACT_BITS,
    NUMBER_OF_BALLS,
    SPECIAL_BALLS,
    drawn_balls,
    holds,
    points,
)
from tests.reference_tracer.kernels import kept_precision

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

pytestmark = [pytest.mark.usefixtures("exact_points"), pytest.mark.clause("ARI-11")]
with_fixture = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])

COMPARISONS: dict[str, tuple[Callable[[Ball, Ball], int], Callable[[Any, Any], bool], Callable[[Any, Any], bool]]] = {
    "less": (less, lambda x, y: x < y, lambda x, y: x >= y),
    "less_or_equal": (less_or_equal, lambda x, y: x <= y, lambda x, y: x > y),
    "equal": (equal, lambda x, y: x == y, lambda x, y: x != y),
}
EXTREMES = {"maximum": (maximum, max, lambda x, y: x.max(y)), "minimum": (minimum, min, lambda x, y: x.min(y))}


@pytest.fixture
def exact_points() -> Iterator[None]:
    for _ in kept_precision():
        ctx.prec = EXACT_BITS
        yield


def near_pairs(seed: int) -> Iterator[tuple[Ball, Ball]]:
    """Of balls that overlap, touch, almost touch or are far apart."""
    for place, (a, other) in enumerate(zip(drawn_balls(seed), drawn_balls(seed + 1), strict=True)):
        if place % 4 == 0:
            yield a, other
            continue
        radius = (0.0, a.radius, abs(a.middle) * 2.0**-50, a.radius * 0.5)[place % 16 // 4]
        distance = (a.radius + radius) * (1.0, 1.0 - 2.0**-52, 1.0 + 2.0**-48, 0.7)[place % 4]
        yield a, Ball(a.middle + distance, radius)


def check_comparison(name: str, a: Ball, b: Ball) -> None:
    compare, holding, _ = COMPARISONS[name]
    answer = compare(a, b)
    assert answer in {0, 1, UNDECIDED}
    if answer != UNDECIDED:
        assert all(holding(x, y) == bool(answer) for x in points(a) for y in points(b, -0.3)), (name, a, b, answer)


@pytest.mark.parametrize("name", COMPARISONS)
def test_a_comparison_is_decided_as_at_all_points_and_where_arb_decides_it(name: str) -> None:
    """Arb's is open for a little less, since here a gap counts only from 2^-49 of the radii and roundings on."""
    decided = 0
    _, holding, failing = COMPARISONS[name]
    for a, b in near_pairs(21):
        check_comparison(name, a, b)
        if COMPARISONS[name][0](a, b) != UNDECIDED:
            decided += 1
            continue
        slack = (a.radius + b.radius) * 2.0**-28  # Arb's radii have 30 bits
        x, y = arb(a.middle, a.radius + slack), arb(b.middle, b.radius + slack)
        assert not holding(x, y), (name, a, b)
        assert not failing(x, y), (name, a, b)
    assert NUMBER_OF_BALLS / 4 < decided < NUMBER_OF_BALLS


@pytest.mark.parametrize("name", COMPARISONS)
def test_a_comparison_of_infinities_denormals_zeros_and_nan_is_decided_as_at_all_points(name: str) -> None:
    for a in SPECIAL_BALLS:
        for b in SPECIAL_BALLS:
            check_comparison(name, a, b)
            if math.isnan(a.middle) or math.isnan(b.middle):
                assert COMPARISONS[name][0](a, b) == UNDECIDED
    infinity = Ball(math.inf, 0.0)
    assert less(infinity, infinity) == 0
    assert less_or_equal(infinity, infinity) == equal(infinity, infinity) == less(Ball(1.0, 1.0), infinity) == 1
    assert less(Ball(1.0, math.inf), infinity) == UNDECIDED


@with_fixture
@pytest.mark.parametrize("name", COMPARISONS)
@given(a=BALLS, b=BALLS)
def test_a_comparison_of_any_balls_is_decided_as_at_all_points(name: str, a: Ball, b: Ball) -> None:
    check_comparison(name, a, b)
    assert certainly_less(a, b) == (less(a, b) == 1)
    assert certainly_zero(a) == (str(a.middle) in {"0.0", "-0.0"} and a.radius == 0.0)


@pytest.mark.parametrize("name", EXTREMES)
def test_a_maximum_and_a_minimum_hold_those_of_points_and_are_hardly_wider_than_arbs(name: str) -> None:
    extreme, of_points, of_arbs = EXTREMES[name]
    for a, b in near_pairs(31):
        result = extreme(a, b)
        for x in points(a):
            assert all(holds(result, of_points(x, y)) for y in points(b, -0.3)), (a, b, result)
        arbs = of_arbs(arb(a.middle, a.radius), arb(b.middle, b.radius))
        if not abs(arbs) < arb(LARGEST):
            continue  # an end is no float
        assert result.radius <= 1.05 * float(arbs.rad()) + 4 * UNIT_ROUNDOFF * abs(result.middle) + 2 * UNDERFLOW


@pytest.mark.parametrize("name", EXTREMES)
def test_a_maximum_and_a_minimum_of_infinities_denormals_zeros_and_nan_hold_those_of_points(name: str) -> None:
    extreme, of_points, _ = EXTREMES[name]
    for a in SPECIAL_BALLS:
        for b in SPECIAL_BALLS:
            result = extreme(a, b)
            for x in points(a):
                assert all(holds(result, of_points(x, y)) for y in points(b, -0.3)), (a, b, result)


@with_fixture
@given(a=BALLS | st.builds(Ball, st.floats(-100, 100), st.sampled_from([0.0, 2.0**-50, 0.25, 1.5])))
def test_the_whole_numbers_below_a_ball_are_those_below_its_points(a: Ball) -> None:
    found = floor(a)
    if found.is_one:
        assert all(x.floor() == found.lowest for x in points(a))
    elif a.radius < 0.5 and abs(a.middle) < 2.0**50:
        assert all(x.floor() in (found.lowest, found.lowest + 1) for x in points(a))
        assert points(a)[0].floor() != points(a)[1].floor() or abs(a.middle - round(a.middle)) - a.radius < 1e-9
    if a.radius == 0.0 and abs(a.middle) < 2.0**50:
        assert found.is_one


@with_fixture
@given(a=BALLS, bits=st.sampled_from([24, 53, 90]))
def test_a_ball_of_arb_and_one_of_floats_hold_each_other(a: Ball, bits: int) -> None:
    assert holds(from_arb(to_arb(a)), arb(a.middle))
    if abs(a.middle) <= LARGEST and a.radius <= LARGEST:
        assert to_arb(a).contains(arb(a.middle))
        back = from_arb(to_arb(a))
        assert back.radius == math.inf or back.radius <= a.radius * (1 + 2.0**-28) + UNDERFLOW
        assert a.radius <= back.radius
        third = from_arb(arb(a.middle) / 3)
        assert holds(third, arb(a.middle) / 3)
        assert third.radius <= abs(third.middle) * 2.0**-52 + UNDERFLOW
        number = stored(a.middle, bits)
        assert holds(number, arb(a.middle))
        assert number.radius <= abs(a.middle) * 2.0**-bits * (1 + 2.0**-23) + UNDERFLOW


@with_fixture
@given(least=st.fractions(), extent=st.fractions(0, 1))
def test_an_exact_interval_becomes_a_ball_around_it(least: Fraction, extent: Fraction) -> None:
    ball = from_interval(least, least + extent)
    ends = Fraction(ball.middle) - Fraction(ball.radius), Fraction(ball.middle) + Fraction(ball.radius)
    assert ends[0] <= least <= least + extent <= ends[1]
    assert Fraction(ball.radius) <= (extent / 2 + abs(least + extent) * Fraction(2) ** -52) * Fraction(1 + 2.0**-40)
