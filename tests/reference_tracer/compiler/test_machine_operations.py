"""Every operation on floats gives the bits that IEEE 754 and Python have for it, at the edges too."""

from __future__ import annotations

import math
from functools import cache
from random import Random
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.compiler.types import Array, Float
from tests.reference_tracer.compiler.programs import INTEGERS, MATH, NUMBER, compiled

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("ARI-12", "ARI-1")

RESULTS = {
    "a + b": lambda a, b: a + b,
    "a - b": lambda a, b: a - b,
    "a * b": lambda a, b: a * b,
    "a / b": lambda a, b: a / b,
    "-a": lambda a, b: -a,  # noqa: ARG005 - as the others
    "abs(a)": lambda a, b: abs(a),  # noqa: ARG005 - as the others
    "max(a, b)": lambda a, b: max(a, b),  # noqa: PLW0108 - as the others
    "min(a, b)": lambda a, b: min(a, b),  # noqa: PLW0108 - as the others
    "sqrt(abs(a))": lambda a, b: np.sqrt(abs(a)),  # noqa: ARG005 - as the others
    "a * a + b": lambda a, b: a * a + b,  # contracted, it would be rounded once
    "a if a < b else b": lambda a, b: a if a < b else b,
    "a if a <= b else b": lambda a, b: a if a <= b else b,
    "a if a == b else -b": lambda a, b: a if a == b else -b,
    "a if a != b else -b": lambda a, b: a if a != b else -b,
    "a if a > b else b": lambda a, b: a if a > b else b,
    "a if a >= b else b": lambda a, b: a if a >= b else b,
}
TEXT = "def run(a, b, results):\n" + "".join(
    f"    results[{place}] = {expression}\n" for place, expression in enumerate(RESULTS)
)
EDGES = (0.0, -0.0, 1.0, -1.0, math.inf, -math.inf, math.nan, 2.0**-149, 2.0**-126, 2.0**-1074)
NUMBERS_64 = st.floats() | st.sampled_from(EDGES)


@cache
def _run(bits: int) -> Callable[..., None]:
    kind = Float(bits)
    return compiled(TEXT, kind, kind, Array(kind), names=MATH)


@given(NUMBERS_64, NUMBERS_64)
def test_operations_on_float64_give_the_bits_of_ieee_754(a: float, b: float) -> None:
    _compare(64, np.float64(a), np.float64(b))


@given(st.floats(width=32), st.floats(width=32))
def test_operations_on_float32_give_the_bits_of_ieee_754(a: float, b: float) -> None:
    _compare(32, np.float32(a), np.float32(b))


def test_a_product_is_rounded_before_it_is_added_to() -> None:
    """Which matters to most numbers, but not to those of few digits that hypothesis prefers."""
    random = Random(1)
    for _ in range(50):
        a, b = random.uniform(0.5, 1.0), random.uniform(0.5, 1.0)
        _compare(64, np.float64(a), np.float64(b))
        _compare(32, np.float32(a), np.float32(b))


def _compare(bits: int, a: Any, b: Any) -> None:
    results = np.zeros(len(RESULTS), dtype=type(a))
    _run(bits)(float(a), float(b), results)
    with np.errstate(all="ignore"):
        expected = np.array([result(a, b) for result in RESULTS.values()], dtype=type(a))
    for expression, found, wanted in zip(RESULTS, results, expected, strict=True):
        assert (np.isnan(found) and np.isnan(wanted)) or found.tobytes() == wanted.tobytes(), expression


LIBRARY = """
def run(a, b, results, wholes):
    results[0] = exp(a)
    results[1] = tan(a)
    results[2] = abs(a) ** b
    wholes[0] = floor(a)
"""


@given(st.floats(-700.0, 700.0), st.floats(0.0, 30.0))
def test_the_mathematical_library_is_the_one_that_python_calls(a: float, b: float) -> None:
    results, wholes = np.zeros(3), np.zeros(1, dtype=np.int64)
    _library()(a, b, results, wholes)
    assert results.tolist() == [math.exp(a), math.tan(a), abs(a) ** b]
    assert wholes[0] == math.floor(a)


@cache
def _library() -> Callable[..., None]:
    return compiled(LIBRARY, NUMBER, NUMBER, Array(NUMBER), INTEGERS)


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan, 2.0**63, -(2.0**64)])
def test_the_whole_number_below_what_has_none_of_64_bits_is_even(value: float) -> None:
    results, wholes = np.zeros(3), np.ones(1, dtype=np.int64)
    _library()(value, 1.0, results, wholes)
    assert wholes[0] == -(2**63)


def test_the_largest_and_least_whole_numbers_of_floats_are_found() -> None:
    results, wholes = np.zeros(3), np.zeros(1, dtype=np.int64)
    for value in (math.nextafter(2.0**63, 0.0), -(2.0**62), -0.5, 0.5):
        _library()(value, 1.0, results, wholes)
        assert wholes[0] == math.floor(value)
