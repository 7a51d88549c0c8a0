"""`raytruth report`."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time
from typing import Annotated

from cyclopts import Parameter

from raytruth.options import AsJson  # noqa: TC001 - as above
from raytruth.output import print_json, progress, say
from raytruth.written_report import report_files, written_report


def report(
    directory: Path,
    /,
    *,
    junit: Path | None = None,
    summary: Path | None = None,
    strict: Annotated[bool, Parameter(negative="")] = False,
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
    as_json
        Print one JSON document instead of text.
    """
    files = report_files(junit, summary)
    with progress(f"Writing the report of {directory}"):
        path = written_report(directory)
        files.write(directory, strict=strict)
    written = {"report": path, "junit": junit, "summary": summary}
    if as_json:
        print_json({name: str(file) for name, file in written.items() if file is not None})
    else:
        say(f"Report: {path}")
