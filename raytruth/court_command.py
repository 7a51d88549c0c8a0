"""`raytruth court`."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from raytruth.comparisons.court.cases import all_cases
from raytruth.comparisons.court.hearing import hold_court
from raytruth.errors import UsageError
from raytruth.options import AsJson  # noqa: TC001 - as above
from raytruth.output import print_table, progress, say
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.court_table import CASE_HEADERS, COUNT_HEADERS, case_rows, count_rows, csv_text, markdown

if TYPE_CHECKING:
    from collections.abc import Mapping

    from raytruth.comparisons.court.cases import Case


def court(
    *names: str,
    csv: Annotated[Path | None, Parameter(show_default=False)] = None,
    summary: Annotated[Path | None, Parameter(show_default=False)] = None,
    as_json: AsJson = False,
) -> None:
    """Put rays whose hit is disputed in public to several programs and forms, and tell who is right.

    Parameters
    ----------
    names
        Only these cases; all of them by default.
    csv
        Also write each answer as a line of this file.
    summary
        Also write both tables in Markdown to this file.
    as_json
        Print one JSON document instead of text.
    """
    cases = _selected(all_cases(), names)
    with progress(f"Asking about {len(cases)} rays"):
        results = hold_court(cases)
    if csv is not None:
        write_whole(csv, csv_text(results))
    if summary is not None:
        write_whole(summary, markdown(results))
    if as_json:
        print(results.model_dump_json(indent=2))
        return
    print_table(COUNT_HEADERS, count_rows(results))
    say("")
    print_table(CASE_HEADERS, case_rows(results))


def _selected(cases: Mapping[str, Case], names: tuple[str, ...]) -> dict[str, Case]:
    unknown = [name for name in names if name not in cases]
    if unknown:
        raise UsageError(f"There is no case {unknown[0]!r}: expected names of {', '.join(cases)}.")
    return {name: case for name, case in cases.items() if not names or name in names}
