from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import mpmath
import pytest
from flint import arb
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.linked_arithmetic import linked_arithmetic
from raytruth.reference_tracer.arithmetics.linked_balls import LinkedBall, condensed, enclosure
from tests.reference_tracer.kernels import kept_precision, put_in_force

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.clause("ARI-4")

BITS = 24
ROUNDOFF = 2.0**-BITS


@pytest.fixture(autouse=True, scope="module")
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def arithmetic(decisions: Decisions | None = None) -> Any:
    return put_in_force(linked_arithmetic(BITS, decisions or Decisions()))


def between(low: float, high: float) -> LinkedBall:
    """A number of which only this is known, and of which others may be made."""
    made = arithmetic()
    middle, radius = (low + high) / 2, (high - low) / 2
    number: LinkedBall = made.functions["ball"](arb(middle, radius))
    (linked,) = condensed([number])
    return linked


def holds(number: LinkedBall, value: float) -> bool:
    return bool(enclosure(number).contains(arb(value)))


@given(st.floats(0.01, 50), st.floats(0, 0.005), st.floats(-1, 1))
def test_functions_hold_their_values_over_a_range(middle: float, radius: float, part: float) -> None:
    made = arithmetic()
    number = between(middle - radius, middle + radius)
    point = middle + radius * part
    for name in ("sqrt", "exp"):
        expected = float(getattr(mpmath, name)(point))
        assert holds(made.functions[name](number), expected)
    assert holds(made.functions["power"](number, made.number(2.5)), point**2.5)
    assert holds(made.functions["tan"](number * made.number(1 / 64)), float(mpmath.tan(mpmath.mpf(point) / 64)))


@given(st.floats(-2, 0), st.floats(0.001, 3), st.floats(0, 1), st.sampled_from([0.5, 1.0, 2.5, 20.0]))
def test_roots_and_powers_hold_those_of_the_part_that_is_not_negative(
    low: float, high: float, part: float, exponent: float
) -> None:
    made = arithmetic()
    number = between(low, high)
    point = high * part
    assert holds(made.functions["sqrt"](number), point**0.5)
    assert holds(made.functions["power"](number, made.number(exponent)), point**exponent)
    for value in (low, point):
        assert holds(made.functions["max"](number, made.number(0.0)), max(value, 0.0))
        assert holds(made.functions["min"](number, made.number(0.0)), min(value, 0.0))
        assert holds(abs(number), abs(value))


def test_a_comparison_that_ranges_leave_open_is_decided_by_what_the_numbers_share() -> None:
    decisions = Decisions()
    is_less = arithmetic(decisions).functions["is_less"]
    x = between(-1.0, 1.0)
    y = x + between(0.125, 0.25)
    assert x.range.overlaps(y.range)
    assert is_less(x, y) is True
    assert is_less(y, x) is False
    assert decisions.answers == []


def test_what_stays_open_is_asked_of_the_decisions() -> None:
    decisions = Decisions()
    functions = arithmetic(decisions).functions
    x, zero = between(-1.0, 1.0), arithmetic().number(0.0)
    for name in ("is_less", "is_less_or_equal", "is_equal", "is_greater", "is_greater_or_equal", "is_different"):
        outcomes = list(every_outcome(lambda name=name: functions[name](x, zero), decisions, 2))
        assert sorted(outcomes) == [False, True]
    assert sorted(every_outcome(lambda: functions["floor"](between(-0.5, 0.5)), decisions, 2)) == [-1, 0]
    assert functions["is_equal"](3, 3)
    assert not functions["is_less"](3, 3)


def test_certain_answers_are_given_only_where_ranges_are_apart() -> None:
    functions = arithmetic().functions
    low, high, both = between(-2.0, -1.0), between(1.0, 2.0), between(-3.0, 3.0)
    assert functions["certainly_less"](low, high)
    assert not functions["certainly_less"](high, low)
    assert not functions["certainly_less"](both, high)
    assert functions["certainly_zero"](arithmetic().number(0.0))
    assert not functions["certainly_zero"](both)
    assert functions["is_less"](high, functions["inf"])


def test_the_derivative_of_a_power_is_used_where_its_exponent_is_exact() -> None:
    made = arithmetic()
    x = between(1.0, 1.0 + 2**-10)
    power = made.functions["power"](x, made.number(8.0))
    ratio = power / x / x / x / x / x / x / x / x  # 1 but for rounding
    # Ranges alone would be 16 times as wide as x, 2^-7. Second order: each of 9 steps, 8 widths of x times one.
    assert float(enclosure(ratio).rad()) < 9 * 8 * 2.0**-20 + 20 * ROUNDOFF


def test_a_root_near_zero_is_as_wide_as_the_root_of_its_range() -> None:
    widths = []
    for exponent in (4, 8, 12):
        root = arithmetic().functions["sqrt"](between(0.0, 2.0**-exponent))
        widths.append(float(enclosure(root).rad()))
        assert holds(root, 0.0)
        assert holds(root, 2.0 ** (-exponent / 2))
    assert all(second < first for first, second in pairwise(widths))


def test_numbers_of_a_list_of_constants_are_each_its_own() -> None:
    constants = Behaviour(constants={"spread": [arb(0, 1), arb(0, 1)]}).with_numbers(arithmetic().functions["ball"])
    first, second = constants.constants["spread"]
    assert enclosure(first - first).rad() < 1e-6
    assert enclosure(first - second).rad() >= 2
