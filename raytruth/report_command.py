"""`raytruth report`."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time
from typing import Annotated

from cyclopts import Parameter
from rich.console import Console

from raytruth.options import AsJson  # noqa: TC001 - as above
from raytruth.output import print_json, progress, say
from raytruth.reports.console import print_matrix
from raytruth.written_report import loaded_results, report_files, written_report, written_single_file


def report(
    directory: Path,
    /,
    *,
    junit: Path | None = None,
    summary: Path | None = None,
    strict: Annotated[bool, Parameter(negative="")] = False,
    against: Path | None = None,
    single_file: Annotated[bool, Parameter(negative="")] = False,
    terminal: Annotated[bool, Parameter(negative="")] = False,
    as_json: AsJson = False,
) -> None:
    """Rebuild the report of a results directory from its files alone.

    Parameters
    ----------
    directory
        What `raytruth run --out` wrote.
    junit
        Write the verdicts to this file, too, as JUnit XML: a test for each cell.
    summary
        Write a summary to this file, too, in Markdown, as GitHub shows it of a job: `--summary "$GITHUB_STEP_SUMMARY"`.
    strict
        In JUnit XML, a cell that is as declared, not as due, is a failure.
    against
        An earlier results directory: the report tells what changed since, cell by cell.
    single_file
        Also write everything into one page, report-single-file.html, to be sent or attached.
    terminal
        Show the matrix and the worst cells here, and write no page.
    as_json
        Print one JSON document instead of text.
    """
    files = report_files(junit, summary)
    if terminal:
        files.write(directory, strict=strict)
        print_matrix(loaded_results(directory), Console())
        return
    with progress(f"Writing the report of {directory}"):
        path = written_report(directory, against=against)
        single = written_single_file(directory, against=against) if single_file else None
        files.write(directory, strict=strict)
    written = {"report": path, "single_file": single, "junit": junit, "summary": summary}
    if as_json:
        print_json({name: str(file) for name, file in written.items() if file is not None})
    else:
        say(f"Report: {path}")
        if single is not None:
            say(f"In one file: {single}")
