"""`raytruth report`."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time

from raytruth.options import AsJson  # noqa: TC001 - as above
from raytruth.output import print_json, progress, say
from raytruth.written_report import written_report


def report(directory: Path, /, *, as_json: AsJson = False) -> None:
    """Rebuild the report of a results directory from its files alone.

    Parameters
    ----------
    directory
        What `raytruth run --out` wrote.
    as_json
        Print one JSON document instead of text.
    """
    with progress(f"Writing the report of {directory}"):
        path = written_report(directory)
    if as_json:
        print_json({"report": str(path)})
    else:
        say(f"Report: {path}")
