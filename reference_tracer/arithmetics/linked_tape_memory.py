"""The arrays of a tape of linked numbers (linked_tape.py), and their types for the compiler."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.reference_tracer.arithmetics.float_balls import Ball
from raytruth.reference_tracer.arithmetics.linked_tape import (
    FIRST_REACHED,
    HEIGHT,
    NOTHING,
    NUMBER_OF_COUNTS,
    Capacity,
    LinkedTape,
)
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.reference_tracer.compiler.types import Type

# In the library a ray makes 5,000 numbers at most besides the constants, and a pixel keeps 300 rows with 14,000 slopes.
# What there is room for takes some 30 megabytes, of which the system gives only what is used.
MOST_NUMBERS = 2**16
MOST_ROWS = 2**15
MOST_ROW_SLOPES = 2**21
# The camera's rays have 21, and each bounce adds seven: six coordinates' and a distance's. A scene has 64 at most.
MOST_SYMBOLS = 512

FLOAT, INTEGER = Float(64), Integer()
BALL = Tuple((FLOAT, FLOAT), Ball._fields, Ball.__name__)
CAPACITY = Tuple((INTEGER,) * len(Capacity._fields), Capacity._fields, Capacity.__name__)


def tape_type() -> Tuple:
    """The type of LinkedTape."""
    kinds: dict[str, Type] = {
        "capacity": CAPACITY,
        "links": Array(INTEGER, 2),
        "slopes": Array(BALL, 2),
        **{name: Array(BALL) for name in ("centers", "ranges", "derivatives", "by_symbol", "row_ranges")},
        **{name: Array(FLOAT) for name in ("errors", "row_centers", "row_slopes")},
        **{name: Array(INTEGER) for name in ("counts", "is_tight", "reached", "row_starts", "row_widths")},
    }
    return Tuple(tuple(kinds[name] for name in LinkedTape._fields), LinkedTape._fields, LinkedTape.__name__)


def tape_memory(constants: Sequence[Ball], numbers: int = MOST_NUMBERS, symbols: int = MOST_SYMBOLS) -> LinkedTape:
    """A tape of these constants, with room for so many numbers besides, and symbols of one ray."""
    count = len(constants)
    capacity = Capacity(count, count + numbers, symbols, MOST_ROWS, MOST_ROW_SLOPES)
    tape = _empty(capacity)
    ranges = np.array(constants, dtype=np.float64).reshape(count, 2)
    tape.centers[:count, 0] = ranges[:, 0]
    tape.ranges[:count] = ranges
    tape.errors[:count] = ranges[:, 1]
    tape.links[:count] = NOTHING
    tape.reached[:] = NOTHING
    tape.counts[HEIGHT] = tape.counts[FIRST_REACHED] = count
    return tape


def _empty(capacity: Capacity) -> LinkedTape:
    numbers, rows = capacity.numbers, capacity.rows
    return LinkedTape(
        capacity=capacity,
        counts=_wholes(NUMBER_OF_COUNTS),
        centers=np.zeros((numbers, 2)),
        ranges=np.zeros((numbers, 2)),
        errors=np.zeros(numbers),
        links=_wholes(numbers, 2),
        slopes=np.zeros((numbers, 2, 2)),
        is_tight=_wholes(numbers),
        derivatives=np.zeros((numbers, 2)),
        reached=_wholes(capacity.constants),
        by_symbol=np.zeros((capacity.symbols, 2)),
        row_centers=np.zeros(rows),
        row_ranges=np.zeros((rows, 2)),
        row_starts=_wholes(rows),
        row_widths=_wholes(rows),
        row_slopes=np.zeros(capacity.row_slopes),
    )


def _wholes(*shape: int) -> Any:
    return np.zeros(shape, dtype=np.int64)
