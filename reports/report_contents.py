"""What the pages of a report show: scenes, and their cells with figures, arrays and logs, read from the results."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from raytruth.reports import wording
from raytruth.reports.agreement import Agreement, agreement_on
from raytruth.reports.causes import TROUBLES, kind_of_trouble
from raytruth.reports.cell_arrays import cell_arrays, viewer_data
from raytruth.reports.cell_images import CellImages
from raytruth.reports.figures import Figure, cell_figures
from raytruth.reports.loading import ReportError, read_log

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from raytruth.comparisons.records.results import Cell, Results, SceneRecord
    from raytruth.reports.parts import Parts

LONGEST_NAME = 150
"""Of a page's file without its ending: file systems take 255 bytes, and archives that hold it have folders, too."""


@dataclass
class CellView:
    """A cell of the matrix as its page shows it."""

    record: Cell
    anchor: str
    file_name: str
    """Of its page, without the ending."""
    kind: str | None
    """Of its trouble; None where there is none."""
    figures: list[Figure] = field(default_factory=list)
    viewer: dict[str, Any] | None = None
    pixel_problem: str | None = None
    log: str | None = None
    log_problem: str | None = None

    @property
    def outcome(self) -> str:
        """The verdict, or `waived`."""
        return wording.outcome(self.record)

    @property
    def name(self) -> str:
        """Of the renderer and its integrator."""
        return f"{self.record.renderer}/{self.record.integrator}"


@dataclass
class SceneView:
    """A row of the matrix: a scene with its cells in the order of the columns; None where a cell was not run."""

    record: SceneRecord
    anchor: str
    file_name: str
    """Of its page, without the ending."""
    agreement: Agreement | None
    cells: list[CellView | None] = field(default_factory=list)

    @property
    def cells_there(self) -> list[CellView]:
        """Those that were run."""
        return [cell for cell in self.cells if cell is not None]

    @property
    def picture(self) -> Figure | None:
        """The truth, from any cell that has it."""
        figures = (figure for cell in self.cells_there for figure in cell.figures[:1])
        return next((figure for figure in figures if figure.picture is not None), None)

    def forget(self) -> None:
        """Let go of what only pages of its own show: a report may have thousands of cells."""
        self.agreement = None
        for cell in self.cells_there:
            cell.figures, cell.viewer, cell.log = cell.figures[:1], None, None

    @property
    def urgency(self) -> int:
        """The place in the order in which scenes are shown: those that fail first."""
        return min(
            (TROUBLES.index(c.outcome) for c in self.cells_there if c.outcome in TROUBLES), default=len(TROUBLES)
        )


def scene_views(directory: Path, results: Results, parts: Parts) -> Iterator[SceneView]:
    """The rows of the matrix, each when it is wanted; pictures and arrays are added to the parts."""
    cells = wording.cells_by_place(results)
    for scene in results.scenes:
        agreement = agreement_on(directory, results, scene.name)
        view = SceneView(scene, _anchor("scene", scene.name), _file_name((scene.name,)), agreement)
        arrays: dict[str, dict[str, str]] = {}
        for renderer, integrator in wording.columns(results):
            cell = cells.get((scene.name, renderer, integrator))
            view.cells.append(None if cell is None else _cell_view(directory, cell, parts, arrays))
        for shown in view.cells_there:
            if shown.viewer is not None:
                others = {name: names["render"] for name, names in arrays.items() if name != shown.name}
                shown.viewer["others"] = [
                    {"name": wording.printable(name), "arrays": render} for name, render in others.items()
                ]
        yield view


def _cell_view(directory: Path, cell: Cell, parts: Parts, arrays: dict[str, dict[str, str]]) -> CellView:
    """The view of a cell; the names of its arrays are added to those of its scene."""
    place = f"{cell.scene} by {cell.renderer}/{cell.integrator}"
    images = None if cell.images is None else CellImages(directory, cell.images, place)
    kind = kind_of_trouble(cell, images) if wording.outcome(cell) in TROUBLES else None
    names = (cell.scene, cell.renderer, cell.integrator)
    view = CellView(cell, _anchor("cell", *names), _file_name(names), kind)
    if cell.log is not None:
        try:
            view.log = read_log(directory, cell.log)
        except ReportError as error:
            view.log_problem = str(error)
    if images is not None:
        view.figures = cell_figures(images, parts)
        try:
            arrays[view.name] = cell_arrays(images, parts)
            view.viewer = viewer_data(cell, images, arrays[view.name])
        except ReportError as error:
            view.pixel_problem = f"Single pixels cannot be shown. {error}"
    return view


def _anchor(*parts: str) -> str:
    """A readable id; the slash between the parts cannot stand in a quoted part, so that no two ids are equal."""
    return "/".join(quote(part, safe="") for part in parts)


def _file_name(names: tuple[str, ...]) -> str:
    """One part of a path, whatever the names are: a quoted name holds neither a slash nor a plus sign."""
    name = "+".join(quote(part, safe="") for part in names)
    if len(name) <= LONGEST_NAME:
        return name
    return f"{name[:LONGEST_NAME]}+{hashlib.sha256(name.encode()).hexdigest()[:24]}"  # 96 bits tell all names apart
