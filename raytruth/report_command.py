"""`raytruth report`."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time

from raytruth.errors import UsageError
from raytruth.options import AsJson  # noqa: TC001 - as above
from raytruth.output import print_json, progress
from raytruth.reports.html import ReportError, write_html_report


def report(directory: Path, /, *, as_json: AsJson = False) -> None:
    """Rebuild the report of a results directory from its files alone.

    Parameters
    ----------
    directory
        What `raytruth run --out` wrote.
    as_json
        Print one JSON document instead of text.
    """
    try:
        with progress(f"Writing the report of {directory}"):
            path = write_html_report(directory)
    except ReportError as error:
        raise UsageError(str(error)) from error
    if as_json:
        print_json({"report": str(path)})
    else:
        print(f"Report: {path}")
