"""Sweeps down the tape of linked numbers (linked_tape.py): derivatives, and what encloses a number tightly."""

from __future__ import annotations

from raytruth.reference_tracer.arithmetics.float_balls import (
    ANYTHING,
    OUTWARD,
    UNDERFLOW,
    UNIT_ROUNDOFF,
    Ball,
    add,
    hull,
    lower,
    mul,
    sub,
    upper,
)
from raytruth.reference_tracer.arithmetics.linked_tape import (
    FIRST_REACHED,
    MINUS_ONE,
    NOTHING,
    ONE,
    ROW,
    SYMBOLS,
    WORK,
    ZERO,
    LinkedNumber,
    is_finite,
    magnitude,
)
from raytruth.reference_tracer.compiler.questions import state


def reach(place: int, derivative: Ball) -> None:
    """Add to the derivative by the number at a place."""
    tape = state().tape
    known = tape.derivatives[place]
    if known.middle != 0.0 or known.radius != 0.0:  # also where it is unknown
        tape.derivatives[place] = add(known, derivative, 0.0)
        return
    tape.derivatives[place] = derivative
    if place < tape.capacity.constants and tape.reached[place] == NOTHING:
        tape.reached[place] = tape.counts[FIRST_REACHED]
        tape.counts[FIRST_REACHED] = place


def sweep_back(top: int) -> float:
    """From the derivatives of a sum of numbers by these, none above `top`, to those by the symbols; the youngest first.

    Gives what all roundings and errors of constants together may have added. By the mean value theorem the sum differs
    from its value at the centres of all of its errors and symbols by no more than the derivatives over all of their
    values, times their sizes (linked_balls.py). Each step of the bound takes a handful of roundings, for which it is
    made larger.
    """
    tape = state().tape
    for symbol in range(tape.counts[SYMBOLS]):
        tape.by_symbol[symbol] = ZERO
    error = 0.0
    place = top
    while place >= tape.capacity.constants:
        derivative = tape.derivatives[place]
        if derivative.middle != 0.0 or derivative.radius != 0.0:
            tape.derivatives[place] = ZERO
            error = (error + _through(place, derivative)) * OUTWARD
        place = place - 1
    return (error + _through_constants()) * OUTWARD


def _through(place: int, derivative: Ball) -> float:
    """From the derivative by one number to those by what it was made from; what its own error adds."""
    tape = state().tape
    first, second = tape.links[place, 0], tape.links[place, 1]
    if first == ROW:
        _through_row(second, derivative)
        return 0.0
    size = tape.errors[place]
    added = magnitude(derivative) * size * OUTWARD + UNDERFLOW if size != 0.0 else 0.0
    if first != NOTHING:
        tape.counts[WORK] = tape.counts[WORK] + 1
        reach(first, mul(derivative, tape.slopes[place, 0], 0.0))
        if second != NOTHING:
            tape.counts[WORK] = tape.counts[WORK] + 1
            reach(second, mul(derivative, tape.slopes[place, 1], 0.0))
    return added


def _through_row(row: int, derivative: Ball) -> None:
    """From the derivative by a number that is linear in symbols to those by the symbols.

    That is `add` and `mul` of float_balls.py for a factor without a radius, with one bound for both roundings, since
    most of the time goes by here: what is not finite comes out as not finite, too.
    """
    tape = state().tape
    start, width = tape.row_starts[row], tape.row_widths[row]
    tape.counts[WORK] = tape.counts[WORK] + width
    for symbol in range(width):
        slope = tape.row_slopes[start + symbol]
        if slope != 0.0:
            known = tape.by_symbol[symbol]
            product = derivative.middle * slope
            total = known.middle + product
            lost = UNIT_ROUNDOFF * (abs(product) + abs(total))
            radius = known.radius + derivative.radius * abs(slope) + lost
            tape.by_symbol[symbol] = Ball(total, radius * OUTWARD + UNDERFLOW)


def _through_constants() -> float:
    """What the errors of the constants add that a sweep has reached."""
    tape = state().tape
    error = 0.0
    place = tape.counts[FIRST_REACHED]
    while place < tape.capacity.constants:
        if tape.errors[place] != 0.0:
            error = (error + magnitude(tape.derivatives[place]) * tape.errors[place]) * OUTWARD + UNDERFLOW
        tape.derivatives[place] = ZERO
        following = tape.reached[place]
        tape.reached[place] = NOTHING
        place = following
    tape.counts[FIRST_REACHED] = place
    return error


def around(center: Ball, error: float) -> Ball:
    """A ball around a centre that holds what the symbols, each from -1 to 1, and the error may make of it."""
    tape = state().tape
    radius = error + center.radius
    for symbol in range(tape.counts[SYMBOLS]):
        radius = (radius + magnitude(tape.by_symbol[symbol])) * OUTWARD
    found = Ball(center.middle, radius * OUTWARD)
    return found if is_finite(found) else ANYTHING


def common(a: Ball, b: Ball) -> Ball:
    """What two balls that both hold a value have in common; the first one where the second says nothing."""
    if not is_finite(b):
        return a
    if not is_finite(a):
        return b
    least, most = lower(a), upper(a)
    least_of_b, most_of_b = lower(b), upper(b)
    if least_of_b <= least and most <= most_of_b:
        return a
    if least <= least_of_b and most_of_b <= most:
        return b
    return hull(max(least, least_of_b), min(most, most_of_b))


def box_of(number: LinkedNumber) -> Ball:
    """A tight ball that holds all values of a number; remembered as its range."""
    tape = state().tape
    place = number.place
    if tape.is_tight[place] == 0 and tape.links[place, 0] >= 0:
        reach(place, ONE)
        error = sweep_back(place)
        tape.ranges[place] = common(tape.ranges[place], around(tape.centers[place], error))
        tape.is_tight[place] = 1
    found: Ball = tape.ranges[place]
    return found


def difference(a: LinkedNumber, b: LinkedNumber) -> Ball:
    """A tight ball that holds all values of a - b before rounding."""
    tape = state().tape
    of_b = tape.ranges[b.place]
    if tape.links[b.place, 0] == NOTHING and of_b.radius == 0.0:
        return sub(box_of(a), of_b, 0.0)
    reach(a.place, ONE)
    reach(b.place, MINUS_ONE)
    error = sweep_back(max(a.place, b.place))
    center = sub(tape.centers[a.place], tape.centers[b.place], 0.0)
    return common(sub(tape.ranges[a.place], of_b, 0.0), around(center, error))
