"""The report as HTML, built from a results directory alone: a page, and beside it a folder with a page for each cell.

The pages are complete without JavaScript; scripts add the viewer, the filters and the commands.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports import pages
from raytruth.reports.changes import changes
from raytruth.reports.kills import PAGE_FILE, clauses_by_scene
from raytruth.reports.loading import ReportError, load_results
from raytruth.reports.made_from import is_made_from, made_from
from raytruth.reports.parts import FOLDER, Parts
from raytruth.reports.report_contents import scene_views
from raytruth.reports.viewer_assets import write_assets

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import Results

__all__ = ["REPORT_FILE", "SINGLE_FILE", "ReportError", "write_html_report", "write_single_file"]

REPORT_FILE = "report.html"
SINGLE_FILE = "report-single-file.html"


def write_html_report(directory: Path, *, unless_current: bool = False, against: Path | None = None) -> Path:
    """Write `report.html` and the folder `report` into the results directory, and return the page's path.

    Each is written whole or not at all. Raises ReportError, in one sentence, where the results are missing or broken or
    the page cannot be written; a missing image or log is told in its place on the page. A report
    that was made from the very same results is left as it is if `unless_current`. What changed since the results
    `against` is told if they are given.
    """
    results = load_results(directory)
    earlier = None if against is None else load_results(against)
    path = directory / REPORT_FILE
    source = made_from(directory)
    if unless_current and is_made_from(path, source):
        return path
    try:
        with TemporaryDirectory(prefix=".report-", dir=directory) as scratch:
            folder = Path(scratch) / FOLDER
            write_assets(folder / "assets")
            # A page that tells of other results, too, is never the current one.
            write_whole(path, _write_pages(directory, results, earlier, folder, source if earlier is None else ""))
            shutil.rmtree(directory / FOLDER, ignore_errors=True)
            folder.replace(directory / FOLDER)
    except OSError as error:
        raise ReportError(f"{path} cannot be written: {error.strerror}.") from error
    return path


def write_single_file(directory: Path, *, against: Path | None = None) -> Path:
    """Write the whole report as one page, `report-single-file.html`, and return its path. Raises as above."""
    results = load_results(directory)
    earlier = None if against is None else load_results(against)
    path = directory / SINGLE_FILE
    parts = Parts()
    scenes = list(scene_views(directory, results, parts))
    page = pages.single_page(results, scenes, parts, _told_beside(directory, results, earlier))
    try:
        write_whole(path, page)
    except OSError as error:
        raise ReportError(f"{path} cannot be written: {error.strerror}.") from error
    return path


def _write_pages(directory: Path, results: Results, earlier: Results | None, folder: Path, source: str) -> str:
    """Write the pages of all cells, and return the overview."""
    parts = Parts(folder)
    scenes = []
    for kind in ("cells", "scenes"):
        (folder / kind).mkdir()
    for scene in scene_views(directory, results, parts):
        for cell in scene.cells_there:
            page = pages.cell_page(results, scene, cell)
            (folder / "cells" / f"{cell.file_name}.html").write_text(page, encoding="utf-8")
        page = pages.scene_page(scene)
        (folder / "scenes" / f"{scene.file_name}.html").write_text(page, encoding="utf-8")
        scene.forget()
        scenes.append(scene)
    told = _told_beside(directory, results, earlier)
    return pages.overview_page(results, scenes, {**told, "source": source})


def _told_beside(directory: Path, results: Results, earlier: Results | None) -> dict[str, object]:
    return {
        "source": "",
        "clauses": clauses_by_scene(directory),
        "kills_page": PAGE_FILE if (directory / PAGE_FILE).exists() else None,
        "changes": None if earlier is None else changes(earlier, results),
        "earlier": None if earlier is None else earlier.created,
    }
