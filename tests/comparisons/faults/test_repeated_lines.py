"""A fault shows its mistake, and repeats neither the tracer nor another fault."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections import Counter
from pathlib import Path

import pytest

from raytruth.comparisons.faults import catalogue
from raytruth.reference_tracer.arithmetics import edits
from raytruth.reference_tracer.arithmetics.instantiation import source_module

pytestmark = pytest.mark.clause("PRJ-6")

FOLDER = Path(inspect.getfile(catalogue)).parent
EDITS = {edits.Edit.__name__, edits.before.__name__, edits.after.__name__, edits.at_the_start.__name__}

MOST_REPEATED_LINES = 84
"""A tenth of the 849 repeated ones, of 1,120, that the faults had when each was a whole function."""


def test_hardly_a_line_of_a_fault_repeats_the_tracer_or_another_fault() -> None:
    """Counted are the lines that a fault of the tracer writes, as ast.unparse writes them.

    They are those of its own function, without docstring, and of its edits: the statements that are put there as well
    as those that they are put beside or in the place of. An edit of an expression is one line: the function, what
    stands there, and what is put there. Repeated is a line of the tracer's function, or one that another fault writes.
    """
    tracer = {node.name: lines_of(node.body) for node in source_module().body if isinstance(node, ast.FunctionDef)}
    written = written_lines()
    faults = Counter(line for _, lines in written.values() for line in set(lines))
    repeated = {
        name: [line for line in lines if line in tracer[function] or faults[line] > 1]
        for name, (function, lines) in written.items()
    }
    total = sum(len(lines) for _, lines in written.values())
    count = sum(len(lines) for lines in repeated.values())
    assert count <= MOST_REPEATED_LINES, f"{count} of {total} lines: {repeated}"


def written_lines() -> dict[str, tuple[str, list[str]]]:
    """Of each fault that stands in for a function of the tracer: that function's name, and the lines it writes."""
    found = {}
    for path in sorted(FOLDER.glob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef):
                for decorator in node.decorator_list:
                    if isinstance(decorator, ast.Call) and ast.unparse(decorator.func) == "fault":
                        function = ast.literal_eval(decorator.args[1])
                        lines = [line for edit in decorator.args[3:] for line in lines_of_edit(function, edit)]
                        found[node.name] = (function, [*lines_of(node.body[1:]), *lines])
    return found


def lines_of_edit(function: str, edit: ast.expr) -> list[str]:
    assert isinstance(edit, ast.Call)
    assert ast.unparse(edit.func) in EDITS
    texts = [ast.parse(textwrap.dedent(ast.literal_eval(text)).strip()).body for text in edit.args]
    if all(len(statements) == 1 and isinstance(statements[0], ast.Expr) for statements in texts):
        return [" → ".join([function, *(ast.unparse(statements) for statements in texts)])]
    return [line for statements in texts for line in lines_of(statements)]


def lines_of(statements: list[ast.stmt]) -> list[str]:
    return [line.strip() for statement in statements for line in ast.unparse(statement).splitlines()]
