"""Balls that remember what they were computed from: tight enclosures of what rounding may have done to a value.

Plain balls forget that two numbers share an error. Behind a few curved mirrors they grow without limit, although the
error of the arithmetic does not. Here each number keeps its value at the centre, where nothing is rounded; a ball that
holds all its values; and the numbers it was made from. By the mean value theorem

    f(errors) - f(0)  lies in  the sum over all errors e of  (∂f/∂e over all errors) · [-|e|, |e|],

where one backward sweep gives all derivatives (Moore, "Methods and Applications of Interval Analysis", 1979, section
3.3; Speelpenning, "Compiling Fast Partial Derivatives", 1980). So an error that two numbers share counts once, with
its sign. At a kink, as that of max, it holds with the interval between the derivatives of both sides (Lebourg 1975).

Long computations are cut: `condensed` replaces numbers by new ones that are linear in symbols, each in [-1, 1], plus a
box for all that is not linear. So a set of rays keeps its shape from bounce to bounce (Kühn, "Rigorously computed
orbits of dynamical systems without the wrapping effect", 1998).
"""

from __future__ import annotations

import itertools
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, Any, NamedTuple

from flint import arb, arb_mat

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

ZERO, ONE, MINUS_ONE = arb(0), arb(1), arb(-1)
WITHIN_ONE = arb(0, 1)
ZERO_TO_ONE = arb(0.5, 0.5)
ANYTHING = arb("nan")

_ages = itertools.count()

# A product and a sum of columns, of some ten balls each in one call, take some four times as long as those of balls.
COLUMN_WORK = 4


class _Swept:
    """What all sweeps together have done so far."""

    links = 0


def work_done() -> int:
    """A measure of all work so far that depends on no clock: the numbers that were made and the links swept back."""
    return next(_ages) + _Swept.links


Link = tuple["LinkedBall", Any]
"""A number that another was made from, and a ball that holds the derivative of the other by it."""


class LinkedBall:
    """A number that knows from which others it was computed, so that errors they share are counted once."""

    __slots__ = ("age", "center", "error", "is_symbol", "links", "range", "sweep")

    roundoff: Any = ZERO
    """The ball from -u to u, where u is the largest relative error of one operation."""
    about_one: Any = ONE
    """1 ± u."""

    def __init__(self, center: Any, holds: Any, links: tuple[Link, ...] = (), error: Any = ZERO) -> None:
        self.center = center
        """Its value where nothing is rounded."""
        self.range = holds
        """Holds all its values."""
        self.links = links
        self.error = error
        """Around 0: holds what was added to it when it was made, by rounding."""
        self.is_symbol = False
        self.sweep: Sweep | None = None
        self.age = next(_ages)

    def rounded(self, center: Any, exact: Any, *links: Link) -> LinkedBall:
        """A result of one operation, whose exact values lie in `exact`."""
        return self.__class__(center, exact * self.about_one, links, exact * self.roundoff)

    def __add__(self, other: LinkedBall) -> LinkedBall:
        return self.rounded(self.center + other.center, self.range + other.range, (self, ONE), (other, ONE))

    def __sub__(self, other: LinkedBall) -> LinkedBall:
        return self.rounded(self.center - other.center, self.range - other.range, (self, ONE), (other, MINUS_ONE))

    def __mul__(self, other: LinkedBall) -> LinkedBall:
        center, exact = self.center * other.center, self.range * other.range
        return self.rounded(center, exact, (self, other.range), (other, self.range))

    def __truediv__(self, other: LinkedBall) -> LinkedBall:
        if other.range.overlaps(ZERO):
            enclosure(other)
        inverse = ONE / other.range
        exact = self.range * inverse
        return self.rounded(self.center / other.center, exact, (self, inverse), (other, -exact * inverse))

    def __neg__(self) -> LinkedBall:
        return self.__class__(-self.center, -self.range, ((self, MINUS_ONE),))

    def __abs__(self) -> LinkedBall:
        if self.range >= 0:
            return self
        if self.range <= 0:
            return -self
        return self.__class__(abs(self.center), abs(self.range), ((self, WITHIN_ONE),))


class Sweep(NamedTuple):
    """What one sweep backward from results to what they were computed from finds."""

    symbols: list[Link]
    """The derivatives by the symbols."""
    error: Any
    """Around 0: holds what all roundings together may have added."""


