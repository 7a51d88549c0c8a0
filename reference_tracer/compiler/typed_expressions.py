"""From an expression of Python's syntax tree to one of the typed tree."""

from __future__ import annotations

import ast
from types import FunctionType, ModuleType
from typing import TYPE_CHECKING, Any

from raytruth.reference_tracer.compiler.exact_errors import product_error
from raytruth.reference_tracer.compiler.machine_code import has_fused_product
from raytruth.reference_tracer.compiler.names import Function, function_of_python
from raytruth.reference_tracer.compiler.overloads import (
    FUNCTIONS,
    OperandsError,
    alike,
    applied,
    operator_name,
    truth,
)
from raytruth.reference_tracer.compiler.questions import marks_taken, undecided
from raytruth.reference_tracer.compiler.typed_tree import (
    Build,
    Call,
    Conditional,
    Constant,
    Element,
    Expression,
    Local,
    Operation,
    Part,
    PartAt,
    Pop,
    Question,
)
from raytruth.reference_tracer.compiler.types import Array, Boolean, Float, Integer, Stack, Tuple, Type, shown, type_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from raytruth.reference_tracer.compiler.typed_tree import TypedFunction

QUESTIONS: dict[Any, Type] = {undecided: Boolean(), marks_taken: Integer()}
UNKNOWN = "the compiler does not know this"


