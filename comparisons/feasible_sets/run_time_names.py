"""Names of a kernel's text as values of its state, so that one kernel serves many scenes and error models.

Features, the constants of behaviours, π, and literals that a renderer may round when it stores them.
"""

from __future__ import annotations

import ast
import math
from typing import TYPE_CHECKING

from raytruth.reference_tracer.arithmetics.instantiation import SOURCE_FEATURES

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

FEATURES = tuple(sorted(SOURCE_FEATURES))
"""In the order of the state's."""
PI = "pi"
LEAST_PRECISION_BITS = 8
"""Literals of so many bits or fewer are the same in all arithmetics that compiled evaluators serve."""


def is_short(value: float) -> bool:
    """Whether a literal is exact in all of these arithmetics."""
    return not math.isfinite(value) or (math.frexp(value)[0] * 2.0**LEAST_PRECISION_BITS).is_integer()


def with_run_time_names(text: str, numbers: Sequence[str], lists: Sequence[str], around: Sequence[str]) -> str:
    """The text, in which features and these numbers and lists of numbers are read from the state.

    The functions `around` which others are put are called inner_NAME, so that these are found in their places.
    """
    module = ast.parse(text)
    numbered = {name: place for place, name in enumerate(numbers)}
    starts = {name: place for place, name in enumerate(lists)}
    for function in module.body:
        if isinstance(function, ast.FunctionDef):
            if function.name in around:
                function.name = f"inner_{function.name}"
            _RunTimeNames(function, numbered, starts).visit(function)
    return ast.unparse(ast.fix_missing_locations(module))


class _RunTimeNames(ast.NodeTransformer):
    def __init__(self, function: ast.FunctionDef, numbers: Mapping[str, int], lists: Mapping[str, int]) -> None:
        stored = {
            node.id for node in ast.walk(function) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }
        self.own = stored | {argument.arg for argument in function.args.args}
        self.numbers, self.lists = numbers, lists

    def visit_Subscript(self, node: ast.Subscript) -> ast.expr:
        if isinstance(node.value, ast.Name) and self._is_list(node.value):
            return self._listed(node.value.id, ast.unparse(self.visit(node.slice)))
        node.value, node.slice = self.visit(node.value), self.visit(node.slice)
        return node

    def visit_Name(self, node: ast.Name) -> ast.expr:
        if node.id in self.own:
            return node
        if node.id in SOURCE_FEATURES:
            return _parsed(f"state().features[{FEATURES.index(node.id)}]")
        if node.id in self.numbers:
            return _parsed(f"state().constants[{self.numbers[node.id]}]")
        if node.id in self.lists:  # a vector
            parts = [ast.unparse(self._listed(node.id, str(place))) for place in range(3)]
            return _parsed(f"({', '.join(parts)})")
        return node

    def _is_list(self, name: ast.Name) -> bool:
        return name.id in self.lists and name.id not in self.own

    def _listed(self, name: str, place: str) -> ast.expr:
        return _parsed(f"state().constants[state().starts[{self.lists[name]}] + {place}]")


def _parsed(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body
