"""The changes that instantiation.py makes in the syntax tree of the tracer's source, one after the other."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

LITERAL_PREFIX = "number_"
COMPARISONS: dict[type[ast.cmpop], str] = {
    ast.Lt: "is_less",
    ast.Gt: "is_greater",
    ast.LtE: "is_less_or_equal",
    ast.GtE: "is_greater_or_equal",
    ast.Eq: "is_equal",
    ast.NotEq: "is_different",
}
"""The functions that decide comparisons where the number type cannot."""


class FeaturePruner(ast.NodeTransformer):
    """Replaces feature names by True and False and drops the branches that cannot be taken."""

    def __init__(self, values: Mapping[str, bool]) -> None:
        self.values = values

    def prune(self, function: ast.FunctionDef) -> ast.FunctionDef:
        """A copy of the function without what cannot run."""
        pruned: ast.FunctionDef = self.visit(ast.parse(ast.unparse(function)).body[0])
        return _without_unreachable_tail(pruned)

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return ast.Constant(self.values[node.id]) if node.id in self.values else node

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.expr:
        absorbing = isinstance(node.op, ast.Or)
        operands = [self.visit(operand) for operand in node.values]
        if any(isinstance(operand, ast.Constant) and operand.value is absorbing for operand in operands):
            return ast.Constant(absorbing)
        open_operands = [operand for operand in operands if not isinstance(operand, ast.Constant)]
        if not open_operands:
            return ast.Constant(not absorbing)
        return open_operands[0] if len(open_operands) == 1 else ast.BoolOp(op=node.op, values=open_operands)

    def visit_If(self, node: ast.If) -> ast.stmt | list[ast.stmt]:
        test = self.visit(node.test)
        if isinstance(test, ast.Constant):
            return _flat(self.visit(statement) for statement in (node.body if test.value else node.orelse))
        return ast.If(
            test=test,
            body=_flat(self.visit(statement) for statement in node.body) or [ast.Pass()],
            orelse=_flat(self.visit(statement) for statement in node.orelse),
        )


def _flat(statements: object) -> list[ast.stmt]:
    flat: list[ast.stmt] = []
    for statement in statements:  # type: ignore[attr-defined]
        flat.extend(_flat(statement) if isinstance(statement, list) else [statement])
    return flat


def _without_unreachable_tail(function: ast.FunctionDef) -> ast.FunctionDef:
    """What stands behind a return cannot run."""
    body = _flat(function.body)
    for place, statement in enumerate(body):
        if isinstance(statement, ast.Return):
            body = body[: place + 1]
            break
    function.body = body
    return function


class LiteralNamer(ast.NodeTransformer):
    """Gives each literal a name, as in `number_0_5`, and remembers its value."""

    def __init__(self, names: dict[str, float]) -> None:
        self.names = names

    def visit_Constant(self, node: ast.Constant) -> ast.expr:
        if not isinstance(node.value, float):
            return node
        name = LITERAL_PREFIX + repr(node.value).replace(".", "_").replace("-", "minus_").replace("+", "")
        self.names[name] = node.value
        return ast.Name(id=name, ctx=ast.Load())


class ComparisonCalls(ast.NodeTransformer):
    """Turns a < b into is_less(a, b), and a ** b into power(a, b)."""

    def visit_Compare(self, node: ast.Compare) -> ast.expr:
        assert len(node.ops) == 1, f"a chained comparison cannot be decided in one go: {ast.unparse(node)}"
        operands: list[ast.expr] = [self.visit(node.left), self.visit(node.comparators[0])]
        return ast.Call(func=ast.Name(id=COMPARISONS[type(node.ops[0])], ctx=ast.Load()), args=operands, keywords=[])

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        node.left, node.right = self.visit(node.left), self.visit(node.right)
        if isinstance(node.op, ast.Pow):
            return ast.Call(func=ast.Name(id="power", ctx=ast.Load()), args=[node.left, node.right], keywords=[])
        return node


class GuardedDivisions(ast.NodeTransformer):
    """Turns a / b into (a / divisor if (divisor := b) else over_zero(a, divisor)): no call where nothing is wrong."""

    def __init__(self) -> None:
        self.count = 0

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        node.left, node.right = self.visit(node.left), self.visit(node.right)
        if not isinstance(node.op, ast.Div):
            return node
        self.count += 1
        name = f"divisor_{self.count}"  # the dividend, evaluated next, may hold another division
        divisor = ast.Name(id=name, ctx=ast.Load())
        return ast.IfExp(
            test=ast.NamedExpr(target=ast.Name(id=name, ctx=ast.Store()), value=node.right),
            body=ast.BinOp(left=node.left, op=ast.Div(), right=divisor),
            orelse=ast.Call(func=ast.Name(id="over_zero", ctx=ast.Load()), args=[node.left, divisor], keywords=[]),
        )


class Roundings(ast.NodeTransformer):
    """Turns a * b into a * b * roundoff_factor; where whole numbers may be meant, a + b into rounded(a + b)."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        is_of_numbers = _is_of_numbers(node)
        node.left, node.right = self.visit(node.left), self.visit(node.right)
        if is_of_numbers:
            return ast.BinOp(left=node, op=ast.Mult(), right=ast.Name(id="roundoff_factor", ctx=ast.Load()))
        return ast.Call(func=ast.Name(id="rounded", ctx=ast.Load()), args=[node], keywords=[])


def _is_of_numbers(node: ast.expr) -> bool:
    """Whether an expression surely has the kernel's number type: whole numbers are only added and counted."""
    if isinstance(node, ast.BinOp):
        return isinstance(node.op, ast.Mult | ast.Div) or _is_of_numbers(node.left) or _is_of_numbers(node.right)
    if isinstance(node, ast.UnaryOp):
        return _is_of_numbers(node.operand)
    is_coordinate = isinstance(node, ast.Subscript)
    return is_coordinate or (isinstance(node, ast.Name) and node.id.startswith(LITERAL_PREFIX))
