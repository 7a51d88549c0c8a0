"""Reports as commands write them: the page in the results directory, and files that other programs read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.errors import UsageError
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.html import ReportError, write_html_report
from raytruth.reports.job_summary import job_summary
from raytruth.reports.junit import junit_xml
from raytruth.reports.loading import load_results

if TYPE_CHECKING:
    from pathlib import Path


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
        try:
            results = load_results(directory)
        except ReportError as error:
            raise UsageError(str(error)) from error
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


def written_report(directory: Path, *, unless_current: bool = False) -> Path:
    """As `write_html_report`. Raises UsageError where the results are broken or the report cannot be written."""
    try:
        return write_html_report(directory, unless_current=unless_current)
    except ReportError as error:
        raise UsageError(str(error)) from error
