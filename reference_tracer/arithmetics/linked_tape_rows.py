"""Numbers that are linear in symbols, each of these anywhere in [-1, 1]: what stays of a tape between two rays.

`linked_balls.condensed` on the tape: each number becomes a row of the slopes by the symbols that the tape had, and by
one of its own for all that is not linear. So rows of one ray share their symbols, and the ray keeps its shape from
bounce to bounce (Kühn 1998). Rays do not know of one another: they are followed one by one.
"""

from __future__ import annotations

from typing import Any

from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, OUTWARD, Ball
from raytruth.reference_tracer.arithmetics.linked_tape import (
    HEIGHT,
    IS_FULL,
    NOTHING,
    ONE,
    ROW,
    ROW_SLOPES,
    ROWS,
    SYMBOLS,
    WORK,
    ZERO,
    Link,
    LinkedNumber,
    made,
)
from raytruth.reference_tracer.arithmetics.linked_tape_sweeps import around, common, reach, sweep_back
from raytruth.reference_tracer.compiler.questions import state

COORDINATES = 6
"""Of a ray: of its origin and of its direction."""


def keep_ray(origin: Any, direction: Any) -> int:
    """Keep a ray as rows, one after the other; gives the first one's number."""
    first = keep_number(origin[0], 0, COORDINATES)
    for coordinate in range(1, 3):
        keep_number(origin[coordinate], coordinate, COORDINATES)
    for coordinate in range(3):
        keep_number(direction[coordinate], 3 + coordinate, COORDINATES)
    return first


def keep_number(number: LinkedNumber, place: int, count: int) -> int:
    """Keep a number, one of so many that are kept together, the first at place 0; gives its row's number."""
    tape = state().tape
    return _new_row(number, tape.counts[SYMBOLS] + place, tape.counts[SYMBOLS] + count)


def kept_ray(first: int) -> Any:
    """The ray whose first row this is, on a tape of constants and of this ray alone."""
    begin_with(first)
    origin = (kept_number(first), kept_number(first + 1), kept_number(first + 2))
    return origin, (kept_number(first + 3), kept_number(first + 4), kept_number(first + 5))


def begin_with(first: int) -> None:
    """Forget all numbers but the constants: what comes next has the symbols of the rows that begin with this one."""
    tape = state().tape
    forget_numbers(tape.capacity.constants)
    tape.counts[SYMBOLS] = tape.row_widths[first]


def rays_kept() -> int:
    """What `forget_rays` is to be given to forget all rays that are kept from now on."""
    count: int = state().tape.counts[ROWS]
    return count


def reset() -> None:
    """Forget all numbers but the constants, and all symbols; what was full is not any more."""
    tape = state().tape
    forget_numbers(tape.capacity.constants)
    tape.counts[SYMBOLS] = 0
    tape.counts[IS_FULL] = 0


def numbers_made() -> int:
    """How many numbers are on the tape."""
    count: int = state().tape.counts[HEIGHT]
    return count


def forget_numbers(count: int) -> None:
    """Give back the room of all numbers but the first ones."""
    state().tape.counts[HEIGHT] = count


def forget_rays(first: int) -> None:
    """Give back the room of all rows from this number on."""
    tape = state().tape
    if first < tape.counts[ROWS]:
        tape.counts[ROWS] = first
        tape.counts[ROW_SLOPES] = tape.row_starts[first]


def hit_with_error(number: LinkedNumber) -> LinkedNumber:
    """A number that holds the same values: linear in the symbols that it depends on, plus one of its own for the rest.

    What is computed from it in several places shares that one.
    """
    tape = state().tape
    symbols = tape.counts[SYMBOLS]
    if symbols >= tape.capacity.symbols:
        tape.counts[IS_FULL] = 1
        return number
    row = _new_row(number, symbols, symbols + 1)
    tape.counts[SYMBOLS] = symbols + 1
    return kept_number(row)


def work_done() -> int:
    """A measure of all work so far that depends on no clock: the numbers that were made and the links swept back."""
    work: int = state().tape.counts[WORK]
    return work


def is_full() -> bool:
    """Whether something had no room since the tape was reset: then nothing that was computed means anything."""
    was_full: int = state().tape.counts[IS_FULL]
    return was_full == 1


def _new_row(number: LinkedNumber, own: int, width: int) -> int:
    """A row for a number, whose own symbol is number `own`; gives its number. Without room it is any row."""
    tape = state().tape
    row, start = tape.counts[ROWS], tape.counts[ROW_SLOPES]
    has_room = row < tape.capacity.rows and start + width <= tape.capacity.row_slopes
    if not (has_room and width <= tape.capacity.symbols):
        tape.counts[IS_FULL] = 1
        return 0
    tape.counts[ROWS] = row + 1
    tape.counts[ROW_SLOPES] = start + width
    tape.row_starts[row] = start
    tape.row_widths[row] = width
    error = _swept(number)
    for symbol in range(width):
        tape.row_slopes[start + symbol] = 0.0
    rest = _linear_part(start, error + tape.centers[number.place].radius)
    holds = tape.ranges[number.place]
    center = tape.centers[number.place].middle
    if not (rest <= LARGEST and abs(center) <= LARGEST):
        for symbol in range(width):
            tape.row_slopes[start + symbol] = 0.0
        center, rest = holds.middle, holds.radius
    tape.row_centers[row] = center
    tape.row_ranges[row] = holds
    tape.row_slopes[start + own] = rest
    found: int = row
    return found


def _swept(number: LinkedNumber) -> float:
    """The derivatives by the symbols, into `by_symbol`, and what all errors add; the range is then tight."""
    tape = state().tape
    place = number.place
    reach(place, ONE)
    error = sweep_back(place)
    if tape.links[place, 0] != NOTHING and tape.is_tight[place] == 0:
        tape.ranges[place] = common(tape.ranges[place], around(tape.centers[place], error))
        tape.is_tight[place] = 1
    return error


def _linear_part(start: int, error: float) -> float:
    """Put the middles of the derivatives into a row; gives the rest: the error, and the radii of the derivatives."""
    tape = state().tape
    rest = error * OUTWARD
    for symbol in range(tape.counts[SYMBOLS]):
        slope = tape.by_symbol[symbol]
        tape.row_slopes[start + symbol] = slope.middle
        rest = (rest + slope.radius) * OUTWARD
    return rest


def kept_number(row: int) -> LinkedNumber:
    """The number of a row, on the tape, which has begun with the first row of those that it was kept with."""
    tape = state().tape
    return made(Ball(tape.row_centers[row], 0.0), tape.row_ranges[row], 0.0, Link(ROW, ZERO), Link(row, ZERO))
