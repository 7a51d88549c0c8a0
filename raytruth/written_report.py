"""Reports as commands write them: the page in the results directory, and files that other programs read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.errors import UsageError
from raytruth.output import tell
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.html import REPORT_FILE, ReportError, write_html_report, write_single_file
from raytruth.reports.job_summary import job_summary
from raytruth.reports.junit import junit_xml
from raytruth.reports.loading import load_results
from raytruth.reports.parts import FOLDER

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.results import Results

LARGEST_ATTACHMENT = 25_000_000
"""Bytes: what widely used mail services take at most."""


@dataclass(frozen=True)
class ReportFiles:
    """Where to write a report beside the page, as the options of commands say; None: nowhere."""

    junit: Path | None = None
    summary: Path | None = None

    def write(self, directory: Path, *, strict: bool) -> None:
        """Write those that are asked for, each whole or not at all.

        Raises UsageError where the results are broken, OSError where a file cannot be written.
        """
        if self.junit is None and self.summary is None:
            return
        results = loaded_results(directory)
        if self.junit is not None:
            write_whole(self.junit, junit_xml(directory, results, strict=strict))
        if self.summary is not None:
            write_whole(self.summary, job_summary(results))


def report_files(junit: Path | None, summary: Path | None) -> ReportFiles:
    """What the options `--junit` and `--summary` ask for. Raises UsageError where a file could not be written there."""
    for option, path in (("--junit", junit), ("--summary", summary)):
        if path is not None and path.is_dir():
            raise UsageError(f"{option}: expected the name of a file, but {path} is a folder.")
        if path is not None and not path.parent.is_dir():
            raise UsageError(f"{option}: expected a file in a folder that exists, but there is no {path.parent}.")
    return ReportFiles(junit, summary)


def written_report(directory: Path, *, unless_current: bool = False, against: Path | None = None) -> Path:
    """As `write_html_report`. Raises UsageError where the results are broken or the report cannot be written."""
    try:
        return write_html_report(directory, unless_current=unless_current, against=against)
    except ReportError as error:
        raise UsageError(str(error)) from error


def written_single_file(directory: Path, *, against: Path | None = None) -> Path:
    """As `write_single_file`, with a warning where the page is larger than what can be sent. Raises as above."""
    try:
        path = write_single_file(directory, against=against)
    except ReportError as error:
        raise UsageError(str(error)) from error
    size = path.stat().st_size
    if size > LARGEST_ATTACHMENT:
        tell(
            f"raytruth: {path} has {size / 1e6:.0f} MB: many mail services refuse it, and browsers open it slowly. "
            f"The folder {FOLDER} with {REPORT_FILE} beside it opens at once."
        )
    return path


def loaded_results(directory: Path) -> Results:
    """The results in a directory. Raises UsageError where they are missing or broken."""
    try:
        return load_results(directory)
    except ReportError as error:
        raise UsageError(str(error)) from error
