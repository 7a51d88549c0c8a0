"""Numbers that are NamedTuples of floats: operators are the functions of their arithmetic."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT64, Arithmetic
from raytruth.reference_tracer.compiler.questions import UNDECIDED, UndecidedError, marks_taken, undecided
from raytruth.reference_tracer.compiler.types import Array, Tuple
from raytruth.reference_tracer.rendering import first_hits, prepare, render
from tests.reference_tracer.compiler.programs import INTEGER, INTEGERS, NUMBER, compiled
from tests.reference_tracer.small_scenes import library_scene

pytestmark = pytest.mark.clause("ARI-12", "ARI-3")


class Interval(NamedTuple):
    """All numbers from one to another, both moved outward by far more than rounding."""

    low: float
    high: float


WIDER = 1e-14


def number(value: float) -> Interval:
    return Interval(value, value)


def from_integer(value: int) -> Interval:
    return Interval(float(value), float(value))


def outward(low: float, high: float) -> Interval:
    return Interval(low - WIDER * abs(low), high + WIDER * abs(high))


def add(a: Interval, b: Interval) -> Interval:
    return outward(a.low + b.low, a.high + b.high)


def neg(a: Interval) -> Interval:
    return Interval(-a.high, -a.low)


def sub(a: Interval, b: Interval) -> Interval:
    return add(a, neg(b))


def mul(a: Interval, b: Interval) -> Interval:
    p, q, r, s = a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high
    return outward(min(p, q, r, s), max(p, q, r, s))


def truediv(a: Interval, b: Interval) -> Interval:
    if b.low <= 0.0 and b.high >= 0.0:
        return Interval(-math.inf, math.inf)
    return mul(a, outward(1.0 / b.high, 1.0 / b.low))


def root(a: Interval) -> Interval:
    return outward(math.sqrt(max(a.low, 0.0)), math.sqrt(max(a.high, 0.0)))


def lt(a: Interval, b: Interval) -> bool:
    if a.high < b.low:
        return True
    if a.low >= b.high:
        return False
    return undecided()


def le(a: Interval, b: Interval) -> bool:
    return not lt(b, a)


def eq(a: Interval, b: Interval) -> bool:
    if a.low == a.high and b.low == b.high:
        return a.low == b.low
    return undecided() if le(a, b) and le(b, a) else False


def larger(a: Interval, b: Interval) -> Interval:
    return Interval(max(a.low, b.low), max(a.high, b.high))


def smaller(a: Interval, b: Interval) -> Interval:
    return Interval(min(a.low, b.low), min(a.high, b.high))


def certainly_less(a: Interval, b: Interval) -> bool:
    return a.high < b.low


def certainly_zero(a: Interval) -> bool:
    return a.low == a.high == 0.0


def whole_number_below(a: Interval) -> int:
    lowest = math.floor(a.low)
    if lowest == math.floor(a.high):
        return lowest
    return lowest if undecided() else lowest + 1


def tangent(a: Interval) -> Interval:
    return outward(math.tan(a.low), math.tan(a.high))


INTERVALS = Arithmetic(
    "intervals",
    number,
    {
        "certainly_less": certainly_less,
        "certainly_zero": certainly_zero,
        "float": from_integer,
        "floor": whole_number_below,
        "inf": number(math.inf),
        "max": larger,
        "min": smaller,
        "pi": outward(math.pi, math.pi),
        "sqrt": root,
        "tan": tangent,
    },
    compiled=True,
    decided_comparisons=True,
    operations={
        **{"add": add, "sub": sub, "mul": mul, "truediv": truediv, "neg": neg},
        **{"lt": lt, "le": le, "eq": eq},
    },
)
KIND = Tuple((NUMBER, NUMBER), ("low", "high"), "Interval")
FORMULA = """
def run(a, b, results):
    results[0] = a * b - a / (b + one) + 3 * a
    results[1] = -a
"""


@given(st.floats(-9.0, 9.0), st.floats(0.0, 9.0))
def test_operators_on_named_tuples_are_the_functions_of_the_table(a: float, b: float) -> None:
    table = INTERVALS.operations | {"float": from_integer}
    x, y, one = number(a), number(b), number(1.0)
    results = np.zeros((2, 2))
    compiled(FORMULA, KIND, KIND, Array(KIND), names={"one": one}, operations=table)(x, y, results)
    expected = add(sub(mul(x, y), truediv(x, add(y, one))), mul(from_integer(3), x))
    assert results.tolist() == [list(expected), list(neg(x))]


@pytest.mark.parametrize("name", ["single-sphere", "mirror-icosahedron", "trefoil-knot", "cornell-box"])
def test_a_kernel_in_intervals_encloses_the_floats(name: str) -> None:
    scene = library_scene(name, 4, 3)
    image, floats = render(scene, INTERVALS), render(scene, FLOAT64)
    assert image.shape == (3, 4, 3, 2)
    assert (image[..., 0] <= floats).all()
    assert (floats <= image[..., 1]).all()
    assert (image[..., 1] - image[..., 0] < 1e-6).all()
    for found, expected in zip(first_hits(prepare(scene, INTERVALS)), first_hits(prepare(scene, FLOAT64)), strict=True):
        assert (found == expected).all() if found.ndim == 2 else (found[..., 0] <= expected).all()


QUESTIONS = """
def run(a, b, results, marks):
    results[0] = 1 if a < b else 0
    marks[0] = marks_taken()
    results[1] = 1 if b < a else 0
    results[2] = 1 if a >= b else 0
    results[3] = 1 if a != b else 0
    results[4] = 1 if a == b else 0
    if ask:
        marks[1] = marks_taken()
"""


def test_an_undecided_comparison_marks_the_call_and_a_decided_one_does_not() -> None:
    names = {"marks_taken": marks_taken, "ask": True}
    run = compiled(QUESTIONS, KIND, KIND, INTEGERS, INTEGERS, names=names, operations=INTERVALS.operations)
    marks, results = np.zeros(2, dtype=np.int64), np.zeros(5, dtype=np.int64)
    run(Interval(1.0, 2.0), Interval(3.0, 4.0), results, marks)
    assert results.tolist() == [1, 0, 0, 1, 0]
    assert marks.tolist() == [0, 0]
    run(Interval(1.0, 3.5), Interval(3.0, 4.0), results, marks)
    assert marks.tolist() == [UNDECIDED, UNDECIDED]


def test_an_undecided_comparison_that_nobody_asked_about_is_an_error() -> None:
    names = {"marks_taken": marks_taken, "ask": False}
    run = compiled(QUESTIONS, KIND, KIND, INTEGERS, INTEGERS, names=names, operations=INTERVALS.operations)
    marks, results = np.zeros(2, dtype=np.int64), np.zeros(5, dtype=np.int64)
    run(Interval(1.0, 2.0), Interval(3.0, 4.0), results, marks)
    with pytest.raises(UndecidedError):
        run(Interval(1.0, 3.5), Interval(3.0, 4.0), results, marks)
    with pytest.raises(UndecidedError):
        lt(Interval(1.0, 3.5), Interval(3.0, 4.0))


def test_parts_of_named_tuples_are_read_by_their_names() -> None:
    text = "def run(a, i, results):\n    results[i] = a.high\n    results[i + 1] = a[0]"
    results = np.zeros(3)
    compiled(text, KIND, INTEGER, Array(NUMBER))(Interval(1.0, 2.0), 1, results)
    assert results.tolist() == [0.0, 2.0, 1.0]
