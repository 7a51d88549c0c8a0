"""Exact values: the elements of a tower of roots (root_tower.py), and what IEEE 754 has for a division by zero."""

from __future__ import annotations

from enum import Enum

from raytruth.reference_tracer.arithmetics.root_tower import Element, NotExactError, RootTower, is_zero, negate


class Beyond(Enum):
    """What is no real number."""

    INFINITE = "of either sign"
    NOT_A_NUMBER = "zero over zero, and what is made from it"


INFINITE, NOT_A_NUMBER = Beyond
Value = Element | Beyond


class ExactValues:
    """The operations of the tracer's source on exact values. All raise NotExactError where the result is not known."""

    def __init__(self, most_work: int) -> None:
        self.tower = RootTower(most_work)

    def add(self, x: Value, y: Value) -> Value:
        """X + y."""
        if isinstance(x, Beyond) or isinstance(y, Beyond):
            if x is y is INFINITE:
                raise NotExactError
            return _worse(x, y)
        return self.tower.add(x, y)

    def subtract(self, x: Value, y: Value) -> Value:
        """X - y."""
        return self.add(x, self.negate(y))

    def multiply(self, x: Value, y: Value) -> Value:
        """x·y."""
        if isinstance(x, Beyond) or isinstance(y, Beyond):
            return NOT_A_NUMBER if _vanishes(x) or _vanishes(y) else _worse(x, y)
        return self.tower.multiply(x, y)

    def divide(self, x: Value, y: Value) -> Value:
        """x/y."""
        if x is NOT_A_NUMBER or y is NOT_A_NUMBER:
            return NOT_A_NUMBER
        if isinstance(y, Beyond):
            raise NotExactError
        if is_zero(y):
            return NOT_A_NUMBER if _vanishes(x) else INFINITE
        return x if isinstance(x, Beyond) else self.tower.multiply(x, self.tower.inverse(y))

    def negate(self, x: Value) -> Value:
        """-x."""
        return x if isinstance(x, Beyond) else negate(x)

    def absolute(self, x: Value) -> Value:
        """|x|."""
        return x if isinstance(x, Beyond) or self.sign(x) >= 0 else negate(x)

    def smaller(self, x: Value, y: Value) -> Value:
        """The smaller one of two numbers."""
        return x if self.sign(self.subtract(x, y)) <= 0 else y

    def larger(self, x: Value, y: Value) -> Value:
        """The larger one of two numbers."""
        return x if self.sign(self.subtract(x, y)) >= 0 else y

    def square_root(self, x: Value) -> Value:
        """√x."""
        if isinstance(x, Beyond):
            return _worse(x, x)
        return self.tower.square_root(x)

    def sign(self, x: Value) -> int:
        """-1, 0 or 1."""
        if isinstance(x, Beyond):
            raise NotExactError
        if is_zero(x):
            return 0
        ball = self.tower.ball(x)
        if ball > 0:
            return 1
        if ball < 0:
            return -1
        raise NotExactError


def _vanishes(x: Value) -> bool:
    return not isinstance(x, Beyond) and is_zero(x)


def _worse(x: Value, y: Value) -> Value:
    """What a sum or a product is of which one is no real number, and no other rule holds."""
    return NOT_A_NUMBER if NOT_A_NUMBER in (x, y) else INFINITE
