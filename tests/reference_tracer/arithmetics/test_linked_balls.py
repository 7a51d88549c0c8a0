from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import assume, event, given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.balls import Decisions
from raytruth.reference_tracer.arithmetics.linked_arithmetic import linked_arithmetic
from raytruth.reference_tracer.arithmetics.linked_balls import (
    LinkedBall,
    condensed,
    difference,
    enclosure,
    with_own_symbol,
)
from tests.reference_tracer.kernels import kept_precision, put_in_force

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

pytestmark = pytest.mark.clause("ARI-4")

BITS = 24
"""Of float32, which is what the enclosures are held against."""

NUMBERS = st.floats(-100, 100, width=32).filter(lambda x: abs(x) > 1e-3)
# A program: each step takes an operation and which two of the numbers so far it is done on.
STEPS = st.lists(
    st.tuples(
        st.sampled_from(["+", "-", "*", "/", "sqrt", "min", "max", "abs"]), st.integers(0, 99), st.integers(0, 99)
    ),
    min_size=1,
    max_size=12,
)


@pytest.fixture(autouse=True, scope="module")
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def arithmetic() -> Any:
    return put_in_force(linked_arithmetic(BITS, Decisions()))


def run(operations: dict[str, Any], steps: list[tuple[str, int, int]], inputs: list[Any]) -> list[Any]:
    """The inputs, and the result of each step."""
    numbers = list(inputs)
    for name, first, second in steps:
        operation = operations[name]
        operands = [numbers[place % len(numbers)] for place in (first, second)][: 1 if name in UNARY else 2]
        numbers.append(operation(*operands))
    return numbers


UNARY = ("sqrt", "abs")
OPERATORS = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "abs": abs}


def run_linked(table: Any, steps: list[tuple[str, int, int]], inputs: list[LinkedBall]) -> list[LinkedBall]:
    functions = {"min": table["min"], "max": table["max"], "sqrt": lambda a: table["sqrt"](abs(a))}
    return run(OPERATORS | functions, steps, inputs)


def run_floats(steps: list[tuple[str, int, int]], inputs: list[Any]) -> list[Any]:
    with np.errstate(all="ignore"):
        return run(OPERATORS | {"min": min, "max": max, "sqrt": lambda a: np.sqrt(abs(a))}, steps, inputs)


def is_normal(value: np.float32) -> bool:
    """Finite, and 0 or far from where float32 rounds to a fixed number of places."""
    return bool(np.isfinite(value) and (value == 0 or abs(value) > 1e-30))


@given(STEPS, st.lists(NUMBERS, min_size=2, max_size=4))
def test_whatever_float32_computes_lies_in_the_enclosure_and_in_the_range(
    steps: list[tuple[str, int, int]], values: list[float]
) -> None:
    singles = run_floats(steps, [np.float32(value) for value in values])
    assume(all(is_normal(value) for value in singles))
    assert all(isinstance(value, np.float32) for value in singles)
    made = arithmetic()
    linked = run_linked(made.functions, steps, [made.number(value) for value in values])
    for number, single in zip(linked, singles, strict=True):
        for ball in (number.range, enclosure(number)):
            assert not ball.is_finite() or ball.contains(arb(float(single))), (steps, [v.hex() for v in values])


def with_own_symbols(numbers: list[LinkedBall]) -> list[LinkedBall]:
    return [with_own_symbol(number) for number in numbers]


@pytest.mark.parametrize("shortened", [condensed, with_own_symbols])
@given(before=STEPS, after=STEPS, values=st.lists(NUMBERS, min_size=2, max_size=3))
def test_float32_stays_inside_when_the_numbers_are_condensed_on_the_way(
    shortened: Callable[[list[LinkedBall]], list[LinkedBall]],
    before: list[tuple[str, int, int]],
    after: list[tuple[str, int, int]],
    values: list[float],
) -> None:
    singles = run_floats(before, [np.float32(value) for value in values])
    later = run_floats(after, singles)
    assume(all(is_normal(value) for value in later))
    made = arithmetic()
    linked = shortened(run_linked(made.functions, before, [made.number(value) for value in values]))
    event(f"bounded: {all(number.range.is_finite() for number in linked)}")
    for number, single in zip(run_linked(made.functions, after, linked), later, strict=True):
        ball = enclosure(number)
        assert not ball.is_finite() or ball.contains(arb(float(single))), (before, after, [v.hex() for v in values])


@given(NUMBERS, NUMBERS)
def test_an_error_that_two_numbers_share_counts_once(x: float, y: float) -> None:
    made = arithmetic()
    number = made.number
    total = number(x) + number(y)  # rounded once
    twice_less = total + total - total - total
    width = float(enclosure(twice_less).rad())
    # The error of the first sum cancels; what stays are the roundings of 2s, 2s - s and of the end.
    assert width <= 5 * abs(x + y) * 2.0**-BITS
    forgotten = total.range + total.range - total.range - total.range
    assume(x + y != 0)
    assert float(forgotten.rad()) >= 4 * abs(x + y) * 2.0**-BITS
    # Second order: the range of the difference is known to 2 roundoffs, of which the last operation may add one.
    assert float(enclosure(total - total).rad()) <= 5 * abs(x + y) * 2.0 ** (-2 * BITS)
    assert difference(total, total).contains(0)


@given(NUMBERS, NUMBERS, NUMBERS)
def test_a_number_with_its_own_symbol_keeps_its_links_and_shares_its_rounding(x: float, y: float, z: float) -> None:
    # A distance of which little is known leaves a point on the line that it is measured along.
    made = arithmetic()
    start, error = made.number(x), made.functions["ball"](arb(y, 0.01))
    (start, error) = condensed([start, error])
    distance = with_own_symbol(start * error + made.functions["ball"](arb(z, 0.001)))
    there, back = start + distance, start - distance
    assert float(enclosure(distance).rad()) > 0.001
    # Four sums are rounded, none of them above twice these numbers, of which one is known to 0.01 of x and more.
    roundings = 4 * 2 * (1.1 * abs(x) + abs(x * y) + abs(z)) * 2.0**-BITS
    assert float(difference(there + back, start + start).rad()) <= roundings
    assert float(difference(distance, start * error).rad()) < 0.0011 + roundings


def test_a_rotation_repeated_a_hundred_times_grows_the_error_in_proportion() -> None:
    # Intervals wrap: they grow by cos + sin = 1.4 each time, to 1e14 times their size.
    made = arithmetic()
    x, y = made.number(1.0), made.number(0.5)
    cosine = sine = made.functions["sqrt"](made.number(0.5))
    for _ in range(100):
        x, y = condensed([cosine * x - sine * y, sine * x + cosine * y])
    bound = float(enclosure(x).rad())
    assert 2.0**-BITS < bound < 2000 * 2.0**-BITS
    assert enclosure(x).contains(x.center)


@pytest.mark.parametrize("bits", [11, 24, 53])
@given(value=st.floats(1e-6, 1e6))
def test_the_width_is_a_roundoff_an_operation_in_every_precision(bits: int, value: float) -> None:
    made = put_in_force(linked_arithmetic(bits, Decisions()))
    root = made.functions["sqrt"](made.number(value))
    unit = 2.0**-bits
    radius = float(enclosure(root).rad())
    assert radius <= 1.51 * unit * value**0.5  # half a stored roundoff and one of the root
    assert radius >= 0.99 * unit * value**0.5
    assert ctx.prec > bits
