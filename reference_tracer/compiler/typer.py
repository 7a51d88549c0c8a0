"""The forward pass: from functions of Python's syntax to typed functions.

A function is typed for the types of the arguments that it is called with, statement by statement, in the order in which
they stand: a variable has the type of the first value that it gets, and keeps it.
"""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any

from raytruth.reference_tracer.compiler.overloads import OperandsError, alike
from raytruth.reference_tracer.compiler.typed_expressions import UNKNOWN, ExpressionTyper
from raytruth.reference_tracer.compiler.typed_tree import (
    Assign,
    Constant,
    Count,
    Evaluate,
    Expression,
    If,
    Local,
    Part,
    Push,
    Return,
    Statement,
    Store,
    TypedFunction,
    While,
)
from raytruth.reference_tracer.compiler.types import Array, Integer, Nothing, Stack, Tuple, Type, shown

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from raytruth.reference_tracer.compiler.names import Function


class Typer:
    """Types functions, each once for the types that it is called with; `table` holds the arithmetic's operations."""

    def __init__(self, table: Mapping[str, Any]) -> None:
        self.table = dict(table)
        self.typed: dict[tuple[Function, tuple[Type, ...]], TypedFunction | None] = {}

    def instance(self, function: Function, kinds: tuple[Type, ...]) -> TypedFunction:
        """The typed function. Raises NotCompilableError."""
        key = (function, kinds)
        if key not in self.typed:
            self.typed[key] = None
            self.typed[key] = _FunctionTyper(self, function, kinds).typed()
        found = self.typed[key]
        if found is None:
            raise function.error(function.definition, "a function does not call itself")
        return found


class _FunctionTyper:
    def __init__(self, typer: Typer, function: Function, kinds: tuple[Type, ...]) -> None:
        self.function = function
        self.parameters = dict(zip(function.parameters, kinds, strict=True))
        self.variables = dict(self.parameters)
        self.returns: Type | None = None
        self.expressions = ExpressionTyper(function, self.variables, typer.table, typer.instance)

    def typed(self) -> TypedFunction:
        definition = self.function.definition
        body = self._block(definition.body)
        returns = self.returns or Nothing()
        return TypedFunction(
            definition.name, self.parameters, returns, body, self.variables, self.function.is_operation
        )

    def _block(self, nodes: Sequence[ast.stmt]) -> tuple[Statement, ...]:
        return tuple(statement for node in nodes for statement in self._statements(node))

    def _statements(self, node: ast.stmt) -> list[Statement]:
        method = getattr(self, f"_{type(node).__name__.lower()}", None)
        if method is None:
            raise self.function.error(node, UNKNOWN)
        found: list[Statement] = method(node)
        return found

    def _pass(self, _node: ast.Pass) -> list[Statement]:
        return []

    def _return(self, node: ast.Return) -> list[Statement]:
        value = None if node.value is None else self.expressions.typed(node.value)
        kind = Nothing() if value is None else value.type
        if self.returns not in {None, kind}:
            raise self.function.error(node, f"{shown(kind)} is returned here, and {shown(self.returns)} elsewhere")
        self.returns = kind
        return [Return(value)]

    def _assign(self, node: ast.Assign) -> list[Statement]:
        if len(node.targets) != 1:
            raise self.function.error(node, UNKNOWN)
        return self._bound(node.targets[0], self.expressions.typed(node.value))

    def _annassign(self, node: ast.AnnAssign) -> list[Statement]:
        if node.value is None:
            return []
        return self._bound(node.target, self.expressions.typed(node.value))

    def _augassign(self, node: ast.AugAssign) -> list[Statement]:
        target = ast.copy_location(ast.parse(ast.unparse(node.target), mode="eval").body, node)
        value = ast.copy_location(ast.BinOp(target, node.op, node.value), node)
        return self._bound(node.target, self.expressions.typed(value))

    def _bound(self, target: ast.expr, value: Expression) -> list[Statement]:
        """The statements that give a value to a variable, to an element of an array, or part by part to several."""
        if isinstance(target, ast.Name):
            return [self._assigned(target, value)]
        if isinstance(target, ast.Subscript):
            array = self.expressions.typed(target.value)
            if isinstance(array.type, Array) and array.type.element == value.type:
                return [Store(array, self.expressions.places(target, array.type), value)]
        parts = value.type.parts if isinstance(value.type, Tuple) else ()
        if isinstance(target, ast.Tuple) and len(target.elts) == len(parts):
            whole = Local(f"all of {ast.unparse(target)}", value.type)
            self.variables[whole.name] = whole.type
            bound = [self._bound(part, Part(whole, place, parts[place])) for place, part in enumerate(target.elts)]
            return [Assign(whole.name, value), *(statement for some in bound for statement in some)]
        raise self.function.error(target, f"{shown(value.type)} cannot be assigned to this")

    def _assigned(self, target: ast.Name, value: Expression) -> Statement:
        kind = self.variables.setdefault(target.id, value.type)
        if kind != value.type:
            try:
                _, value = alike([Local(target.id, kind), value])
            except OperandsError as error:
                raise self.function.error(target, str(error)) from error
        if kind != value.type:
            raise self.function.error(target, f"this has been {shown(kind)} before, and is {shown(value.type)} here")
        return Assign(target.id, value)

    def _if(self, node: ast.If) -> list[Statement]:
        test = self.expressions.test(node.test)
        return [If(test, self._block(node.body), self._block(node.orelse))]

    def _while(self, node: ast.While) -> list[Statement]:
        if node.orelse:
            raise self.function.error(node, UNKNOWN)
        return [While(self.expressions.test(node.test), self._block(node.body))]

    def _for(self, node: ast.For) -> list[Statement]:
        """Only over a range."""
        call, name = node.iter, node.target
        if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "range"):
            raise self.function.error(node, "a loop is over a range")
        if not isinstance(name, ast.Name) or node.orelse or not 1 <= len(call.args) <= 2:
            raise self.function.error(node, UNKNOWN)
        limits = [self.expressions.typed(argument) for argument in call.args]
        first, end = limits if len(limits) == 2 else (Constant(0, Integer()), limits[0])
        if not first.type == end.type == self.variables.setdefault(name.id, Integer()) == Integer():
            raise self.function.error(node, "a range is of whole numbers")
        return [Count(name.id, first, end, self._block(node.body))]

    def _expr(self, node: ast.Expr) -> list[Statement]:
        value = node.value
        if isinstance(value, ast.Constant):
            return []  # a docstring
        if isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute) and value.func.attr == "append":
            stack, (element,) = self.expressions.typed(value.func.value), map(self.expressions.typed, value.args)
            if stack.type != Stack(element.type):
                raise self.function.error(node, f"{shown(element.type)} is put into {shown(stack.type)}")
            return [Push(stack, element)]
        return [Evaluate(self.expressions.typed(value))]
