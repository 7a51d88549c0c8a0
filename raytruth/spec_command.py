"""`raytruth spec`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from raytruth.errors import UsageError
from raytruth.options import AsJson  # noqa: TC001 - cyclopts reads annotations at run time
from raytruth.output import print_json, print_table, progress
from raytruth.specification.clauses import TESTS, SourceError
from raytruth.specification.exercised_scenes import scenes_by_fault, scenes_by_function
from raytruth.specification.traceability import TABLE, table_text, traceability

if TYPE_CHECKING:
    from raytruth.specification.traceability import Trace

UNCOVERED = 1
ROOT = Path(__file__).parents[1]


def spec(
    *,
    write: Annotated[bool, Parameter(negative="")] = False,
    results: Path = Path("results"),
    as_json: AsJson = False,
) -> int:
    """Show which tests, scenes and faults hold each clause, and what is missing.

    Exit status 1 if a clause has no test, one of the specification no fault, or a test no clause; and if the committed
    table names what is gone, or lacks anything.

    Parameters
    ----------
    write
        Write the table docs/traceability.md anew.
    results
        Where `raytruth faults` wrote its results: a clause's scenes are those that killed a fault of it. For faults
        that have none there, they are those whose kernel holds the function that the fault replaces.
    as_json
        Print one JSON document instead of text.
    """
    if not (ROOT / TESTS).is_dir():
        raise UsageError("raytruth spec reads the tests, which are not installed: run it in a clone of the repository.")
    try:
        found = traceability(ROOT)
        if write:
            (ROOT / TABLE).write_text(table_text(found.traces), encoding="utf-8")
            found = traceability(ROOT)
    except SourceError as error:
        raise UsageError(f"{error}.") from error
    with progress("Looking for the scenes of each clause"):
        rows = _with_scenes(found.traces, results)
    if as_json:
        print_json({"clauses": [_as_json(trace, names) for trace, names in rows], "findings": found.findings})
    else:
        print_table(("Clause", "Tests", "Scenes", "Faults"), [_as_row(trace, names) for trace, names in rows])
    for finding in found.findings:
        print(f"raytruth: {finding}", file=sys.stderr)
    return UNCOVERED if found.findings else 0


def _as_json(trace: Trace, scenes: list[str]) -> dict[str, Any]:
    faults = [fault.name for fault in trace.faults]
    return {"id": trace.clause, "tests": trace.tests, "scenes": scenes, "faults": faults}


def _as_row(trace: Trace, scenes: list[str]) -> tuple[str, str, str, str]:
    faults = ", ".join(fault.name for fault in trace.faults)
    return trace.clause, str(len(trace.tests)), str(len(scenes)), faults


def _with_scenes(traces: tuple[Trace, ...], results: Path) -> list[tuple[Trace, list[str]]]:
    """Each clause and the scenes that exercise it."""
    try:
        killing = scenes_by_fault(results)
    except (OSError, ValueError) as error:
        raise UsageError(
            f"{results}: the results of the kill matrix cannot be read; run raytruth faults again."
        ) from error
    holding = scenes_by_function()
    return [
        (
            trace,
            sorted(
                {name for fault in trace.faults for name in killing.get(fault.name) or holding.get(fault.function, ())}
            ),
        )
        for trace in traces
    ]
