"""Which clauses there are, and which tests and faults name them: read from the sources, which are not imported.

A test names its clauses by `@pytest.mark.clause("SPH-1", …)`, or a whole file by `pytestmark`. A fault names the clause
that it breaks as the first argument of the decorator that makes it.
"""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

SPECIFICATION = "docs/spec.md"
PROMISES = "docs/promises.md"
TESTS = "tests"
FAULTS = "comparisons/faults"

MARK = "pytest.mark.clause"
FAULT_DECORATORS = {"fault", "output_fault"}

_CLAUSE = re.compile(r"^- \*\*([A-Z]+-\d+)\*\*", re.MULTILINE)


class SourceError(Exception):
    """A file that cannot be read as Python, or names a clause otherwise than by its id; the message is one sentence."""


@dataclass(frozen=True)
class MarkedTest:
    """A test function, and the clauses that it names; those of its whole file are kept apart."""

    name: str
    own: tuple[str, ...]
    of_file: tuple[str, ...]


@dataclass(frozen=True)
class MarkedFault:
    """A fault, the clause that it breaks, and the function of the tracer that it replaces; None: it spoils an image."""

    name: str
    clause: str
    function: str | None


def clauses_of(root: Path, document: str) -> tuple[str, ...]:
    """The ids of a document's clauses, in its order."""
    return tuple(_CLAUSE.findall((root / document).read_text(encoding="utf-8")))


def all_clauses(root: Path) -> frozenset[str]:
    """The ids of all clauses: those of the specification and of the promises."""
    return frozenset((*clauses_of(root, SPECIFICATION), *clauses_of(root, PROMISES)))


def marked_tests(root: Path) -> dict[str, tuple[MarkedTest, ...]]:
    """The tests of each file under `tests`, by its path from the root. Raises SourceError."""
    return {path: marked_tests_in(path, text) for path, text in _sources(root, TESTS, "test_*.py")}


def marked_faults(root: Path) -> dict[str, tuple[MarkedFault, ...]]:
    """The faults of each file of the catalogue that has any, by its path from the root. Raises SourceError."""
    found = {path: marked_faults_in(path, text) for path, text in _sources(root, FAULTS, "*.py")}
    return {path: faults for path, faults in found.items() if faults}


@cache
def marked_tests_in(path: str, text: str) -> tuple[MarkedTest, ...]:
    """The test functions of a file and their clauses. Raises SourceError."""
    body = _parsed(path, text).body
    marks = [statement.value for statement in body if isinstance(statement, ast.Assign) and _is_pytestmark(statement)]
    of_file = tuple(clause for mark in marks for clause in _clauses_of_mark(path, mark))
    return tuple(
        MarkedTest(
            statement.name,
            tuple(clause for mark in statement.decorator_list for clause in _clauses_of_mark(path, mark)),
            of_file,
        )
        for statement in body
        if isinstance(statement, ast.FunctionDef) and statement.name.startswith("test_")
    )


@cache
def marked_faults_in(path: str, text: str) -> tuple[MarkedFault, ...]:
    """The faults that a file makes. Raises SourceError."""
    found = []
    for statement in _parsed(path, text).body:
        if isinstance(statement, ast.FunctionDef):
            for decorator in statement.decorator_list:
                if isinstance(decorator, ast.Call) and ast.unparse(decorator.func) in FAULT_DECORATORS:
                    function = _text(path, decorator.args[1]) if ast.unparse(decorator.func) == "fault" else None
                    found.append(MarkedFault(statement.name, _text(path, decorator.args[0]), function))
    return tuple(found)


def _sources(root: Path, folder: str, pattern: str) -> Iterator[tuple[str, str]]:
    for path in sorted((root / folder).rglob(pattern)):
        yield path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")


def _parsed(path: str, text: str) -> ast.Module:
    try:
        return ast.parse(text)
    except SyntaxError as error:
        raise SourceError(f"{path}, line {error.lineno}: this is not Python ({error.msg})") from error


def _is_pytestmark(statement: ast.Assign) -> bool:
    return [ast.unparse(target) for target in statement.targets] == ["pytestmark"]


def _clauses_of_mark(path: str, mark: ast.expr) -> Iterator[str]:
    """Of `pytest.mark.clause("SPH-1", "SPH-2")` or of a list of marks; none of other marks."""
    if isinstance(mark, ast.List):
        for one in mark.elts:
            yield from _clauses_of_mark(path, one)
    elif isinstance(mark, ast.Call) and ast.unparse(mark.func) == MARK:
        for argument in mark.args:
            yield _text(path, argument)


def _text(path: str, argument: ast.expr) -> str:
    if isinstance(argument, ast.Constant) and isinstance(argument.value, str):
        return argument.value
    raise SourceError(f"{path}, line {argument.lineno}: expected a text in quotes, found {ast.unparse(argument)}")
