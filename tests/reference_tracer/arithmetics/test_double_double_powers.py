"""Exponentials and powers of double-double balls hold what Arb has with 300 bits, to some 100 bits."""

from __future__ import annotations

import math

import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.double_double_balls import DoubleDoubleBall
from raytruth.reference_tracer.arithmetics.double_double_powers import DEGREE, HALVINGS, LOG_TWO, REST, exp, power

pytestmark = pytest.mark.clause("ARI-11")

DIGITS = 300


def exactly(high: float, low_part: float, radius: float = 0.0) -> DoubleDoubleBall:
    """A ball whose low part is a part of half a unit in the last place of its high part."""
    return DoubleDoubleBall(high, low_part * math.ulp(high) / 2.0, radius)


def middle_of(ball: DoubleDoubleBall) -> arb:
    return arb(ball.high) + arb(ball.low)


def holds(ball: DoubleDoubleBall, value: arb) -> bool:
    return bool(abs(value - middle_of(ball)) <= arb(ball.radius))


def is_narrow(ball: DoubleDoubleBall, bits: int) -> bool:
    return ball.radius <= 2.0**-bits * abs(ball.high)


PARTS = st.floats(-1.0, 1.0)


@given(st.floats(-200.0, 200.0), PARTS)
def test_the_exponential_holds_the_exact_one_closely(high: float, part: float) -> None:
    with ctx.workprec(DIGITS):
        ball = exactly(high, part)
        found = exp(ball)
        assert holds(found, middle_of(ball).exp())
        assert is_narrow(found, 84)


@given(st.floats(-800.0, 800.0), PARTS, st.floats(0.0, 2.0), PARTS)
def test_the_exponential_of_a_ball_holds_those_of_its_points(
    high: float, part: float, radius: float, where: float
) -> None:
    with ctx.workprec(DIGITS):
        ball = exactly(high, part, radius)
        found = exp(ball)
        assert found.radius == math.inf or holds(found, (middle_of(ball) + arb(radius) * arb(where)).exp())


@given(st.floats(2.0**-20, 1.0), PARTS, st.integers(0, 1000) | st.sampled_from([2.5, 1e9, 4097.0]))
def test_a_power_holds_the_exact_one_and_whole_ones_closely(high: float, part: float, exponent: float) -> None:
    with ctx.workprec(DIGITS):
        ball = exactly(high, part)
        found = power(ball, DoubleDoubleBall(float(exponent), 0.0, 0.0))
        value = middle_of(ball) ** arb(exponent)
        assert holds(found, value)
        if isinstance(exponent, int) and value > arb(2.0**-350):
            assert is_narrow(found, 90)


@given(st.floats(-1.0, 1.0), st.floats(0.0, 0.5), PARTS, st.integers(0, 60))
def test_a_power_of_a_ball_holds_those_of_its_points(high: float, radius: float, where: float, exponent: int) -> None:
    with ctx.workprec(DIGITS):
        found = power(DoubleDoubleBall(high, 0.0, radius), DoubleDoubleBall(float(exponent), 0.0, 0.0))
        assert holds(found, (arb(high) + arb(radius) * arb(where)) ** exponent)


def test_the_constants_are_what_they_stand_for() -> None:
    with ctx.workprec(DIGITS):
        assert holds(LOG_TWO, arb(2).log())
        largest = arb(2) ** -HALVINGS
        first_left_out = largest ** (DEGREE + 1) / arb(DEGREE + 2).gamma()
        assert first_left_out / (1 - largest) < arb(REST.radius)


def test_what_is_zero_or_one_is_exact() -> None:
    zero, one = DoubleDoubleBall(0.0, 0.0, 0.0), DoubleDoubleBall(1.0, 0.0, 0.0)
    assert power(zero, one) == zero
    assert power(zero, zero) == power(one, DoubleDoubleBall(7.0, 0.0, 0.0)) == one
