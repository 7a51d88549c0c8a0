"""`raytruth spec`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from comparisons.clauses import TESTS, SourceError
from comparisons.exercised_scenes import scenes_by_function
from comparisons.traceability import TABLE, table_text, traceability
from raytruth.errors import UsageError
from raytruth.options import AsJson  # noqa: TC001 - cyclopts reads annotations at run time
from raytruth.output import print_json, print_table, progress

if TYPE_CHECKING:
    from comparisons.traceability import Trace

UNCOVERED = 1
ROOT = Path(__file__).parents[1]


def spec(*, write: Annotated[bool, Parameter(negative="")] = False, as_json: AsJson = False) -> int:
    """Show which tests, scenes and faults hold each clause, and what is missing.

    Exit status 1 if a clause has no test, one of the specification no fault, or a test no clause; and if the committed
    table names what is gone, or lacks anything.

    Parameters
    ----------
    write
        Write the table docs/traceability.md anew.
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
        scenes = scenes_by_function()
    rows = [(trace, _scenes(trace, scenes)) for trace in found.traces]
    if as_json:
        print_json(
            {
                "clauses": [
                    {
                        "id": trace.clause,
                        "tests": trace.tests,
                        "scenes": names,
                        "faults": [fault.name for fault in trace.faults],
                    }
                    for trace, names in rows
                ],
                "findings": found.findings,
            }
        )
    else:
        print_table(
            ("Clause", "Tests", "Scenes", "Faults"),
            [
                (trace.clause, str(len(trace.tests)), str(len(names)), ", ".join(fault.name for fault in trace.faults))
                for trace, names in rows
            ],
        )
    for finding in found.findings:
        print(f"raytruth: {finding}", file=sys.stderr)
    return UNCOVERED if found.findings else 0


def _scenes(trace: Trace, by_function: dict[str | None, tuple[str, ...]]) -> list[str]:
    """The library's scenes whose kernel holds a function that some fault of the clause replaces."""
    return sorted({name for fault in trace.faults for name in by_function.get(fault.function, ())})
