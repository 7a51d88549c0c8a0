"""The report as an HTML page, built from a results directory alone.

The page is complete by itself; the values of single pixels lie in a folder beside it.
"""

from __future__ import annotations

import base64
import hashlib
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING
from urllib.parse import quote

from jinja2 import Environment, PackageLoader, StrictUndefined

from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports import pictures, wording
from raytruth.reports.agreement import Agreement, agreement_on
from raytruth.reports.confirmation import in_one_line
from raytruth.reports.figures import Album, Figure, SharedPicture, cell_figures, data_uri
from raytruth.reports.kills import PAGE_FILE
from raytruth.reports.loading import ReportError, load_results, read_log
from raytruth.reports.made_from import is_made_from, made_from
from raytruth.reports.pixel_scripts import FOLDER, PixelView, write_pixel_script

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import Cell, Results, SceneRecord

__all__ = ["REPORT_FILE", "ReportError", "write_html_report"]

REPORT_FILE = "report.html"


@dataclass(frozen=True)
class CellView:
    """A cell of the matrix as the page shows it, with its figures, its log and its pixels."""

    record: Cell
    anchor: str
    figures: list[Figure]
    pixels: PixelView | None
    pixel_problem: str | None
    log: str | None
    log_problem: str | None

    @property
    def outcome(self) -> str:
        """The verdict, or `waived`."""
        return wording.outcome(self.record)


@dataclass
class SceneView:
    """A row of the matrix: a scene with its cells in the order of the columns; None where a cell was not run."""

    record: SceneRecord
    anchor: str
    agreement: Agreement | None = None
    cells: list[CellView | None] = field(default_factory=list)

    @property
    def picture(self) -> SharedPicture | None:
        """The picture of the truth; None where no cell has one."""
        figures = (figure for cell in self.cells if cell is not None for figure in cell.figures)
        return next((figure.shared for figure in figures if figure.shared is not None), None)


def write_html_report(directory: Path, *, unless_current: bool = False) -> Path:
    """Write `report.html` and the folder `pixels` into the results directory, and return the page's path.

    Each is written whole or not at all. Raises ReportError, in one sentence, where the results are missing or broken or
    the page cannot be written; a missing image or log is told in its place on the page. A report
    that was made from the very same results is left as it is if `unless_current`.
    """
    results = load_results(directory)
    path = directory / REPORT_FILE
    source = made_from(directory)
    if unless_current and is_made_from(path, source):
        return path
    try:
        with TemporaryDirectory(prefix=".report-", dir=directory) as scratch:
            pixels = Path(scratch) / FOLDER
            write_whole(path, _render_page(directory, results, pixels, source))
            shutil.rmtree(directory / FOLDER, ignore_errors=True)
            if pixels.exists():
                pixels.replace(directory / FOLDER)
    except OSError as error:
        raise ReportError(f"{path} cannot be written: {error.strerror}.") from error
    return path


def _render_page(directory: Path, results: Results, pixels: Path, source: str) -> str:
    """The page as text; the values of the pixels are written into the folder `pixels`."""
    loader = PackageLoader("raytruth.reports")
    environment = Environment(
        loader=loader,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=lambda value: wording.printable(value) if type(value) is str else value,
    )
    environment.filters["number"] = wording.number
    environment.filters["exact"] = wording.exact
    names = ("report.js", "pixels.js", "report.css")
    report_script, pixels_script, style = (loader.get_source(environment, name)[0] for name in names)
    script = f"{report_script}\n{pixels_script}"
    album = Album()
    scenes = _scene_views(directory, results, album, pixels)
    return environment.get_template("report.html.jinja").render(
        results=results,
        source=source,
        headline=wording.headline(results),
        summary=wording.summary(results),
        capped=wording.capped(results),
        agreement=in_one_line(results),
        counts=wording.outcome_counts(results),
        wordings=wording.WORDINGS,
        columns=wording.columns(results),
        scenes=scenes,
        album=list(album.pictures.values()),
        legends={
            "difference": data_uri(pictures.difference_legend()),
            "sequential": data_uri(pictures.sequential_legend()),
            "hatch": data_uri(pictures.hatch_legend()),
        },
        script=script,
        style=style,
        kills_page=PAGE_FILE if (directory / PAGE_FILE).exists() else None,
        script_hash=base64.b64encode(hashlib.sha256(script.encode()).digest()).decode(),
    )


def _scene_views(directory: Path, results: Results, album: Album, pixels: Path) -> list[SceneView]:
    """The rows of the matrix."""
    cells = wording.cells_by_place(results)
    views = []
    for scene in results.scenes:
        view = SceneView(scene, _anchor("scene", scene.name), agreement_on(directory, results, scene.name))
        for renderer, integrator in wording.columns(results):
            cell = cells.get((scene.name, renderer, integrator))
            view.cells.append(None if cell is None else _cell_view(directory, cell, album, pixels))
        views.append(view)
    return views


def _cell_view(directory: Path, cell: Cell, album: Album, pixels: Path) -> CellView:
    anchor = _anchor("cell", cell.scene, cell.renderer, cell.integrator)
    log, log_problem, view, pixel_problem = None, None, None, None
    if cell.log is not None:
        try:
            log = read_log(directory, cell.log)
        except ReportError as error:
            log_problem = str(error)
    if cell.images is not None:
        try:
            view = write_pixel_script(directory, cell, cell.images, anchor, pixels)
        except ReportError as error:
            pixel_problem = f"Single pixels cannot be shown. {error}"
    return CellView(cell, anchor, cell_figures(directory, cell, album), view, pixel_problem, log, log_problem)


def _anchor(*parts: str) -> str:
    """A readable id; the slash between the parts cannot stand in a quoted part, so that no two ids are equal."""
    return "/".join(quote(part, safe="") for part in parts)
