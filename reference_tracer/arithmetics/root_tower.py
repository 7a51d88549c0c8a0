"""Exact arithmetic with square roots: a tower of fields, each with one more root than the field below it.

An element is a quotient (quotients.py), or a + b·√r with the newest of its roots, where a, b and r lie in lower fields
and b is not zero. A root is adjoined only if it does not lie in the tower already, so every element has one form only,
and is zero if and only if that form is. Each element also has a ball at the precision in force, which tells the sign.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import arb, arb_poly, fmpq_poly

from raytruth.reference_tracer.arithmetics.quotients import Quotient

# Three of a camera and a light, and those of two spheres or two refractions; every further one doubles the work.
MOST_ROOTS = 7
# What a product takes whatever its size, where a short coefficient more takes 1: the unit is about a microsecond.
PRODUCT_WORK = 8


class NotExactError(Exception):
    """A number whose exact form is not known, or would take too long to find."""


@dataclass(frozen=True, slots=True)
class Root:
    """constant + factor·√r, where r is the radicand of that level of the tower, counted from 1; factor is not zero."""

    level: int
    constant: Element
    factor: Element


Element = Quotient | Root

ZERO = Quotient(fmpq_poly([0]))
ONE = Quotient(fmpq_poly([1]))
HALF = Quotient(fmpq_poly([1]) / 2)
SYMBOL = Quotient(fmpq_poly([0, 1]))


def constant(value: Any) -> Quotient:
    """A rational number as an element."""
    return Quotient(fmpq_poly([value]))


def is_zero(x: Element) -> bool:
    """Whether the element is zero."""
    return isinstance(x, Quotient) and x.is_zero()


def negate(x: Element) -> Element:
    """-x."""
    if isinstance(x, Quotient):
        return -x
    return Root(x.level, negate(x.constant), negate(x.factor))


class RootTower:
    """The roots adjoined so far, and what the symbol stands for; no more than `most_work` is done in it."""

    def __init__(self, most_work: int) -> None:
        self.most_work = most_work
        self.radicands: list[Element] = []
        self.root_balls: list[Any] = []
        self.symbol_ball: Any = None
        self.work = 0

    def add(self, x: Element, y: Element) -> Element:
        """X + y."""
        if isinstance(x, Quotient) and isinstance(y, Quotient):
            return x + y
        if _level(x) < _level(y):
            x, y = y, x
        assert isinstance(x, Root)
        if isinstance(y, Root) and y.level == x.level:
            return _made(x.level, self.add(x.constant, y.constant), self.add(x.factor, y.factor))
        return Root(x.level, self.add(x.constant, y), x.factor)

    def multiply(self, x: Element, y: Element) -> Element:
        """x·y."""
        if is_zero(x) or is_zero(y):
            return ZERO
        if isinstance(x, Quotient) and isinstance(y, Quotient):
            self._count(PRODUCT_WORK + x.size() + y.size())
            return x * y
        if _level(x) < _level(y):
            x, y = y, x
        assert isinstance(x, Root)
        if not (isinstance(y, Root) and y.level == x.level):
            return _made(x.level, self.multiply(x.constant, y), self.multiply(x.factor, y))
        squared = self.multiply(self.multiply(x.factor, y.factor), self.radicands[x.level - 1])
        across = self.add(self.multiply(x.constant, y.factor), self.multiply(x.factor, y.constant))
        return _made(x.level, self.add(self.multiply(x.constant, y.constant), squared), across)

    def inverse(self, x: Element) -> Element:
        """1/x for an x that is not zero: conjugate over norm. Raises NotExactError if the norm may be 0 here."""
        if isinstance(x, Quotient):
            self._demand_nonzero(x)
            return x.inverse()
        over_norm = self.inverse(self._norm(x))
        return Root(x.level, self.multiply(x.constant, over_norm), self.multiply(negate(x.factor), over_norm))

    def square_root(self, x: Element) -> Element:
        """The root that is not negative, of what is not negative; adjoined if it is not in the tower.

        Raises NotExactError if the ball of x, or of its root in the tower, is not clear of 0.
        """
        if is_zero(x):
            return ZERO
        ball = self.ball(x)
        if not ball > 0:
            raise NotExactError
        root = self._root_within(x, len(self.radicands))
        if root is not None:
            value = self.ball(root)
            if value > 0:
                return root
            if value < 0:
                return negate(root)
            raise NotExactError
        if len(self.radicands) == MOST_ROOTS:
            raise NotExactError
        self.radicands.append(x)
        self.root_balls.append(ball.sqrt())
        return Root(len(self.radicands), ZERO, ONE)

    def symbol(self, ball: Any) -> Element:
        """The symbol, which stands for a number in `ball`. There is one; raises NotExactError for a second."""
        if self.symbol_ball is not None:
            raise NotExactError
        self.symbol_ball = ball
        return SYMBOL

    def ball(self, x: Element) -> Any:
        """A ball that holds the element."""
        if isinstance(x, Root):
            return self.ball(x.constant) + self.ball(x.factor) * self.root_balls[x.level - 1]
        return self._polynomial_ball(x.numerator) / self._polynomial_ball(x.denominator)

    def _polynomial_ball(self, polynomial: Any) -> Any:
        if polynomial.degree() <= 0:
            return arb(polynomial[0])
        return arb_poly(polynomial)(self.symbol_ball)

    def _norm(self, x: Root) -> Element:
        """constant² - factor²·r: not zero, since r is no square of the field below."""
        squared = self.multiply(self.multiply(x.factor, x.factor), self.radicands[x.level - 1])
        return self.add(self.multiply(x.constant, x.constant), negate(squared))

    def _root_within(self, x: Element, level: int) -> Element | None:
        """An element of the lowest `level` extensions whose square is x, or None if there is none.

        (p + q·√r)² = a + b·√r for b ≠ 0 iff p² = (a ± n)/2 and q = b/2p, with n² the norm a² - b²·r; for b = 0 either
        p or q is 0.
        """
        if is_zero(x):
            return ZERO
        if level == 0:
            assert isinstance(x, Quotient)
            self._count(PRODUCT_WORK + x.size())
            return x.square_root()
        if isinstance(x, Quotient) or x.level < level:
            root = self._root_within(x, level - 1)
            if root is not None:
                return root
            factor = self._root_within(self.multiply(x, self.inverse(self.radicands[level - 1])), level - 1)
            return None if factor is None else Root(level, ZERO, factor)
        return self._root_by_norm(x)

    def _root_by_norm(self, x: Root) -> Element | None:
        """As above, for b ≠ 0."""
        below = x.level - 1
        of_norm = self._root_within(self._norm(x), below)
        if of_norm is None:
            return None
        for signed in (of_norm, negate(of_norm)):
            root = self._root_within(self.multiply(self.add(x.constant, signed), HALF), below)
            if root is not None:
                return Root(x.level, root, self.multiply(self.multiply(x.factor, HALF), self.inverse(root)))
        return None

    def _demand_nonzero(self, x: Quotient) -> None:
        """A quotient that is not always zero might be zero where the symbol is what it stands for."""
        if not x.is_constant() and not self.ball(x) != 0:
            raise NotExactError

    def _count(self, work: int) -> None:
        self.work += work
        if self.work > self.most_work:
            raise NotExactError


def _level(x: Element) -> int:
    return 0 if isinstance(x, Quotient) else x.level


def _made(level: int, at_level_below: Element, factor: Element) -> Element:
    return at_level_below if is_zero(factor) else Root(level, at_level_below, factor)
