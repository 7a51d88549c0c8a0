"""The tape of linked numbers: linked balls (linked_balls.py) in arrays, to be compiled.

A number is a place on the tape. The larger its place, the younger it is, so that one sweep down the tape finds the
derivatives of a number by all that it was made from. Each number was made from two others at most. Balls are of floats
and computed with without a roundoff (float_balls.py), so that what float64 rounds is in them. What the renderer rounds
is added to a number as its error: with the roundoff u its exact value x becomes x + ε for any |ε| ≤ u·|x|. All numbers
are then functions of these errors, each in an interval of its own; ranges hold their values for all of them, and so the
mean value theorem holds.

The first places hold constants, for good. Behind them is what one ray needs, forgotten with the next one. What a
number may be between two rays is kept apart, linear in symbols (linked_tape_rows.py).

These functions find the tape in the state of the call (compiler/questions.py), and so they only run compiled.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from raytruth.reference_tracer.arithmetics.float_balls import (
    LARGEST,
    OUTWARD,
    UNDERFLOW,
    Ball,
    rounded_ball,
)
from raytruth.reference_tracer.compiler.questions import state

ZERO = Ball(0.0, 0.0)
ONE = Ball(1.0, 0.0)
MINUS_ONE = Ball(-1.0, 0.0)

NOTHING = -1
"""In place of a link: there is none, or none that matters, since the number there is exact."""
ROW = -2
"""In place of the first link: the number is linear in symbols, as the row says whose number stands in the second's."""

# Places of `counts`.
HEIGHT, SYMBOLS, ROWS, ROW_SLOPES, FIRST_REACHED, WORK, IS_FULL = range(7)
"""How many numbers, symbols, rows and slopes of rows there are; a constant that the sweep has reached; the work done;
and 1 if something had no room."""
NUMBER_OF_COUNTS = 7


class LinkedNumber(NamedTuple):
    """A number: where it stands on the tape."""

    place: int


class Capacity(NamedTuple):
    """How much there is room for."""

    constants: int
    """As many numbers are constants."""
    numbers: int
    symbols: int
    rows: int
    row_slopes: int


class LinkedTape(NamedTuple):
    """Arrays, those from `centers` to `derivatives` with an element for each number."""

    capacity: Capacity
    counts: Any
    centers: Any
    """Balls: the values where nothing is rounded and nothing uncertain."""
    ranges: Any
    """Balls that hold all values."""
    errors: Any
    """Floats: what rounding may add when the number is made; of a constant, how far it may be from its centre."""
    links: Any
    """Whole numbers, two each: the places of what it was made from."""
    slopes: Any
    """Balls, two each: the derivatives by these, over all of their values."""
    is_tight: Any
    """Whole numbers: 1 where the range is the tight enclosure already."""
    derivatives: Any
    """Balls: of what is swept by each number. Between two sweeps all of them are 0."""
    reached: Any
    """Whole numbers, for each constant: the place of the next one that the sweep has reached, and behind the last such
    one how many constants there are. NOTHING for those that it has not reached."""
    by_symbol: Any
    """Balls: the derivatives by the symbols that the last sweep has found."""
    row_centers: Any
    row_ranges: Any
    row_starts: Any
    """Where the slopes of each row begin, and how many there are: its derivatives by the first symbols."""
    row_widths: Any
    row_slopes: Any


class Link(NamedTuple):
    """What a number is made from: the place of another, and a ball that holds the derivative by it."""

    place: int
    slope: Ball


NO_LINK = Link(NOTHING, ZERO)


def link_to(number: LinkedNumber, slope: Ball) -> Link:
    """A link; none to what is exact, which changes nothing."""
    tape = state().tape
    is_exact = tape.links[number.place, 0] == NOTHING and tape.errors[number.place] == 0.0
    return Link(NOTHING if is_exact else number.place, slope)


def made(center: Ball, holds: Ball, error: float, first: Link, second: Link) -> LinkedNumber:
    """A new number on the tape; where that has no room any other one, and the tape is full."""
    tape = state().tape
    place = tape.counts[HEIGHT]
    if place >= tape.capacity.numbers:
        tape.counts[IS_FULL] = 1
        return LinkedNumber(tape.capacity.numbers - 1)
    if first.place == NOTHING:
        first, second = second, first
    tape.counts[HEIGHT] = place + 1
    tape.counts[WORK] = tape.counts[WORK] + 1
    tape.centers[place] = center
    tape.ranges[place] = holds
    tape.errors[place] = error
    tape.links[place, 0] = first.place
    tape.links[place, 1] = second.place
    tape.slopes[place, 0] = first.slope
    tape.slopes[place, 1] = second.slope
    tape.is_tight[place] = 0
    return LinkedNumber(place)


def rounded(center: Ball, exact: Ball, first: Link, second: Link) -> LinkedNumber:
    """The result of one operation of the renderer's, whose exact values lie in `exact`; what is exactly 0 stays so."""
    if exact.middle == 0.0 and exact.radius == 0.0:
        return made(ZERO, ZERO, 0.0, NO_LINK, NO_LINK)
    roundoff = state().roundoff
    error = magnitude(exact) * roundoff * OUTWARD + UNDERFLOW if roundoff > 0.0 else 0.0
    return made(center, rounded_ball(exact, roundoff), error, first, second)


def number_of_ball(ball: Ball) -> LinkedNumber:
    """A number of which only this is known: anything in the ball."""
    return made(Ball(ball.middle, 0.0), ball, ball.radius, NO_LINK, NO_LINK)


def magnitude(ball: Ball) -> float:
    """The largest size of a number in the ball, but for a rounding."""
    return abs(ball.middle) + ball.radius


def is_finite(ball: Ball) -> bool:
    """Whether the ball has two ends."""
    return abs(ball.middle) <= LARGEST and ball.radius <= LARGEST
