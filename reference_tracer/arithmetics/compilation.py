"""Kernels as files that Numba compiles, and that other processes find compiled (docs: https://numba.pydata.org)."""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numba
import numpy as np

from raytruth.reference_tracer.arithmetics import compiled_stack
from raytruth.reference_tracer.arithmetics.instantiation import COMPILED_ENTRY_POINTS
from raytruth.reference_tracer.storage.cache import cache_folder
from raytruth.reference_tracer.storage.whole_files import write_whole

if TYPE_CHECKING:
    from collections.abc import Mapping
    from types import ModuleType

STACK_METHODS = {"append": "push", "pop": "pop"}


def compiled_text(source: str, numbers: Mapping[str, float], number_type: str) -> str:
    """The source of a kernel as a file that compiles itself; `number_type` is NumPy's name, as in `float64`.

    `numbers` are its literals and constants by name.
    """
    lines = [
        f'"""A kernel of the tracer in {number_type}; made from its source, do not edit."""',
        "from math import exp, floor, sqrt, tan",
        f"from numpy import int64, {number_type}, uint64",
        f"from {compiled_stack.__name__} import entry_point, height_of, inlined, new_stack, pop, push",
        f"float = {number_type}",
        f"inf = {number_type}('inf')",
        f"pi = {number_type}({math.pi!r})",
        *(f"{name} = {number_type}({value!r})" for name, value in sorted(numbers.items())),
        ast.unparse(ast.fix_missing_locations(_CompiledForms().visit(ast.parse(source)))),
    ]
    return "\n".join(lines) + "\n"


class _CompiledForms(ast.NodeTransformer):
    """Says the same in the forms that compile well."""

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.stmt:
        self.generic_visit(node)
        node.decorator_list = [_name("entry_point" if node.name in COMPILED_ENTRY_POINTS else "inlined")]
        return node

    def visit_Assign(self, node: ast.Assign) -> ast.stmt:
        """Whole-number constants: a function is compiled anew for each Python number, but not for each int64."""
        self.generic_visit(node)
        if isinstance(node.value, ast.Constant | ast.UnaryOp) and ast.unparse(node.targets[0]).isupper():
            node.value = _call("int64", node.value)
        return node

    def visit_Subscript(self, node: ast.Subscript) -> ast.expr:
        """Places in the scene's arrays: a signed one could be negative, and so count from the end."""
        self.generic_visit(node)
        if isinstance(node.value, ast.Attribute):
            node.slice = _call("uint64", node.slice)
        return node

    def visit_List(self, node: ast.List) -> ast.expr:
        """The only list is that of the rays that wait."""
        self.generic_visit(node)
        return _call("new_stack", *node.elts)

    def visit_Call(self, node: ast.Call) -> ast.expr:
        self.generic_visit(node)
        if isinstance(node.func, ast.Attribute):
            return _call(STACK_METHODS[node.func.attr], node.func.value, *node.args)
        if isinstance(node.func, ast.Name) and node.func.id == "len":
            node.func.id = "height_of"
        return node


def _name(name: str) -> ast.Name:
    return ast.Name(id=name, ctx=ast.Load())


def _call(function: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(func=_name(function), args=list(arguments), keywords=[])


def compiled_module(text: str) -> ModuleType:
    """Import the text from a file of its own, named by the hash of all that is compiled with it.

    The compiler keeps what it made beside that file, and would not notice a change in another file.
    """
    stack = f"{compiled_stack.CAPACITY}\n{Path(compiled_stack.__file__).read_text(encoding='utf-8')}"
    everything = f"{numba.__version__}\n{np.__version__}\n{stack}\n{text}"
    path = cache_folder() / "kernels" / f"kernel_{hashlib.sha256(everything.encode()).hexdigest()[:16]}.py"
    if not path.exists():
        path.parent.mkdir(exist_ok=True)
        write_whole(path, text)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module  # where the compiler looks for it when it loads what it has kept
    spec.loader.exec_module(module)
    return module
