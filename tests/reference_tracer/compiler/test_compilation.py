"""Machine code does what Python does with the same text."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.compiler.types import Array
from tests.reference_tracer.compiler.programs import INTEGER, INTEGERS, MATH, NUMBER, NUMBERS, compiled, interpreted

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("ARI-12")

SMALL = st.integers(-9, 9)
CONTROL = """
LIMIT = 5

def swapped(a, b):
    a, b = b, a
    return a, b

def sign(a):
    if a > 0:
        return 1
    elif a < 0:
        return -1
    else:
        pass
    return 0

def part(a, b, c, place):
    vector = (a, b, c)
    return vector[place]

def nested(a, b):
    (c, d), e = swapped(a, b), a
    return c * 100 + d * 10 + e

def first_beyond(limit):
    for number in range(-LIMIT, LIMIT):
        if number > limit:
            return number
    return LIMIT

def run(a, b, c, results):
    results[0] = sign(a) + 10 * sign(b)
    results[1] = part(a, b, c, c % 3)
    results[2] = nested(a, b)
    results[3] = first_beyond(a)
    total = 0
    for i in range(abs_of(a)):
        for j in range(i, abs_of(b)):
            total += i - j
            i = j
    results[4] = total
    steps = 0
    while steps < abs_of(c) and not steps == LIMIT:
        steps += 1
        if steps == b:
            results[5] = steps
    results[6] = steps
    results[7] = a if a < b < c else b if a < c or b == c else c
    results[8] = a % 7 + 10 * (b // 3)
    results[9] = min(a, b) - max(b, c)
    left = a
    left -= b
    results[10] = -left
    results[11] = 1 if a and b else 0

def abs_of(a):
    return a if a >= 0 else -a
"""


@given(SMALL, SMALL, SMALL)
def test_branches_loops_and_whole_numbers_are_pythons(a: int, b: int, c: int) -> None:
    assert _results(CONTROL, (a, b, c)) == _results(CONTROL, (a, b, c), by_python=True)


def _results(text: str, arguments: tuple[int, ...], *, by_python: bool = False) -> list[int]:
    results = np.zeros(12, dtype=np.int64)
    _run(text, by_python)(*arguments, results)
    return list(map(int, results))


@cache
def _run(text: str, by_python: bool) -> Callable[..., None]:
    return interpreted(text) if by_python else compiled(text, INTEGER, INTEGER, INTEGER, INTEGERS)


STACK = """
def run(count, digits):
    waiting = [(0, 0.0)]
    for item in range(1, count):
        waiting.append((item, 0.5 * float(item)))
    while len(waiting) > 1:
        whole, half = waiting.pop()
        digits[0] = 10 * digits[0] + whole
        if half != 0.5 * float(whole):
            digits[0] = -1
"""


def test_what_was_put_on_a_stack_last_is_taken_first() -> None:
    digits = np.zeros(1, dtype=np.int64)
    compiled(STACK, INTEGER, INTEGERS, names={})(5, digits)
    assert digits[0] == 4321
    interpreted(STACK)(5, again := [0])
    assert again == [4321]


def test_a_stack_that_is_full_takes_no_more() -> None:
    run, digits = compiled(STACK, INTEGER, INTEGERS, names={}, capacity=4), np.zeros(1, dtype=np.int64)
    run(4, digits)
    with pytest.raises(MemoryError, match="deeper than any scene"):
        run(5, digits)


def test_a_variable_of_a_branch_that_was_not_taken_is_zero() -> None:
    text = "def run(a, results):\n    if a > 0.0:\n        b = 1.5\n    results[0] = b"
    results = np.ones(1)
    compiled(text, NUMBER, NUMBERS)(-1.0, results)
    assert results[0] == 0.0


GRID = """
def run(first, end, image):
    for row in range(first, end):
        for column in range(3):
            image[row, column, 0] = float(10 * row + column)
            image[row, column, 1] = -image[row, column, 0]
"""


def test_arrays_of_several_dimensions_are_written_where_they_are_read() -> None:
    image = np.zeros((4, 3, 2))
    expected = image.copy()
    compiled(GRID, INTEGER, INTEGER, Array(NUMBER, 3))(1, 4, image)
    interpreted(GRID)(1, 4, expected)
    assert image.tolist() == expected.tolist()
    assert image[3, 2].tolist() == [32.0, -32.0]


def test_only_contiguous_arrays_of_the_right_type_are_taken() -> None:
    run: Any = compiled("def run(numbers):\n    numbers[0] = 1.0", NUMBERS)
    run(np.zeros(3))
    for wrong in (np.zeros(3, dtype=np.float32), np.zeros((3, 1)), np.zeros(6)[::2]):
        with pytest.raises(TypeError, match="contiguous"):
            run(wrong)


@given(SMALL)
def test_a_name_that_is_given_replaces_a_function_of_the_text(value: int) -> None:
    text = "def shift(a):\n    return a + 1\ndef run(a, results):\n    results[0] = shift(a)"
    results = np.zeros(1, dtype=np.int64)
    for names, expected in ((MATH, value + 1), ({"shift": _doubled}, 2 * value)):
        compiled(text, INTEGER, INTEGERS, names=names)(value, results)
        assert results[0] == expected


def _doubled(a: int) -> int:
    return _FACTOR * a


_FACTOR = 2
