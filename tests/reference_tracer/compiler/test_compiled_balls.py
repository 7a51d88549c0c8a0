"""Balls of one float, whose functions are compiled as they stand: machine code gives the bits that Python gives."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.reference_tracer.arithmetics import float_ball_comparisons, float_ball_functions, float_balls
from raytruth.reference_tracer.arithmetics.float_balls import Ball
from raytruth.reference_tracer.compiler.types import Array, Tuple
from tests.reference_tracer.arithmetics.ball_draws import SPECIAL_BALLS, drawn_balls, drawn_roundoffs
from tests.reference_tracer.compiler.programs import INTEGERS, NUMBER, compiled

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("ARI-11", "ARI-12")

OF_TWO = {
    "add": float_balls.add,
    "sub": float_balls.sub,
    "mul": float_balls.mul,
    "truediv": float_balls.truediv,
    "power": float_ball_functions.power,
}
OF_ONE = {
    "sqrt": float_balls.sqrt,
    "exp": float_ball_functions.exp,
    "tan": float_ball_functions.tan,
}
WITHOUT_ROUNDOFF = {
    "absolute": float_balls.absolute,
    "maximum": float_ball_comparisons.maximum,
    "minimum": float_ball_comparisons.minimum,
    "less": float_ball_comparisons.less,
    "equal": float_ball_comparisons.equal,
    "floor": float_ball_comparisons.floor,
}
CALLS = (
    *(f"{name}(a, b, roundoff)" for name in OF_TWO),
    *(f"{name}(a, roundoff)" for name in OF_ONE),
    *("absolute(a)", "maximum(a, b)", "minimum(a, b)"),
)
TEXT = (
    "def run(a, b, roundoff, results, wholes):\n"
    + "".join(f"    results[{place}] = {call}\n" for place, call in enumerate(CALLS))
    + "    wholes[0] = less(a, b)\n    wholes[1] = equal(a, b)\n"
    + "    below = floor(a)\n    wholes[2] = below.lowest\n    wholes[3] = 1 if below.is_one else 0\n"
)
NAMES = OF_TWO | OF_ONE | WITHOUT_ROUNDOFF
BALL = Tuple((NUMBER, NUMBER), Ball._fields, Ball.__name__)


@pytest.fixture(scope="module")
def run() -> Callable[..., None]:
    return compiled(TEXT, BALL, BALL, NUMBER, Array(BALL), INTEGERS, names=NAMES)


def test_compiled_balls_are_those_of_python_bit_for_bit(run: Callable[..., None]) -> None:
    special = [(a, b) for a in SPECIAL_BALLS for b in SPECIAL_BALLS]
    drawn = list(zip(drawn_balls(1, 1000), drawn_balls(2, 1000), strict=True))
    pairs = [*special, *drawn]
    for (a, b), roundoff in zip(pairs, drawn_roundoffs(3, len(pairs)), strict=True):
        results, wholes = np.zeros((len(CALLS), 2)), np.zeros(4, dtype=np.int64)
        run(a, b, roundoff, results, wholes)
        expected = np.array([eval(call, NAMES | {"a": a, "b": b, "roundoff": roundoff}) for call in CALLS])
        same = (results.view(np.int64) == expected.view(np.int64)) | (np.isnan(results) & np.isnan(expected))
        assert same.all(), (a, b, roundoff, [CALLS[place] for place in np.flatnonzero(~same.all(axis=1))])
        below = float_ball_comparisons.floor(a)
        whole = [float_ball_comparisons.less(a, b), float_ball_comparisons.equal(a, b), below.lowest, below.is_one]
        assert wholes.tolist() == whole, (a, b)
