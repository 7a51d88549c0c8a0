"""The tracer's source in every arithmetic, with all features: for tests of single functions."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb, ctx

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, INTERPRETED_FLOAT32, Arithmetic, make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, ball_arithmetic
from raytruth.reference_tracer.source.scene_data import NUMBER_OF_TABLES, SceneData
from raytruth.scenes.features import Feature

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from raytruth.reference_tracer.arithmetics.kernel import Kernel


def exact_root(x: Fraction) -> Fraction:
    """The square root of the square of a rational number; raises ValueError for any other number."""
    root = Fraction(math.isqrt(x.numerator), math.isqrt(x.denominator))
    if root * root != x:
        raise ValueError(f"{x} has no rational root")
    return root


def _unavailable(*_: object) -> Fraction:
    raise ValueError("a transcendental function of a rational number is not rational")


EXACT = Arithmetic(
    "fractions",
    Fraction,
    {"sqrt": exact_root, "tan": _unavailable, "exp": _unavailable, "pi": Fraction(math.pi)},
)
"""Rational numbers: no rounding at all. Infinity stays a float, which compares rightly."""


@cache
def float_kernel() -> Kernel:
    return make_kernel(FLOAT, set(Feature))


@cache
def exact_kernel() -> Kernel:
    return make_kernel(EXACT, set(Feature))


@cache
def numpy_kernel(number: Callable[[float], Any]) -> Kernel:
    """For NumPy's float64 or float32, interpreted: rounds as compiled code does, and divides by zero without error."""
    if number is np.float32:
        return make_kernel(INTERPRETED_FLOAT32, set(Feature))
    functions = {"sqrt": np.sqrt, "floor": np.floor, "exp": np.exp, "inf": number(math.inf), "pi": number(math.pi)}
    return make_kernel(Arithmetic(f"interpreted {number}", number, functions), set(Feature))


def ball_kernel(precision_bits: int) -> tuple[Kernel, Decisions]:
    """Sets the precision of the process: use it within `kept_precision`."""
    decisions = Decisions()
    return make_kernel(put_in_force(ball_arithmetic(precision_bits, decisions)), set(Feature)), decisions


def put_in_force(arithmetic: Arithmetic) -> Arithmetic:
    """For all that follows, with no need to indent it: sets the precision of the process, as above."""
    with arithmetic.in_force():
        precision = ctx.prec
    ctx.prec = precision
    return arithmetic


def kept_precision() -> Iterator[None]:
    """The body of a fixture: puts the precision of balls back after the test."""
    before = ctx.prec
    yield
    ctx.prec = before


def fractions_of(value: Any) -> Any:
    """The exact values of floats, within tuples too."""
    return tuple(map(fractions_of, value)) if isinstance(value, tuple) else Fraction(value)


def balls_of(value: Any) -> Any:
    return tuple(map(balls_of, value)) if isinstance(value, tuple) else arb(value)


def holds(ball: Any, exact: Fraction) -> bool:
    """Whether a ball contains a rational number; False is certain only up to the precision of balls."""
    return bool((ball * exact.denominator).contains(arb(exact.numerator)))


def scene_data(tables: dict[int, list[Any]]) -> SceneData:
    """Tables of one's own: rows of ints make a table of integers, all others one of numbers."""
    starts, rows = [0] * NUMBER_OF_TABLES, [0] * NUMBER_OF_TABLES
    numbers: list[Any] = []
    integers: list[int] = []
    for table, content in tables.items():
        whole = all(isinstance(row, int) for row in content)
        starts[table], rows[table] = (2 * NUMBER_OF_TABLES + len(integers) if whole else len(numbers)), len(content)
        if whole:
            integers.extend(content)
        else:
            numbers.extend(part for row in content for part in (row if isinstance(row, tuple) else (row,)))
    return SceneData(numbers, [*starts, *rows, *integers])
