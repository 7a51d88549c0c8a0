"""What names stand for in functions that are to be compiled, and where those functions stand.

A function is text with names around it: for a function of Python's, those of its module; for one of a kernel's text,
those that the kernel is given.
"""

from __future__ import annotations

import ast
import builtins
import inspect
import textwrap
from collections import ChainMap
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import FunctionType

Names = Mapping[str, Any]


class NotCompilableError(Exception):
    """The compiler does not know what stands there. The message says in which file and line."""


@dataclass(frozen=True, eq=False)
class Function:
    """A function before it has types."""

    definition: ast.FunctionDef
    names: Names
    file: str
    lines_before: int = 0
    """How many lines of the file stand before the text that was parsed."""
    is_operation: bool = False
    """Of an arithmetic: short, and called from everywhere."""

    @property
    def parameters(self) -> list[str]:
        """The names of its parameters."""
        return [argument.arg for argument in self.definition.args.args]

    def error(self, node: ast.AST, problem: str) -> NotCompilableError:
        """What to raise about a place in the function."""
        line = self.lines_before + getattr(node, "lineno", self.definition.lineno)
        text = "" if isinstance(node, ast.FunctionDef) else f": {ast.unparse(node).splitlines()[0]}"
        return NotCompilableError(f"{self.file}, line {line}, in {self.definition.name}: {problem}{text}")


def functions_of_text(text: str, file: str, names: Mapping[str, Any]) -> ChainMap[str, Any]:
    """What names stand for in a text of functions and whole-number constants: what it defines, and `names` besides.

    What `names` say goes before what the text says, so that an arithmetic replaces functions of the source.
    """
    own: dict[str, Any] = {}
    known = ChainMap(dict(names), own, vars(builtins))
    for statement in ast.parse(text).body:
        if isinstance(statement, ast.FunctionDef):
            own[statement.name] = Function(statement, known, file)
        elif isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            own[statement.targets[0].id] = ast.literal_eval(statement.value)
    return known


@cache
def function_of_python(function: FunctionType) -> Function:
    """A function of a module of Python's, as its file says it."""
    lines, first = inspect.getsourcelines(function)
    definition = ast.parse(textwrap.dedent("".join(lines))).body[0]
    assert isinstance(definition, ast.FunctionDef), f"{function.__name__} is no plain function"
    names: ChainMap[str, Any] = ChainMap(function.__globals__, vars(builtins))
    return Function(definition, names, function.__code__.co_filename, first - 1, is_operation=True)
