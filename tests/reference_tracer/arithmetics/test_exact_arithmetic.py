from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import mpmath
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.balls import ball_arithmetic
from raytruth.reference_tracer.arithmetics.exact_arithmetic import TANGENTS, ExactArithmetic
from raytruth.reference_tracer.arithmetics.exact_balls import ExactBall, exact_number, exact_sign, exact_value
from raytruth.reference_tracer.arithmetics.exact_values import ExactValues
from raytruth.reference_tracer.arithmetics.root_tower import NotExactError
from raytruth.reference_tracer.ties import RaisingDecisions, UndecidedComparisonError
from tests.reproduction import note_case

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.clause("ARI-3")


@pytest.fixture(autouse=True, scope="module")
def _precision() -> Iterator[None]:
    with ctx.workprec(128):
        yield


def arithmetic() -> ExactArithmetic:
    made = ExactArithmetic(RaisingDecisions())
    made.restart(10**6)
    return made


def ball(number: float) -> ExactBall:
    return ExactBall(arb(number))


def thirds(exact: ExactArithmetic, n: int) -> tuple[ExactBall, ExactBall]:
    """Two numbers made in two ways, both n/3 + √2, whose balls cannot tell."""
    root = exact.arithmetic.functions["sqrt"](ball(2.0))
    one = ball(float(n)) / ball(3.0) + root
    other = root - ball(float(-n)) / ball(3.0)
    return one, other


@given(st.integers(-9, 9), st.integers(-9, 9))
def test_comparisons_are_those_of_the_numbers(n: int, m: int) -> None:
    exact = arithmetic()
    table = exact.arithmetic.functions
    a, b = thirds(exact, n)[0], thirds(exact, m)[1]
    note_case(n=n, m=m)
    assert table["is_less"](a, b) == (n < m)
    assert table["is_less_or_equal"](a, b) == (n <= m)
    assert table["is_greater"](a, b) == (n > m)
    assert table["is_greater_or_equal"](a, b) == (n >= m)
    assert table["is_equal"](a, b) == (n == m)
    assert table["is_different"](a, b) == (n != m)
    for name in ("is_less", "is_less_or_equal", "is_equal"):
        assert table[name](n, m) == getattr(
            n, {"is_less": "__lt__", "is_less_or_equal": "__le__", "is_equal": "__eq__"}[name]
        )(m)


@pytest.mark.clause("ILL-9")
def test_what_is_not_a_number_is_neither_less_nor_equal_nor_greater() -> None:
    exact = arithmetic()
    table = exact.arithmetic.functions
    a, b = thirds(exact, 1)
    nothing = (a - b) / (b - a)
    for name in ("is_less", "is_less_or_equal", "is_greater", "is_greater_or_equal", "is_equal"):
        assert not table[name](nothing, ball(1.0))
    infinite = ball(1.0) / (a - b)
    with pytest.raises(UndecidedComparisonError):
        table["is_less"](infinite, ball(1.0))


def test_a_comparison_that_takes_too_much_work_is_left_to_the_decisions() -> None:
    exact = arithmetic()
    a, b = thirds(exact, 1)
    exact.restart(0)
    with pytest.raises(UndecidedComparisonError):
        exact.is_less(a * a, b * b)
    assert exact.work() > 0


@pytest.mark.parametrize("whole", [-3, 0, 4])
@pytest.mark.clause("TEX-2")
def test_the_floor_of_a_whole_number_is_itself_and_of_less_the_next(whole: int) -> None:
    exact = arithmetic()
    one, other = thirds(exact, 1)
    floor = exact.arithmetic.functions["floor"]
    assert floor(ball(float(whole)) + (one - other)) == whole
    tiny = ball(2.0**-126) * thirds(exact, 1)[0]
    assert floor(ball(float(whole)) + (one - other) - tiny) == whole - 1
    assert floor(ball(whole + 0.5)) == whole


def test_the_root_of_zero_is_zero_and_nothing_around_it() -> None:
    exact = arithmetic()
    one, other = thirds(exact, 2)
    root = exact.arithmetic.functions["sqrt"](one - other)
    assert (one - other).ball.rad() > 0
    assert root.ball == 0


def test_extremes_of_numbers_that_tie_are_worked_out() -> None:
    exact = arithmetic()
    table = exact.arithmetic.functions
    one, other = thirds(exact, 2)
    for name in ("min", "max"):
        assert table["is_equal"](table[name](one, other), one)
    assert table["min"](ball(1.0), ball(2.0)).ball == 1
    assert table["max"](ball(1.0), ball(2.0)).ball == 2
    assert table["is_equal"](abs(other - one - ball(1.0)), ball(1.0))
    assert table["is_equal"](-(one - other), ball(0.0))


@pytest.mark.clause("CAM-3")
@pytest.mark.parametrize("part", TANGENTS, ids=str)
def test_the_tangents_that_are_known_are_those_of_their_angles(part: Any) -> None:
    exact = arithmetic()
    degrees = 360 * part
    angle = ball(float(int(degrees.p)) / int(degrees.q)) * exact.pi / ball(360.0)
    found = exact.arithmetic.functions["tan"](angle)
    with mpmath.workprec(200):
        expected = mpmath.nstr(mpmath.tan(mpmath.pi * int(part.p) / int(part.q)), 50)
    assert abs(found.ball - arb(expected)) < 1e-30
    assert found.operation is not None


def test_another_tangent_is_a_symbol_that_equals_itself_alone() -> None:
    exact = arithmetic()
    table = exact.arithmetic.functions
    tangent = table["tan"](ball(40.0) * exact.pi / ball(360.0))
    assert abs(float(tangent.ball.mid()) - math.tan(math.radians(20.0))) < 1e-15
    assert table["is_equal"](ball(3.0) * tangent - tangent, tangent + tangent)
    assert not table["is_equal"](tangent * tangent, tangent)


def test_a_number_from_a_function_without_an_exact_form_is_not_known() -> None:
    exact = arithmetic()
    power = exact.arithmetic.functions["power"](ball(3.0), ball(0.3))
    with pytest.raises(NotExactError):
        exact_value(power, ExactValues(1000))
    assert exact_number(ball(-0.75)) == fmpq(-3, 4)
    assert exact_sign(ball(0.25), ball(0.5), ExactValues(1000)) == -1


def test_it_offers_what_ball_arithmetic_does() -> None:
    with ctx.workprec(128):
        assert arithmetic().arithmetic.functions.keys() == ball_arithmetic(128, RaisingDecisions()).functions.keys()
