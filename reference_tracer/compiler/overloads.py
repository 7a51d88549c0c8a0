"""What an operator or one of Python's own functions does, which follows from the types of its operands.

On floats, whole numbers and truth values it is an operation of the machine. On numbers that are NamedTuples it is a
function of the arithmetic: the one that its table has under the operator's name.
"""

from __future__ import annotations

import math
import operator
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.reference_tracer.compiler.typed_tree import Constant, Operation
from raytruth.reference_tracer.compiler.types import Boolean, Float, Integer, Tuple, shown

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from raytruth.reference_tracer.compiler.typed_tree import Expression
    from raytruth.reference_tracer.compiler.types import Type

    Caller = Callable[[Any, Sequence[Expression]], Expression]
    """Calls a function of the arithmetic's table."""

COMPARISONS = {"lt", "le", "gt", "ge", "eq", "ne"}
SWAPPED = {"gt": "lt", "ge": "le"}
"""a > b is b < a: a table of operations need not have both."""
OF_FLOATS = {"add", "sub", "mul", "truediv", "neg", "pow", "sqrt", "exp", "tan", "fabs", "copysign", "product_error"}
OF_INTEGERS = {"add", "sub", "mul", "mod", "floordiv", "neg", "and_", "or_", "lshift", "rshift"}
FUNCTIONS: dict[Any, str] = {
    abs: "abs",
    float: "float64",
    max: "max",
    min: "min",
    math.copysign: "copysign",
    math.exp: "exp",
    math.fabs: "fabs",
    math.floor: "floor",
    math.isnan: "isnan",
    math.sqrt: "sqrt",
    math.tan: "tan",
    np.float32: "float32",
    np.float64: "float64",
}
"""Python's own functions, as operations."""
CONVERSIONS = {"float64": Float(64), "float32": Float(32)}
NARROWED = {"abs": "fabs"}
"""On floats these are operations of another name."""


class OperandsError(Exception):
    """No operation of this name takes operands of these types."""


def applied(
    name: str,
    operands: Sequence[Expression],
    table: dict[str, Any],
    call: Caller,
) -> Expression:
    """The expression that applies an operation to operands.

    Raises OperandsError.
    """
    if name in {"max", "min"} and len(operands) > 2:
        *others, last = operands
        return applied(name, [applied(name, others, table, call), last], table, call)
    if any(isinstance(operand.type, Tuple) for operand in operands):
        return _of_the_table(name, operands, table, call)
    if name in CONVERSIONS and len(operands) == 1:
        return _converted(operands[0], CONVERSIONS[name])
    operands = alike(operands)
    kinds = [operand.type for operand in operands]
    return _machine_operation(name, operands, kinds)


def _of_the_table(
    name: str,
    operands: Sequence[Expression],
    table: dict[str, Any],
    call: Caller,
) -> Expression:
    if name == "ne":
        return Operation("not", (_of_the_table("eq", operands, table, call),), Boolean())
    if name in SWAPPED:
        return _of_the_table(SWAPPED[name], operands[::-1], table, call)
    if name not in table:
        raise OperandsError(f"the arithmetic has no operation '{name}' for {_shown(operands)}")
    number = next(operand.type for operand in operands if isinstance(operand.type, Tuple))
    same = [
        call(table["float"], [operand]) if isinstance(operand.type, Integer) and "float" in table else operand
        for operand in operands
    ]
    if any(operand.type != number for operand in same):
        raise OperandsError(f"the operation '{name}' takes numbers of one type, not {_shown(operands)}")
    return call(table[name], same)


def _machine_operation(name: str, operands: Sequence[Expression], kinds: list[Type]) -> Expression:
    kind = kinds[0]
    if isinstance(kind, Float):
        operation = NARROWED.get(name, name)
        if operation in COMPARISONS and len(kinds) == 2:
            return Operation(operation, tuple(operands), Boolean())
        if operation in {"floor", "isnan"} and len(kinds) == 1:
            return Operation(operation, tuple(operands), Integer() if operation == "floor" else Boolean())
        if operation in OF_FLOATS | {"max", "min"} and _fits(operation, len(kinds)):
            return Operation(operation, tuple(operands), kind)
    if isinstance(kind, Integer):
        if name in COMPARISONS and len(kinds) == 2:
            return Operation(name, tuple(operands), Boolean())
        if name in OF_INTEGERS | {"max", "min"} and _fits(name, len(kinds)):
            _refuse_zero(name, operands)
            return Operation(name, tuple(operands), kind)
    if isinstance(kind, Boolean) and name in {"eq", "ne", "and_", "or_"}:
        return Operation(name, tuple(operands), kind)
    raise OperandsError(f"there is no operation '{name}' for {_shown(operands)}")


def _fits(name: str, count: int) -> bool:
    return count == (1 if name in {"neg", "sqrt", "exp", "tan", "fabs"} else 2)


def _refuse_zero(name: str, operands: Sequence[Expression]) -> None:
    """The machine stops a program that divides whole numbers by zero, so the divisor must be seen not to be."""
    if name in {"mod", "floordiv"}:
        divisor = operands[1]
        if not (isinstance(divisor, Constant) and divisor.value > 0):
            raise OperandsError("whole numbers are divided only by a positive constant")


def alike(operands: Sequence[Expression]) -> list[Expression]:
    """Operands of one type: beside a float a whole number becomes one. Raises OperandsError."""
    widest = next((operand.type for operand in operands if isinstance(operand.type, Float)), operands[0].type)
    same = [_converted(operand, widest) if isinstance(widest, Float) else operand for operand in operands]
    if any(operand.type != widest for operand in same):
        raise OperandsError(f"{_shown(operands)} have no type in common")
    return same


def _converted(operand: Expression, kind: Float) -> Expression:
    if operand.type == kind:
        return operand
    if isinstance(operand, Constant) and isinstance(operand.type, Integer):
        return Constant(float(operand.value), kind)
    if isinstance(operand.type, Integer):
        return Operation("float", (operand,), kind)
    raise OperandsError(f"{shown(operand.type)} does not become {shown(kind)} by itself")


def truth(value: Expression) -> Expression:
    """Whether a value counts as true. Raises OperandsError for what is neither a number nor a truth value."""
    if isinstance(value.type, Boolean):
        return value
    if isinstance(value.type, Integer | Float):
        return Operation("ne", (value, Constant(0, value.type)), Boolean())
    raise OperandsError(f"{shown(value.type)} is neither true nor false")


def _shown(operands: Sequence[Expression]) -> str:
    return " and ".join(shown(operand.type) for operand in operands)


def operator_name(node: object) -> str:
    """The name in module `operator` of a syntax tree's operator: `add` for ast.Add."""
    names = {"Mult": "mul", "Div": "truediv", "FloorDiv": "floordiv", "USub": "neg", "NotEq": "ne", "Lt": "lt"}
    names |= {"LtE": "le", "Gt": "gt", "GtE": "ge", "Eq": "eq", "BitAnd": "and_", "BitOr": "or_"}
    names |= {"LShift": "lshift", "RShift": "rshift"}
    name = type(node).__name__
    found = names.get(name, name.lower())
    assert hasattr(operator, found) or found in {"and", "or", "not"}, name
    return found
