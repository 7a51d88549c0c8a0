"""What is done to boxes, in balls of floats and in double-double balls: tests of box_balls.py and the other."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.feasible_sets import box_balls, box_double_doubles
from raytruth.reference_tracer.arithmetics.double_double_balls import from_float_ball, to_float_ball
from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, Ball, lower, upper
from tests.reference_tracer.arithmetics.ball_draws import EXACT_BITS

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.clause("ARI-11")

NUMBERS = st.floats(-1e6, 1e6, allow_subnormal=False)
BALLS = st.builds(Ball, NUMBERS, st.floats(0.0, 1e6))
PARTS = st.floats(-1.0, 1.0)
BROKEN = [Ball(math.nan, math.inf), Ball(0.0, math.inf), Ball(math.inf, 0.0)]
KINDS = pytest.mark.parametrize(
    ("functions", "of"),
    [(box_balls, lambda ball: ball), (box_double_doubles, from_float_ball)],
    ids=["floats", "double-doubles"],
)


@pytest.fixture(autouse=True)
def exactly() -> Iterator[None]:
    """Arb computes without rounding."""
    with ctx.workprec(EXACT_BITS):
        yield


def as_floats(ball: Any) -> Ball:
    return ball if isinstance(ball, Ball) else to_float_ball(ball)


def point(ball: Ball, part: float) -> Any:
    return arb(ball.middle) + arb(ball.radius) * arb(part)


def holds(ball: Any, value: Any) -> bool:
    plain = as_floats(ball)
    return bool(abs(value - arb(plain.middle)) <= arb(plain.radius))


@KINDS
@given(BALLS, BALLS, PARTS, PARTS)
def test_sums_and_hulls_hold_what_they_are_of(functions: Any, of: Any, a: Ball, b: Ball, s: float, t: float) -> None:
    assert holds(functions.ball_sum(of(a), of(b)), point(a, s) + point(b, t))
    hull = functions.ball_hull(of(a), of(b))
    assert holds(hull, point(a, s))
    assert holds(hull, point(b, t))


@KINDS
@given(BALLS, BALLS, PARTS)
def test_what_is_common_holds_each_number_of_both(functions: Any, of: Any, a: Ball, b: Ball, s: float) -> None:
    shared, value = functions.ball_common(of(a), of(b)), point(a, s)
    if holds(of(b), value):
        assert holds(shared, value)
    assert as_floats(shared).radius <= max(a.radius, b.radius) * (1 + 1e-9)


@KINDS
def test_a_ball_inside_of_another_stays_as_it_is(functions: Any, of: Any) -> None:
    inner, outer = of(Ball(0.25, 0.125)), of(Ball(0.5, 0.5))
    assert functions.ball_common(inner, outer) == inner


@KINDS
@pytest.mark.parametrize("broken", BROKEN)
def test_where_the_arithmetic_broke_down_all_is_left_that_is_possible(functions: Any, of: Any, broken: Ball) -> None:
    possible = of(Ball(0.5, 0.5))
    assert not functions.is_finite(of(broken))
    assert functions.ball_common(of(broken), possible) == possible
    assert not functions.is_finite(functions.ball_hull(of(broken), possible))


@KINDS
def test_of_balls_that_do_not_touch_the_possible_one_is_left(functions: Any, of: Any) -> None:
    possible = of(Ball(0.5, 0.5))
    assert functions.ball_common(of(Ball(-2.0, 0.5)), possible) == possible


@KINDS
@given(st.floats(0.0, 1e6), st.floats(0.0, 1.0), st.floats(0.0, 100.0), st.floats(0.0, 1.0))
def test_from_black_holds_all_up_to_the_product(
    functions: Any, of: Any, middle: float, radius: float, factor: float, part: float
) -> None:
    weight = Ball(middle, radius)
    assert holds(functions.from_black(of(weight), factor), point(weight, 1.0) * arb(factor) * arb(part))


@KINDS
@given(BALLS, NUMBERS)
def test_ends_and_limits_are_those_of_the_ball(functions: Any, of: Any, ball: Ball, limit: float) -> None:
    assert functions.upper_end(of(ball)) >= upper(ball)
    assert lower(ball) <= functions.upper_end(of(ball)) <= LARGEST
    if functions.is_under(of(ball), limit):
        assert point(ball, 1.0) < limit


@KINDS
def test_single_numbers_and_centres_are_exact(functions: Any, of: Any) -> None:
    assert functions.exact_ball(1.0) == of(Ball(1.0, 0.0))
    assert functions.pixel_center(3, 0.25) == of(Ball(3.5, 0.25))
