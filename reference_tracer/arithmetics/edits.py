"""Edits of the tracer's source: what stands in one of its functions, and what a renderer or a fault has there instead.

Both are Python, compared as syntax trees, so that spaces, quotes and line breaks do not matter. An edited function is a
function like any other: it has a name, arguments and source, and can stand in for the one that it was made of.
"""

from __future__ import annotations

import ast
import builtins
import copy
import hashlib
import inspect
import linecache
import textwrap
from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import cache
from typing import Any

from raytruth.reference_tracer.arithmetics.arithmetic import MATH
from raytruth.reference_tracer.arithmetics.instantiation import source_module
from raytruth.reference_tracer.source import features

Function = Callable[..., Any]


@dataclass(frozen=True)
class Edit:
    """Put `new` where `old` stands, which has to be found exactly so many times.

    Either both are expressions, or both are one or more whole statements. A part of a sum is no expression of its own:
    `b + c` is not found in `a + b + c`. Nothing is also a run of statements: `new` may be empty.
    """

    old: str
    new: str
    times: int = 1


def before(statement: str, new: str) -> Edit:
    """Put new statements before one that stands there."""
    return Edit(statement, f"{_dedented(new)}\n{_dedented(statement)}")


def after(statement: str, new: str) -> Edit:
    """Put new statements behind one that stands there."""
    return Edit(statement, f"{_dedented(statement)}\n{_dedented(new)}")


def at_the_start(new: str) -> Edit:
    """Put new statements at the beginning of the function."""
    return Edit("", new)


def edited(function: str, *edits: Edit, of: Function | None = None, helpers: Collection[str] = ()) -> Function:
    """The tracer's function of this name, or another that stands in for it (`of`), with these edits made in turn.

    `helpers` are the names of functions beside the tracer's own that edits may use.

    Raises KeyError where the tracer has no such function. Raises ValueError where what an edit replaces is not there,
    or there another number of times than it says, and where an edit uses a name that the tracer does not know.
    """
    definition = _definition_of(function, of)
    known = _names_of_the_tracer() | _names(definition) | frozenset(helpers)
    for edit in edits:
        found = _make(edit, definition)
        if found != edit.times:
            raise ValueError(
                f"{function}: expected {edit.old!r} to stand there {edit.times} times, found it {found} times"
            )
    unknown = _names(definition) - _names(definition, ast.Store) - known
    if unknown:
        raise ValueError(f"{function}: the tracer does not know {', '.join(sorted(unknown))}, which an edit uses")
    return _function_of(definition)


def _definition_of(function: str, of: Function | None) -> ast.FunctionDef:
    if of is None:
        named = {node.name: node for node in source_module().body if isinstance(node, ast.FunctionDef)}
        return copy.deepcopy(named[function])
    definition = ast.parse(textwrap.dedent(inspect.getsource(of))).body[0]
    assert isinstance(definition, ast.FunctionDef), f"{function}: only plain functions can be edited"
    definition.decorator_list = []
    if ast.get_docstring(definition) is not None:
        definition.body = definition.body[1:]
    return definition


def _make(edit: Edit, definition: ast.FunctionDef) -> int:
    """Make an edit, and tell in how many places."""
    old, new = _statements(edit.old), _statements(edit.new)
    if not old:
        definition.body = [*new, *definition.body]
        return 1
    replacing: _ExpressionReplacer | _StatementsReplacer = _StatementsReplacer(old, new)
    if len(old) == len(new) == 1 and isinstance(old[0], ast.Expr) and isinstance(new[0], ast.Expr):
        replacing = _ExpressionReplacer(old[0].value, new[0].value)
    replacing.visit(definition)
    return replacing.found


class _ExpressionReplacer(ast.NodeTransformer):
    """Replaces an expression wherever it stands, and counts."""

    def __init__(self, old: ast.expr, new: ast.expr) -> None:
        self.old, self.new, self.found = ast.dump(old), new, 0

    def visit(self, node: ast.AST) -> ast.AST:
        if ast.dump(node) == self.old:
            self.found += 1
            return copy.deepcopy(self.new)
        return self.generic_visit(node)


class _StatementsReplacer(ast.NodeTransformer):
    """Replaces a run of statements in whatever block it stands, and counts."""

    def __init__(self, old: list[ast.stmt], new: list[ast.stmt]) -> None:
        self.old, self.new, self.found = _dumps(old), new, 0

    def visit(self, node: ast.AST) -> ast.AST:
        self.generic_visit(node)  # the inner blocks first, so that nothing is looked for in what has been put there
        for name in ("body", "orelse"):
            block = getattr(node, name, None)
            if isinstance(block, list):
                setattr(node, name, self._replaced(block))
        return node

    def _replaced(self, block: list[ast.stmt]) -> list[ast.stmt]:
        kept: list[ast.stmt] = []
        while block:
            if _dumps(block[: len(self.old)]) == self.old:
                self.found += 1
                kept, block = [*kept, *copy.deepcopy(self.new)], block[len(self.old) :]
            else:
                kept, block = [*kept, block[0]], block[1:]
        return kept


def _function_of(definition: ast.FunctionDef) -> Function:
    """A function of this definition, with its text where inspect.getsource looks for text that stands in no file."""
    text = ast.unparse(definition) + "\n"
    file = f"<{definition.name}, edited: {hashlib.sha256(text.encode()).hexdigest()}>"
    names: dict[str, Any] = {"__name__": __name__}
    exec(compile(text, file, "exec"), names)
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
    made: Function = names[definition.name]
    return made


def _statements(text: str) -> list[ast.stmt]:
    return ast.parse(_dedented(text)).body


def _dedented(text: str) -> str:
    return textwrap.dedent(text).strip()


def _dumps(statements: list[ast.stmt]) -> list[str]:
    return [ast.dump(statement) for statement in statements]


def _names(definition: ast.FunctionDef, context: type[ast.expr_context] = ast.expr_context) -> set[str]:
    """The names in a function, also of its arguments; of those that it assigns alone for ast.Store."""
    arguments = {argument.arg for argument in definition.args.args}
    names = (node for node in ast.walk(definition) if isinstance(node, ast.Name) and isinstance(node.ctx, context))
    return arguments | {node.id for node in names}


@cache
def _names_of_the_tracer() -> frozenset[str]:
    """What every function of a kernel may use: the others, constants, features, and Python's and math's functions."""
    statements = source_module().body
    functions = {node.name for node in statements if isinstance(node, ast.FunctionDef)}
    constants = {ast.unparse(target) for node in statements if isinstance(node, ast.Assign) for target in node.targets}
    return frozenset({*functions, *constants, *vars(features), *MATH, *vars(builtins)})
