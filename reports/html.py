"""The report as one self-contained HTML page, built from a results directory alone."""

from __future__ import annotations

import base64
import hashlib
import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING
from urllib.parse import quote

from jinja2 import Environment, PackageLoader, StrictUndefined

from comparisons.results import Verdict
from reports import pictures, wording
from reports.figures import Album, Figure, SharedPicture, cell_figures, data_uri
from reports.loading import ReportError, load_results, read_log

if TYPE_CHECKING:
    from pathlib import Path

    from comparisons.results import Cell, Results, SceneRecord

__all__ = ["REPORT_FILE", "ReportError", "write_html_report"]

REPORT_FILE = "report.html"


@dataclass(frozen=True)
class CellView:
    """A cell with what the page adds to it."""

    record: Cell
    anchor: str
    figures: list[Figure]
    log: str | None
    log_problem: str | None


@dataclass
class SceneView:
    """A scene with its cells in the order of the matrix's columns; None where a cell was not run."""

    record: SceneRecord
    anchor: str
    cells: list[CellView | None] = field(default_factory=list)

    @property
    def picture(self) -> SharedPicture | None:
        """The truth, where at least one cell has it."""
        figures = (figure for cell in self.cells if cell is not None for figure in cell.figures)
        return next((figure.shared for figure in figures if figure.shared is not None), None)


def write_html_report(directory: Path) -> Path:
    """Write `report.html` into the results directory, whole or not at all, and return its path.

    Raises ReportError, in one sentence, where the results are missing or broken or the page cannot be written; a
    missing image or log is told in its place on the page.
    """
    page = _render_page(directory, load_results(directory))
    path = directory / REPORT_FILE
    partial = directory / f".{REPORT_FILE}.{os.getpid()}"
    try:
        partial.write_text(page, encoding="utf-8")
        partial.replace(path)
    except OSError as error:
        raise ReportError(f"{path} cannot be written: {error.strerror}.") from error
    finally:
        partial.unlink(missing_ok=True)
    return path


def _render_page(directory: Path, results: Results) -> str:
    """The page as text."""
    loader = PackageLoader("reports")
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
    script, style = (loader.get_source(environment, name)[0] for name in ("report.js", "report.css"))
    album = Album()
    scenes = _scene_views(directory, results, album)
    return environment.get_template("report.html.jinja").render(
        results=results,
        headline=wording.headline(results),
        summary=wording.summary(results),
        counts=wording.verdict_counts(results),
        wordings=wording.WORDINGS,
        verdicts=Verdict,
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
        script_hash=base64.b64encode(hashlib.sha256(script.encode()).digest()).decode(),
    )


def _scene_views(directory: Path, results: Results, album: Album) -> list[SceneView]:
    """The rows of the matrix."""
    cells = wording.cells_by_place(results)
    views = []
    for scene in results.scenes:
        view = SceneView(scene, _anchor("scene", scene.name))
        for renderer, integrator in wording.columns(results):
            cell = cells.get((scene.name, renderer, integrator))
            view.cells.append(None if cell is None else _cell_view(directory, cell, album))
        views.append(view)
    return views


def _cell_view(directory: Path, cell: Cell, album: Album) -> CellView:
    log, problem = None, None
    if cell.log is not None:
        try:
            log = read_log(directory, cell.log)
        except ReportError as error:
            problem = str(error)
    anchor = _anchor("cell", cell.scene, cell.renderer, cell.integrator)
    return CellView(cell, anchor, cell_figures(directory, cell, album), log, problem)


def _anchor(*parts: str) -> str:
    """A readable id; the slash between the parts cannot stand in a quoted part, so that no two ids are equal."""
    return "/".join(quote(part, safe="") for part in parts)
