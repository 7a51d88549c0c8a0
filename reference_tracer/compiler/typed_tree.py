"""The typed tree: a function whose every name is resolved and whose every expression has its type.

Between Python's syntax tree, which knows no types, and LLVM's instructions, which know no expressions.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from raytruth.reference_tracer.compiler.types import Type


@dataclass(frozen=True)
class Constant:
    """A number, or True or False."""

    value: float | bool
    type: Type


@dataclass(frozen=True)
class Local:
    """The value of a variable."""

    name: str
    type: Type


@dataclass(frozen=True)
class Operation:
    """One of the machine's own operations, by the name that Python's module `operator` or `math` has for it."""

    name: str
    operands: tuple[Expression, ...]
    type: Type


@dataclass(frozen=True)
class Question:
    """What a function of questions.py gives, by its name."""

    name: str
    type: Type


@dataclass(frozen=True)
class Call:
    """A function's value for some arguments."""

    function: TypedFunction
    arguments: tuple[Expression, ...]
    type: Type


@dataclass(frozen=True)
class Build:
    """A tuple of these parts, or a list that holds them at first."""

    parts: tuple[Expression, ...]
    type: Type


@dataclass(frozen=True)
class Part:
    """The part of a tuple at a place that is known here."""

    whole: Expression
    place: int
    type: Type


@dataclass(frozen=True)
class PartAt:
    """The part of a tuple at a place that only the machine will know; all parts are of one type."""

    whole: Expression
    place: Expression
    type: Type


@dataclass(frozen=True)
class Element:
    """An element of an array."""

    array: Expression
    places: tuple[Expression, ...]
    type: Type


@dataclass(frozen=True)
class Conditional:
    """One value or the other; the one that is not chosen is not computed."""

    test: Expression
    if_true: Expression
    if_false: Expression
    type: Type


@dataclass(frozen=True)
class Pop:
    """The element on top of a stack, which is taken away."""

    stack: Expression
    type: Type


Expression: TypeAlias = (
    "Constant | Local | Operation | Call | Build | Part | PartAt | Element | Conditional | Pop | Question"
)


@dataclass(frozen=True)
class Assign:
    """A variable gets a value."""

    name: str
    value: Expression


@dataclass(frozen=True)
class Store:
    """An element of an array gets a value."""

    array: Expression
    places: tuple[Expression, ...]
    value: Expression


@dataclass(frozen=True)
class Push:
    """A value is put on top of a stack."""

    stack: Expression
    value: Expression


@dataclass(frozen=True)
class Evaluate:
    """An expression is computed for what it does."""

    value: Expression


@dataclass(frozen=True)
class Return:
    """The function ends."""

    value: Expression | None


@dataclass(frozen=True)
class If:
    """One block or the other."""

    test: Expression
    if_true: tuple[Statement, ...]
    if_false: tuple[Statement, ...]


@dataclass(frozen=True)
class While:
    """A block as long as the test holds."""

    test: Expression
    body: tuple[Statement, ...]


@dataclass(frozen=True)
class Count:
    """A block for each whole number from `first` up to and without `end`."""

    name: str
    first: Expression
    end: Expression
    body: tuple[Statement, ...]


Statement: TypeAlias = "Assign | Store | Push | Evaluate | Return | If | While | Count"


@dataclass(eq=False)
class TypedFunction:
    """A function for arguments of certain types. What it calls may be called by others, too: the tree is a graph."""

    name: str
    parameters: dict[str, Type]
    returns: Type
    body: tuple[Statement, ...] = ()
    variables: dict[str, Type] = field(default_factory=dict)
    """Parameters, too."""
    is_operation: bool = False
    """Of an arithmetic."""
