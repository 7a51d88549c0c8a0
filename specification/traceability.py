"""The traceability table: clause → tests → faults, what is missing in it, and its committed form.

Every clause of the specification needs a test and a fault of the catalogue, every promise of the suite a test, and
every test a clause. The table is committed, so that a test or fault that goes is missed though others hold its clause.
"""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.specification.clauses import PROMISES, SPECIFICATION, clauses_of, marked_faults, marked_tests

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from raytruth.specification.clauses import MarkedFault, MarkedTest

TABLE = "docs/traceability.md"
REWRITE = "raytruth spec --write"

HEAD = f"""# Which tests and faults hold each clause

`{REWRITE}` writes this file: do not edit it by hand. A test file without a test's name stands for all its tests.
"""


@dataclass(frozen=True)
class Trace:
    """A clause and what names it."""

    clause: str
    needs_fault: bool
    tests: tuple[str, ...]
    """As in `tests/properties/test_sphere.py::test_…`; the file alone where all its tests name the clause."""
    faults: tuple[MarkedFault, ...]


@dataclass(frozen=True)
class Traceability:
    """All clauses, and what is wrong in their table, each in one sentence."""

    traces: tuple[Trace, ...]
    findings: tuple[str, ...]


def traceability(root: Path) -> Traceability:
    """The traceability of the project whose checkout is in `root`. Raises SourceError for a file that is not Python."""
    tests, faults = marked_tests(root), marked_faults(root)
    traces = tuple(_traces(root, tests, faults))
    return Traceability(traces, (*_uncovered(traces), *_stray(traces, tests, faults), *_outdated(root, traces)))


def table_text(traces: tuple[Trace, ...]) -> str:
    """The table of traces as the text of docs/traceability.md."""
    parts = [HEAD]
    for title, needs_fault in (("The specification", True), ("What the suite promises", False)):
        parts.append(f"## {title}\n")
        for trace in traces:
            if trace.needs_fault == needs_fault:
                parts.append("\n".join([f"### {trace.clause}\n", *(f"- {item}" for item in _items(trace))]) + "\n")
    return "\n".join(parts)


def _traces(
    root: Path, tests: dict[str, tuple[MarkedTest, ...]], faults: dict[str, tuple[MarkedFault, ...]]
) -> Iterator[Trace]:
    tests_by_clause: dict[str, list[str]] = defaultdict(list)
    for path, marked in tests.items():
        for clause in dict.fromkeys(clause for test in marked for clause in test.of_file):
            tests_by_clause[clause].append(path)
        for test in marked:
            for clause in test.own:
                tests_by_clause[clause].append(f"{path}::{test.name}")
    faults_by_clause: dict[str, list[MarkedFault]] = defaultdict(list)
    for fault in (fault for found in faults.values() for fault in found):
        faults_by_clause[fault.clause].append(fault)
    for document in (SPECIFICATION, PROMISES):
        for clause in clauses_of(root, document):
            named = tuple(tests_by_clause[clause])
            yield Trace(clause, document == SPECIFICATION, named, tuple(faults_by_clause[clause]))


def _uncovered(traces: tuple[Trace, ...]) -> Iterator[str]:
    for trace in traces:
        if not trace.tests:
            yield f'{trace.clause} has no test: mark one with @pytest.mark.clause("{trace.clause}").'
        if trace.needs_fault and not trace.faults:
            yield f"{trace.clause} has no fault: add one to comparisons/faults that breaks this clause and no other."


def _stray(
    traces: tuple[Trace, ...], tests: dict[str, tuple[MarkedTest, ...]], faults: dict[str, tuple[MarkedFault, ...]]
) -> Iterator[str]:
    """Tests and faults that name no clause, or one that does not exist."""
    clauses = {trace.clause for trace in traces}
    breakable = {trace.clause for trace in traces if trace.needs_fault}
    for path, marked in tests.items():
        for test in marked:
            named = {*test.own, *test.of_file}
            if not named:
                yield f'{path}::{test.name} names no clause: mark it with @pytest.mark.clause("…").'
            for unknown in sorted(named - clauses):
                yield f"{path}::{test.name} names {unknown}, which is no clause of {SPECIFICATION} or {PROMISES}."
    for path, found in faults.items():
        for fault in found:
            if fault.clause not in breakable:
                yield f"{path}: {fault.name} breaks {fault.clause}, which is no clause of {SPECIFICATION}."


def _outdated(root: Path, traces: tuple[Trace, ...]) -> Iterator[str]:
    """What the committed table names and is gone, and whether it lacks anything."""
    path = root / TABLE
    committed = path.read_text(encoding="utf-8") if path.is_file() else ""
    present = {(trace.clause, item) for trace in traces for item in _items(trace)}
    written = set(_entries(committed))
    for clause, item in sorted(written - present):
        yield f"{TABLE} holds {clause} by {item}, which is gone: bring it back, or run `{REWRITE}` if that is meant."
    if present - written or committed != table_text(traces):
        yield f"{TABLE} is out of date: run `{REWRITE}`."


def _items(trace: Trace) -> list[str]:
    return [*(f"`{test}`" for test in trace.tests), *(f"fault `{fault.name}`" for fault in trace.faults)]


def _entries(table: str) -> Iterator[tuple[str, str]]:
    """Pairs of a clause and what is listed under it."""
    clause = ""
    for line in table.splitlines():
        if heading := re.fullmatch(r"### ([A-Z]+-\d+)", line):
            clause = heading[1]
        elif line.startswith("- "):
            yield clause, line.removeprefix("- ")