class ExpressionTyper:
    """Types the expressions of one function, whose variables' types so far are in `variables`."""

    def __init__(
        self,
        function: Function,
        variables: dict[str, Type],
        table: dict[str, Any],
        instance: Callable[[Function, tuple[Type, ...]], TypedFunction],
    ) -> None:
        self.function, self.variables, self.table, self.instance = function, variables, table, instance

    def typed(self, node: ast.expr) -> Expression:
        """The typed expression. Raises NotCompilableError."""
        method = getattr(self, f"_{type(node).__name__.lower()}", None)
        if method is None:
            raise self.function.error(node, UNKNOWN)
        try:
            found: Expression = method(node)
        except OperandsError as error:
            raise self.function.error(node, str(error)) from error
        return found

    def test(self, node: ast.expr) -> Expression:
        """The typed expression as something that holds or does not."""
        try:
            return truth(self.typed(node))
        except OperandsError as error:
            raise self.function.error(node, str(error)) from error

    def _constant(self, node: ast.Constant) -> Expression:
        return self._of_value(node.value, node)

    def _name(self, node: ast.Name) -> Expression:
        if node.id in self.variables:
            return Local(node.id, self.variables[node.id])
        return self._of_value(self._meaning(node), node)

    def _attribute(self, node: ast.Attribute) -> Expression:
        if isinstance(node.value, ast.Name) and self._module(node.value) is not None:
            return self._of_value(self._meaning(node), node)
        whole = self.typed(node.value)
        if isinstance(whole.type, Tuple) and node.attr in whole.type.names:
            place = whole.type.names.index(node.attr)
            return Part(whole, place, whole.type.parts[place])
        raise self.function.error(node, f"{shown(whole.type)} has no part {node.attr}")

    def _tuple(self, node: ast.Tuple) -> Expression:
        parts = tuple(map(self.typed, node.elts))
        return Build(parts, Tuple(tuple(part.type for part in parts)))

    def _list(self, node: ast.List) -> Expression:
        if len(node.elts) != 1:
            raise self.function.error(node, "a list begins with one element, from which its type follows")
        element = self.typed(node.elts[0])
        return Build((element,), Stack(element.type))

    def _subscript(self, node: ast.Subscript) -> Expression:
        whole = self.typed(node.value)
        if isinstance(whole.type, Array):
            return Element(whole, self.places(node, whole.type), whole.type.element)
        if not isinstance(whole.type, Tuple):
            raise self.function.error(node, f"{shown(whole.type)} has no parts")
        place, parts = self.typed(node.slice), whole.type.parts
        if isinstance(place, Constant) and isinstance(place.type, Integer):
            if not 0 <= place.value < len(parts):
                raise self.function.error(node, f"{shown(whole.type)} has no such part")
            return Part(whole, int(place.value), parts[int(place.value)])
        if not isinstance(place.type, Integer) or len(set(parts)) != 1:
            raise self.function.error(node, "only a tuple of parts of one type is read at a computed place")
        return PartAt(whole, place, parts[0])

    def places(self, node: ast.Subscript, array: Array) -> tuple[Expression, ...]:
        """The places at which an array is read or written."""
        nodes = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        places = tuple(map(self.typed, nodes))
        if len(places) != array.dimensions or not all(isinstance(place.type, Integer) for place in places):
            raise self.function.error(node, f"the array has {array.dimensions} dimensions, each with a whole number")
        return places

    def _unaryop(self, node: ast.UnaryOp) -> Expression:
        if isinstance(node.op, ast.Not):
            return Operation("not", (self.test(node.operand),), Boolean())
        operand = self.typed(node.operand)
        if isinstance(node.op, ast.USub) and isinstance(operand, Constant):
            return Constant(-operand.value, operand.type)
        return self._applied(operator_name(node.op), [operand])

    def _binop(self, node: ast.BinOp) -> Expression:
        return self._applied(operator_name(node.op), [self.typed(node.left), self.typed(node.right)])

    def _compare(self, node: ast.Compare) -> Expression:
        """Of a < b < c the middle is computed twice, which makes no difference to what has no effects."""
        operands = [self.typed(operand) for operand in (node.left, *node.comparators)]
        tests = [
            self._applied(operator_name(comparison), operands[place : place + 2])
            for place, comparison in enumerate(node.ops)
        ]
        return self._joined("and", tests)

    def _boolop(self, node: ast.BoolOp) -> Expression:
        return self._joined(operator_name(node.op), [self.test(value) for value in node.values])

    def _joined(self, name: str, tests: Sequence[Expression]) -> Expression:
        """What follows is computed only where it matters."""
        *before, joined = tests
        for test in reversed(before):
            if name == "and":
                joined = Conditional(test, joined, Constant(value=False, type=Boolean()), Boolean())
            else:
                joined = Conditional(test, Constant(value=True, type=Boolean()), joined, Boolean())
        return joined

    def _ifexp(self, node: ast.IfExp) -> Expression:
        test = self.test(node.test)
        if_true, if_false = alike([self.typed(node.body), self.typed(node.orelse)])
        return Conditional(test, if_true, if_false, if_true.type)

    def _call(self, node: ast.Call) -> Expression:
        if node.keywords or any(isinstance(argument, ast.Starred) for argument in node.args):
            raise self.function.error(node, "arguments are passed by their places")
        if isinstance(node.func, ast.Attribute) and node.func.attr == "pop" and not node.args:
            stack = self.typed(node.func.value)
            if isinstance(stack.type, Stack):
                return Pop(stack, stack.type.element)
        called, arguments = self._meaning(node.func), [self.typed(argument) for argument in node.args]
        if called is len and isinstance(arguments[0].type, Stack):
            return Operation("len", (arguments[0],), Integer())
        return self.called(called, arguments, node)

    def called(self, function: Any, arguments: Sequence[Expression], node: ast.AST) -> Expression:
        """A call of what a name stands for."""
        if isinstance(function, type) and hasattr(function, "_fields"):
            kind = Tuple(tuple(argument.type for argument in arguments), function._fields, function.__name__)
            return Build(tuple(arguments), kind)
        if function in QUESTIONS and not arguments:
            return Question(function.__name__, QUESTIONS[function])
        if function is product_error and has_fused_product():
            return self._applied("product_error", arguments)
        if callable(function) and function in FUNCTIONS:
            return self._applied(FUNCTIONS[function], arguments)
        if isinstance(function, FunctionType):
            function = function_of_python(function)
        if not isinstance(function, Function):
            raise self.function.error(node, "the compiler does not know what is called here")
        if len(arguments) != len(function.parameters):
            raise self.function.error(node, f"{function.definition.name} takes {len(function.parameters)} arguments")
        typed = self.instance(function, tuple(argument.type for argument in arguments))
        return Call(typed, tuple(arguments), typed.returns)

    def _applied(self, name: str, operands: Sequence[Expression]) -> Expression:
        return applied(
            name, operands, self.table, lambda function, same: self.called(function, same, self.function.definition)
        )

    def _meaning(self, node: ast.expr) -> Any:
        """What a name, or a name of a module, stands for."""
        if isinstance(node, ast.Name) and node.id in self.function.names:
            return self.function.names[node.id]
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            module = self._module(node.value)
            if module is not None and hasattr(module, node.attr):
                return getattr(module, node.attr)
        raise self.function.error(node, "this name stands for nothing")

    def _module(self, node: ast.Name) -> ModuleType | None:
        """The module that a name stands for."""
        found = None if node.id in self.variables else self.function.names.get(node.id)
        return found if isinstance(found, ModuleType) else None

    def _of_value(self, value: Any, node: ast.AST) -> Expression:
        """A constant: a number, a truth value, or a NamedTuple of such."""
        kind = type_of(value)
        if kind is None:
            raise self.function.error(node, UNKNOWN)
        if isinstance(kind, Tuple):
            return Build(tuple(self._of_value(part, node) for part in value), kind)
        return Constant(float(value) if isinstance(kind, Float) else value, kind)