def sweep_back(seeds: Iterable[Link], zero: Any) -> Sweep:
    """The derivatives of a sum of numbers, each times a factor, by all that it was made from; the youngest first.

    The factors, and so all derivatives, may be columns of several sums at once; `zero` is the sum of nothing.
    """
    derivatives: dict[int, Any] = {}
    numbers: dict[int, LinkedBall] = {}
    for number, factor in seeds:
        derivatives[number.age] = derivatives.get(number.age, zero) + factor
        numbers[number.age] = number
    waiting = [-number.age for number in numbers.values() if number.links]
    heapify(waiting)
    error = zero
    swept, work_of_one = 0, 1 if zero is ZERO else COLUMN_WORK
    while waiting:
        age = -heappop(waiting)
        number, derivative = numbers[age], derivatives.pop(age)
        if number.error is not ZERO:
            error = error + derivative * number.error
            derivative = derivative * number.about_one
        swept += len(number.links)
        for source, slope in number.links:
            source_age = source.age
            known = derivatives.get(source_age)
            if known is not None:
                derivatives[source_age] = known + derivative * slope
            elif source.links or source.error is not ZERO:  # exact constants change nothing
                derivatives[source_age] = derivative * slope
                numbers[source_age] = source
                if source.links:
                    heappush(waiting, -source_age)
    _Swept.links += swept * work_of_one
    symbols: list[Link] = []
    for age, derivative in derivatives.items():  # what is left was not made from anything
        if numbers[age].is_symbol:
            symbols.append((numbers[age], derivative))
        else:
            error = error + derivative * numbers[age].error
    return Sweep(symbols, error)


def enclosure(number: LinkedBall) -> Any:
    """A tight ball that holds all values of a number; remembered as its range."""
    if number.sweep is None and number.links:
        _remember(number, sweep_back([(number, ONE)], ZERO))
    return number.range


def enclose(numbers: Iterable[LinkedBall]) -> None:
    """Find the tight `enclosure` of each number, in one sweep for all of them."""
    open_ones = list({number.age: number for number in numbers if number.sweep is None and number.links}.values())
    size = len(open_ones)
    columns = [arb_mat(size, 1, [int(row == place) for row in range(size)]) for place in range(size)]
    symbols, error = sweep_back(zip(open_ones, columns, strict=True), arb_mat(size, 1))
    slopes: list[list[Link]] = [[] for _ in open_ones]
    for symbol, column in symbols:
        for links, slope in zip(slopes, column.entries(), strict=True):
            if not slope.is_zero():
                links.append((symbol, slope))
    for number, links, of_roundings in zip(open_ones, slopes, error.entries(), strict=True):
        _remember(number, Sweep(links, of_roundings))


def difference(a: LinkedBall, b: LinkedBall) -> Any:
    """A tight ball that holds all values of a - b before rounding."""
    if not b.links and b.range.is_exact():
        return enclosure(a) - b.range
    swept = sweep_back([(a, ONE), (b, MINUS_ONE)], ZERO)
    return _common(a.range - b.range, _around(a.center - b.center, swept))


def condensed(numbers: Sequence[LinkedBall]) -> list[LinkedBall]:
    """New numbers that hold the same values together: linear in new symbols, plus a box for the rest of each."""
    renewed: dict[LinkedBall, LinkedBall] = {}
    return [_linear(number, renewed) for number in numbers]


def with_own_symbol(number: LinkedBall) -> LinkedBall:
    """A number that holds the same values: linear in the symbols that it depends on, plus one of its own for the rest.

    What is computed from it in several places shares that one.
    """
    enclosure(number)
    return _linear(number, {symbol: symbol for symbol, _ in number.sweep.symbols} if number.sweep else {})


def _linear(number: LinkedBall, renewed: dict[LinkedBall, LinkedBall]) -> LinkedBall:
    """The number as linear in symbols and a new one for the rest; `renewed` says which to take for those it had."""
    holds = enclosure(number)
    symbols, error = number.sweep or Sweep([], number.error)
    box = abs(error) + number.center.rad()
    links: list[Link] = []
    for symbol, slope in symbols:
        if symbol not in renewed:
            renewed[symbol] = new_symbol(number)
        links.append((renewed[symbol], slope.mid()))
        box = box + slope.rad()
    if box.is_finite() and number.center.is_finite():
        center = number.center.mid()
        links.append((new_symbol(number), box.upper()))
    else:
        center = holds.mid()
        links = [(new_symbol(number), holds.rad())]
    return _made(number, center, holds, tuple(links))


def new_symbol(like: LinkedBall) -> LinkedBall:
    """A new number that is independent of all others, and anywhere in [-1, 1]."""
    symbol = like.__class__(ZERO, WITHIN_ONE, (), WITHIN_ONE)
    symbol.is_symbol = True
    return symbol


def _remember(number: LinkedBall, swept: Sweep) -> None:
    number.sweep = swept
    number.range = _common(number.range, _around(number.center, swept))


def _made(like: LinkedBall, center: Any, holds: Any, links: tuple[Link, ...]) -> LinkedBall:
    number = like.__class__(center, holds, links)
    number.sweep = Sweep(list(links), ZERO)  # its range is tight already
    return number


def _around(center: Any, swept: Sweep) -> Any:
    radius = abs(swept.error)
    for _, slope in swept.symbols:
        radius = radius + abs(slope)
    if not (center.is_finite() and radius.is_finite()):
        return ANYTHING
    return center + arb(0, radius.upper())


def _common(a: Any, b: Any) -> Any:
    """What two balls that both hold a value have in common."""
    if not b.is_finite():
        return a
    return a.intersection(b) if a.is_finite() else b
