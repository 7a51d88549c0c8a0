"""The HTML of a report's pages, from templates: the overview, a cell, or everything in one."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from raytruth.reports import viewer_assets, wording
from raytruth.reports.causes import grouped
from raytruth.reports.confirmation import in_one_line
from raytruth.reports.parts import FOLDER
from raytruth.reports.script_data import script_json

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from raytruth.comparisons.records.results import Results
    from raytruth.reports.parts import Parts
    from raytruth.reports.report_contents import CellView, SceneView

BACK = "../"
"""From the page of a cell to the folder of the report."""


def overview_page(results: Results, scenes: Sequence[SceneView], told: Mapping[str, object]) -> str:
    """The page that leads to all cells."""
    return _render(
        "report.html.jinja",
        _in_folder(viewer_assets.OVERVIEW_SCRIPTS, f"{FOLDER}/"),
        _overview(results, scenes, told),
        address=lambda name: f"{FOLDER}/{name}",
        cell_address=lambda cell: f"{FOLDER}/cells/{_quoted(cell.file_name)}",
        scene_address=lambda scene: f"{FOLDER}/scenes/{_quoted(scene.file_name)}",
        articles=False,
    )


def cell_page(results: Results, scene: SceneView, cell: CellView) -> str:
    """The page of one cell."""
    return _render(
        "cell-page.html.jinja",
        _in_folder(viewer_assets.CELL_SCRIPTS, BACK),
        {"results": results, "scene": scene, "cell": cell, "wordings": wording.WORDINGS},
        address=lambda name: f"{BACK}{name}",
        overview=f"{BACK}../report.html",
        heading=2,
        cell_address=lambda other: _quoted(other.file_name),
        scene_address=lambda scene: f"{BACK}scenes/{_quoted(scene.file_name)}",
    )


def scene_page(scene: SceneView) -> str:
    """The page of one scene: what it is for, who agrees with whom, and its cells."""
    return _render(
        "scene-page.html.jinja",
        _in_folder(viewer_assets.SCENE_SCRIPTS, BACK),
        {"scene": scene, "wordings": wording.WORDINGS},
        address=lambda name: f"{BACK}{name}",
        overview=f"{BACK}../report.html",
        cell_address=lambda cell: f"{BACK}cells/{_quoted(cell.file_name)}",
        articles=False,
    )


def single_page(results: Results, scenes: Sequence[SceneView], parts: Parts, told: Mapping[str, object]) -> str:
    """The overview with all cells, pictures and arrays in it."""
    return _render(
        "report.html.jinja",
        _in_one_page(parts, (*viewer_assets.CELL_SCRIPTS, *viewer_assets.OVERVIEW_SCRIPTS)),
        _overview(results, scenes, told),
        address=parts.data_uri,
        cell_address=lambda cell: f"#{cell.anchor}",
        scene_address=lambda scene: f"#{scene.anchor}",
        articles=True,
        heading=4,
    )


def comparison(parts: Parts, contents: Mapping[str, object]) -> str:
    """The page of two images, with everything in it."""
    delivery = _in_one_page(parts, viewer_assets.CELL_SCRIPTS)
    return _render("comparison.html.jinja", delivery, contents, address=parts.data_uri)


def _in_one_page(parts: Parts, scripts: tuple[str, ...]) -> dict[str, object]:
    """How a page that holds everything itself gets its scripts, style and arrays: all of them are our own words."""
    script = "\n".join(viewer_assets.script_text(name) for name in dict.fromkeys(scripts))
    arrays = {name: content.decode("ascii") for name, content in parts.kept.items() if name.startswith("arrays/")}
    return {
        "script": Markup(script),
        "digest": viewer_assets.digest(script),
        "style": Markup(viewer_assets.style_text(single=True)),
        "style_address": None,
        "arrays": {name: Markup(payload) for name, payload in arrays.items()},
        "base": "",
    }


def _in_folder(scripts: tuple[str, ...], base: str) -> dict[str, object]:
    """How a page of a folder gets its scripts and style."""
    script = viewer_assets.starter(scripts, f"{base}assets/")
    return {
        "script": Markup(script),
        "digest": viewer_assets.digest(script),
        "style": None,
        "style_address": f"{base}assets/{viewer_assets.STYLE}",
        "arrays": {},
        "base": base,
    }


def _quoted(file_name: str) -> str:
    """A page's file as part of an address."""
    return f"{quote(file_name, safe='+')}.html"


def _overview(results: Results, scenes: Sequence[SceneView], told: Mapping[str, object]) -> dict[str, object]:
    kinds = {cell.record.folder: cell.kind or "" for scene in scenes for cell in scene.cells_there}
    views = {cell.record.folder: cell for scene in scenes for cell in scene.cells_there}
    return {
        **told,
        "results": results,
        "headline": wording.headline(results),
        "summary": wording.summary(results),
        "capped": wording.capped(results),
        "agreement": in_one_line(results),
        "counts": wording.outcome_counts(results),
        "wordings": wording.WORDINGS,
        "columns": wording.columns(results),
        "scenes": sorted(scenes, key=lambda scene: scene.urgency),
        "groups": grouped(results, kinds),
        "views": views,
        "features": sorted({feature for scene in results.scenes for feature in scene.features}),
    }


def _render(template: str, delivery: Mapping[str, object], contents: Mapping[str, object], **places: Any) -> str:
    return _environment().get_template(template).render(**delivery, **contents, **places)


@cache  # compiling the templates for each of thousands of pages would take most of the time
def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("raytruth.reports"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=lambda value: wording.printable(value) if type(value) is str else value,
    )
    environment.filters["number"] = wording.number
    environment.filters["exact"] = wording.exact
    environment.filters["script_json"] = lambda value: Markup(script_json(value))
    return environment
