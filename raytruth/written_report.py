"""The report as commands write it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.errors import UsageError
from raytruth.reports.html import ReportError, write_html_report

if TYPE_CHECKING:
    from pathlib import Path


def written_report(directory: Path, *, unless_current: bool = False) -> Path:
    """As `write_html_report`. Raises UsageError where the results are broken or the report cannot be written."""
    try:
        return write_html_report(directory, unless_current=unless_current)
    except ReportError as error:
        raise UsageError(str(error)) from error
