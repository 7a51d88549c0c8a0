"""What a results directory holds already: as results.json says or, where that is damaged, as its cells say."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.matrix.waivers import apply_waivers, load_waivers
from raytruth.comparisons.matrix.whole_cells import CELL_FILE, whole_cells
from raytruth.comparisons.records.results import (
    RESULTS_FILE,
    SCHEMA_VERSION,
    Cell,
    RendererRecord,
    Results,
    SceneRecord,
    inconsistency,
)
from raytruth.comparisons.renderers.catalogue import all_renderers, family_of
from raytruth.comparisons.renderers.protocol import shown_error_model
from raytruth.scenes.library import open_scene
from raytruth.scenes.light_paths import whitted_class
from raytruth.scenes.loading import SceneError
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene


def earlier_results(directory: Path) -> Results | None:
    """All that the directory holds; None for nothing.

    A cell of results.json with images is left out where its own file is gone. Where results.json cannot be used, all
    cells count that lie there whole.
    """
    results = _usable(directory)
    if results is None:
        return _rebuilt(directory)
    kept = [cell for cell in results.cells if cell.images is None or (directory / cell.folder / CELL_FILE).exists()]
    return results.model_copy(update={"cells": tuple(kept)})


def damage_of(directory: Path) -> str | None:
    """One sentence where results.json cannot be used although there are cells; None where nothing is to be told."""
    if _usable(directory) is not None:
        return None
    count = sum(1 for _ in whole_cells(directory))
    if not count:
        return None
    found = "damaged" if (directory / RESULTS_FILE).exists() else "missing"
    cells = "1 cell is" if count == 1 else f"{count} cells are"
    return (
        f"{directory / RESULTS_FILE} is {found}: {cells} taken over from the files that lie there; what was not "
        "rendered is listed again when it is run again."
    )


def _usable(directory: Path) -> Results | None:
    """The file, if it is whole, agrees with itself, and is of this version of the format."""
    try:
        results = Results.model_validate_json((directory / RESULTS_FILE).read_bytes())
    except (OSError, ValueError):
        return None
    is_ours = results.schema_version == SCHEMA_VERSION and inconsistency(results) is None
    return results if is_ours else None


def _rebuilt(directory: Path) -> Results | None:
    """From the cells alone; their renderers and scenes as they are today."""
    cells = list(whole_cells(directory))
    if not cells:
        return None
    versions = {cell.renderer: cell.version for cell in cells}
    scenes = {cell.scene: _found_scene(cell) for cell in cells}
    found = [scene for scene in scenes.values() if scene is not None]
    waived, _ = apply_waivers(load_waivers(), cells, versions, found)
    return Results(
        raytruth_version="",
        created="",
        command="",
        machine={},
        scenes=tuple(_record_of(name, scene) for name, scene in scenes.items()),
        renderers=tuple(_renderer_of(name, cells) for name in versions),
        cells=tuple(waived),
    )


def _found_scene(cell: Cell) -> Scene | None:
    """The scene of a cell as it is today; None where it is no longer there."""
    try:
        scene = open_scene(cell.source or cell.scene)
    except SceneError:
        return None
    return scene if scene.name == cell.scene else None


def _record_of(name: str, scene: Scene | None) -> SceneRecord:
    """What is told of a scene; next to nothing of one that is no longer there."""
    if scene is not None:
        return scene_record(scene)
    gone = "Its file is not where it was."
    return SceneRecord(
        name=name, purpose=gone, convention="unknown", width=0, height=0, features=(), light_paths="unknown"
    )


def _renderer_of(name: str, cells: Sequence[Cell]) -> RendererRecord:
    """Of the renderer as it is today; next to nothing of one that raytruth does not know."""
    of_it = [cell for cell in cells if cell.renderer == name]
    known = all_renderers().get(name)
    if known is not None:
        return renderer_record(known, of_it[-1].version)
    integrators = {cell.integrator: "unknown" for cell in of_it}
    return RendererRecord(
        name=name, version=of_it[-1].version, install="unknown", error_model="unknown", integrators=integrators
    )


def scene_record(scene: Scene) -> SceneRecord:
    """What the results say of a scene."""
    return SceneRecord(
        name=scene.name,
        purpose=scene.purpose,
        convention=scene.convention,
        width=scene.camera.width,
        height=scene.camera.height,
        features=tuple(sorted(required_features(scene))),
        light_paths=whitted_class(scene),
    )


def renderer_record(renderer: Renderer, its_version: str | None) -> RendererRecord:
    """What the results say of a renderer, of which this version is here; None where it cannot run."""
    return RendererRecord(
        name=renderer.name,
        version=its_version,
        install=renderer.install,
        error_model=shown_error_model(renderer, its_version).description,
        integrators={integrator.name: integrator.light_paths.format(depth="n") for integrator in renderer.integrators},
        family=family_of(renderer.name),
    )
