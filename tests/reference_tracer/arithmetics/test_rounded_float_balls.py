"""The tables of compiled feasible sets, of floats and double-doubles: each operation holds what Arb says, rounded."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.compilation import number_type
from raytruth.reference_tracer.arithmetics.float_ball_comparisons import UNDECIDED
from raytruth.reference_tracer.arithmetics.rounded_double_doubles import ROUNDED_DOUBLE_DOUBLES
from raytruth.reference_tracer.arithmetics.rounded_float_balls import ROUNDED_FLOAT_BALLS, answered
from raytruth.reference_tracer.arithmetics.scripted_decisions import DECISIONS, RECORDED, decisions_memory
from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.reference_tracer.arithmetics.scripted_decisions import ScriptedDecisions

pytestmark = pytest.mark.clause("ARI-11", "ARI-12")

TEXT = """
def run(a, b, results, wholes):
    results[0] = a + b
    results[1] = a - b
    results[2] = a * b
    results[3] = a / b
    results[4] = sqrt(abs(a))
    results[5] = exp(a)
    results[6] = power(abs(a), abs(b))
    results[7] = -a
    results[8] = max(a, b)
    results[9] = min(a, b)
    wholes[0] = 1 if a < b else 0
    wholes[1] = 1 if a <= b else 0
    wholes[2] = 1 if a == b else 0
    wholes[3] = floor(a)
"""


class State(NamedTuple):
    roundoff: float
    decisions: ScriptedDecisions


STATE = Tuple((Float(64), DECISIONS), State._fields, State.__name__)
# By Arb, of points: what an operation that errs by the roundoff may give lies around these.
EXACT: list[Callable[[Any, Any], Any]] = [
    lambda a, b: a + b,
    lambda a, b: a - b,
    lambda a, b: a * b,
    lambda a, b: a / b,
    lambda a, _: abs(a).sqrt(),
    lambda a, _: a.exp(),
    lambda a, b: abs(a) ** abs(b),
]
UNROUNDED: list[Callable[[Any, Any], Any]] = [
    lambda a, _: -a,
    lambda a, b: a.max(b),
    lambda a, b: a.min(b),
]
NUMBERS = st.floats(0.01, 30.0) | st.floats(-30.0, -0.01)


@pytest.fixture(scope="module", params=[ROUNDED_FLOAT_BALLS, ROUNDED_DOUBLE_DOUBLES], ids=["floats", "double-doubles"])
def table(request: pytest.FixtureRequest) -> tuple[Arithmetic, Callable[..., None]]:
    arithmetic: Arithmetic = request.param
    number = number_type(arithmetic)
    kinds = (number, number, Array(number), Array(Integer()))
    program = Program(TEXT, "text of a test", arithmetic.functions, {"run": kinds}, arithmetic.operations, 1, STATE)
    return arithmetic, program.compiled()["run"]


def run(table: Any, a: float, b: float, roundoff: float, radius: float = 0.0) -> tuple[list[Any], list[int], int]:
    """The results as Arb's balls, the answers, and how many of these were asked of the decisions."""
    arithmetic, function = table
    results = arithmetic.image(len(EXACT) + len(UNROUNDED))
    wholes, decisions = np.zeros(4, dtype=np.int64), decisions_memory()
    zero = arithmetic.number(0.0)
    first = type(zero)(a, *zero[1:-1], radius)
    function(State(roundoff, decisions), first, arithmetic.number(b), results, wholes)
    balls = [sum(map(arb, parts[:-1]), arb(0)) + arb(0, parts[-1]) for parts in results.tolist()]
    return balls, wholes.tolist(), int(decisions.counts[RECORDED])


@given(NUMBERS, NUMBERS, st.sampled_from((2.0**-11, 2.0**-24, 2.0**-51)), st.sampled_from((-1, 0, 1)))
def test_each_operation_holds_what_a_rounded_one_may_give(
    table: Any, a: float, b: float, roundoff: float, side: int
) -> None:
    with ctx.workprec(400):
        balls, wholes, asked = run(table, a, b, roundoff)
        for function, ball in zip(EXACT, balls, strict=False):
            value = function(arb(a), arb(b)) * (1 + side * arb(roundoff))
            assert ball.contains(value)
            assert ball.rad() < 64 * arb(roundoff) * (1 + abs(value))
        for function, ball in zip(UNROUNDED, balls[len(EXACT) :], strict=True):
            assert ball == function(arb(a), arb(b))
        assert wholes == [int(a < b), int(a <= b), int(a == b), int(arb(a).floor().unique_fmpz())]
        assert asked == 0


def test_what_balls_leave_open_is_asked_of_the_decisions(table: Any) -> None:
    _, wholes, asked = run(table, 3.0, 3.0, 0.0, radius=0.5)
    assert wholes == [1, 1, 1, 3]  # the first of both answers is yes
    assert asked == 4


def test_an_answer_that_is_known_asks_nothing() -> None:
    assert answered(1)
    assert not answered(0)
    with pytest.raises(NotImplementedError):
        answered(UNDECIDED)
