"""The types that a value may have in compiled code, and how values of each lie in memory.

A tuple is no thing of the machine: it is its parts, one after the other, and so are tuples of tuples. The machine's own
types are left then, the *leaves*.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np


@dataclass(frozen=True)
class Float:
    """A number of IEEE 754 with 32 or 64 bits."""

    bits: int


@dataclass(frozen=True)
class Integer:
    """A whole number of 64 bits with a sign. Sums that do not fit wrap around."""


@dataclass(frozen=True)
class Boolean:
    """True or False."""


@dataclass(frozen=True)
class Nothing:
    """What a function returns that returns nothing."""


@dataclass(frozen=True)
class Tuple:
    """Parts of any types; those of a NamedTuple have names, and so has the tuple."""

    parts: tuple[Type, ...]
    names: tuple[str, ...] = ()
    name: str = ""


@dataclass(frozen=True)
class Array:
    """A contiguous array of Python's: a pointer, and all sizes but the first."""

    element: Type
    dimensions: int = 1


@dataclass(frozen=True)
class Stack:
    """A list that only `append` and `pop` change: a pointer to its elements, and one to their number."""

    element: Type


Type: TypeAlias = "Float | Integer | Boolean | Nothing | Tuple | Array | Stack"
Leaf: TypeAlias = "Float | Integer | Boolean | Pointer"


@dataclass(frozen=True)
class Pointer:
    """A leaf: where values of a type lie one after the other."""

    to: Type


def leaves(kind: Type) -> list[Leaf]:
    """What a value of a type consists of on the machine, in order."""
    if isinstance(kind, Tuple):
        return [leaf for part in kind.parts for leaf in leaves(part)]
    if isinstance(kind, Array):
        return [Pointer(kind.element), *[Integer()] * (kind.dimensions - 1)]
    if isinstance(kind, Stack):
        return [Pointer(kind.element), Pointer(Integer())]
    return [] if isinstance(kind, Nothing) else [kind]


def part_leaves(kind: Tuple, place: int) -> slice:
    """Which of a tuple's leaves are those of one of its parts."""
    start = sum(len(leaves(part)) for part in kind.parts[:place])
    return slice(start, start + len(leaves(kind.parts[place])))


def type_of(value: Any) -> Type | None:
    """The type of a constant of Python's or NumPy's; None for what compiled code cannot hold."""
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        parts = [type_of(part) for part in value]
        known = tuple(part for part in parts if part is not None)
        return Tuple(known, value._fields, type(value).__name__) if len(known) == len(parts) else None
    if isinstance(value, np.float32):
        return Float(32)
    for python, kind in ((bool, Boolean()), (int, Integer()), (float, Float(64))):
        if isinstance(value, python):
            return kind
    return None


def shown(kind: Type) -> str:
    """A type as it would be written in Python."""
    if isinstance(kind, Tuple):
        return kind.name or f"tuple[{', '.join(shown(part) for part in kind.parts)}]"
    if isinstance(kind, Array | Stack):
        return f"{'array' if isinstance(kind, Array) else 'list'}[{shown(kind.element)}]"
    if isinstance(kind, Float):
        return f"float{kind.bits}"
    return {Integer: "int", Boolean: "bool", Nothing: "None"}[type(kind)]
