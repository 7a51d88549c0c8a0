"""The compiled truth's table: each operation, as machine code, is the plain function's, and holds what is exact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.compilation import number_type
from raytruth.reference_tracer.arithmetics.double_double_balls import DoubleDoubleBall
from raytruth.reference_tracer.arithmetics.truth_arithmetic import TRUTH_ARITHMETIC, double_double_of
from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.questions import UNDECIDED, UndecidedError, marks_taken
from raytruth.reference_tracer.compiler.types import Array, Integer

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("ARI-11", "ARI-12")

TEXT = """
def run(a, b, results, wholes):
    results[0] = a + b
    results[1] = a - b
    results[2] = a * b
    results[3] = a / b
    results[4] = -a
    results[5] = sqrt(abs(a))
    results[6] = max(a, b)
    results[7] = min(a, b)
    results[8] = exp(a)
    results[9] = abs(a) ** float(3)
    results[10] = abs(a) ** abs(b)
    results[11] = a * inf
    wholes[0] = marks_taken()
    wholes[1] = 1 if a < b else 0
    wholes[2] = 1 if a <= b else 0
    wholes[3] = 1 if a == b else 0
    wholes[4] = 1 if certainly_less(a, b) else 0
    wholes[5] = 1 if certainly_zero(a) else 0
    wholes[6] = floor(a)
    wholes[7] = marks_taken()
"""
NUMBER = number_type(TRUTH_ARITHMETIC)
KINDS = (NUMBER, NUMBER, Array(NUMBER), Array(Integer()))
NAMES = {**TRUTH_ARITHMETIC.functions, "marks_taken": marks_taken}


@pytest.fixture(scope="module")
def run() -> Callable[..., None]:
    return Program(TEXT, "text of a test", NAMES, {"run": KINDS}, TRUTH_ARITHMETIC.operations).compiled()["run"]


def by_python(a: DoubleDoubleBall, b: DoubleDoubleBall) -> list[DoubleDoubleBall]:
    does, calls = TRUTH_ARITHMETIC.operations, TRUTH_ARITHMETIC.functions
    size = does["abs"](a)
    return [
        *(does[name](a, b) for name in ("add", "sub", "mul", "truediv")),
        does["neg"](a),
        calls["sqrt"](size),
        *(calls[name](a, b) for name in ("max", "min")),
        calls["exp"](a),
        does["pow"](size, calls["float"](3)),
        does["pow"](size, does["abs"](b)),
        does["mul"](a, calls["inf"]),
    ]


def decided_by_python(function: Any, *balls: DoubleDoubleBall) -> int | None:
    try:
        return int(function(*balls))
    except UndecidedError:
        return None


BALLS = st.builds(
    lambda high, part, radius: DoubleDoubleBall(high, part * math.ulp(high) / 2.0, radius * abs(high)),
    st.floats(-1e9, 1e9) | st.sampled_from([0.0, 1.0, -2.0, 3.0]),
    st.floats(-1.0, 1.0) | st.just(0.0),
    st.sampled_from([0.0, 1e-30, 1e-3, 2.0]),
)


@given(BALLS, BALLS)
def test_machine_code_gives_the_bits_of_the_plain_functions(
    run: Callable[..., None], a: DoubleDoubleBall, b: DoubleDoubleBall
) -> None:
    results, wholes = np.zeros((12, 3)), np.zeros(8, dtype=np.int64)
    run(a, b, results, wholes)
    expected = np.array(by_python(a, b))
    same = (results == expected) | (np.isnan(results) & np.isnan(expected))
    assert same.all(), np.argwhere(~same)
    does, calls = TRUTH_ARITHMETIC.operations, TRUTH_ARITHMETIC.functions
    answers = [decided_by_python(does[name], a, b) for name in ("lt", "le", "eq")]
    answers.extend([int(calls["certainly_less"](a, b)), int(calls["certainly_zero"](a))])
    answers.append(decided_by_python(calls["floor"], a))
    assert wholes[0] == 0
    assert wholes[7] == (UNDECIDED if None in answers else 0)
    for found, answer in zip(wholes[1:7], answers, strict=True):
        assert answer is None or found == answer


@given(st.integers(-(10**40), 10**40), st.integers(1, 10**40))
def test_a_double_double_ball_of_arbs_ball_holds_it_and_hardly_more(dividend: int, divisor: int) -> None:
    with ctx.workprec(128):
        ball = arb(dividend) / divisor
    found = double_double_of(ball)
    with ctx.workprec(300):
        distance = abs(ball - arb(found.high) - arb(found.low))
        assert distance <= arb(found.radius)
    assert found.radius <= 2.0**-104 * abs(found.high)
    assert abs(found.low) <= math.ulp(found.high) / 2.0


@pytest.mark.parametrize("value", [0.0, 1.5, math.inf, 2.0**-1074])
def test_what_is_a_float_stays_one(value: float) -> None:
    assert double_double_of(arb(value)) == DoubleDoubleBall(value, 0.0, 0.0)


def test_pi_is_held_closely() -> None:
    with ctx.workprec(300):
        pi = TRUTH_ARITHMETIC.functions["pi"]
        assert abs(arb.pi() - arb(pi.high) - arb(pi.low)) <= arb(pi.radius)
    assert 0.0 < pi.radius <= 2.0**-105
