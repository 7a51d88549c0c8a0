"""What a run of the matrix has to do: every scene on every renderer that can be compared with its truth."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.comparisons.matrix.cell import CellPlace, settled_cell
from raytruth.comparisons.matrix.cell_key import cell_key, scene_digest
from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.matrix.kept_versions import kept_version, tried_version
from raytruth.comparisons.matrix.whole_cells import whole_cell
from raytruth.comparisons.records.results import Cell, Verdict
from raytruth.comparisons.renderers.protocol import error_model_of, why_unavailable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
    from pathlib import Path

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True, eq=False)
class PlannedCell:
    """A cell that is to be rendered, at this depth, and judged by the error model of the renderer's version."""

    place: CellPlace
    depth: int
    error_model: ErrorModel


@dataclass(frozen=True)
class Plan:
    """What a run has to do, and the cells that are settled without rendering."""

    settled: tuple[Cell, ...]
    by_scene: dict[str, tuple[PlannedCell, ...]]
    """The scenes, each by what names it on the command line."""
    versions: Mapping[str, str | None]
    """The version of each renderer by its name; None where it cannot run here."""

    @property
    def cells(self) -> list[PlannedCell]:
        """All cells that are to be rendered."""
        return [cell for cells in self.by_scene.values() for cell in cells]


def plan_run(
    scenes: Mapping[str, Scene],
    renderers: Sequence[Renderer],
    directory: Path,
    *,
    fresh: bool,
    tell: Callable[[Plan], None] = lambda _: None,
) -> Plan:
    """Settle what is unavailable, incomparable, or already in the directory; the rest is to be rendered.

    Scenes are given by what names each on the command line. A cell is taken from the directory if its key
    (cell_key.py) is the same, unless `fresh`. A renderer that has nothing left to render need not be tried: what it
    told of its version earlier will do (kept_versions.py). Trials take seconds, so that the plan is foreseen before
    them, and given to `tell`: with the versions told earlier or, where none was, with one that can be judged.
    """
    kept = {it.name: version for it in renderers if (version := kept_version(it)) is not None}
    foreseen = {it.name: kept.get(it.name) or it.error_models[-1][0] for it in renderers}
    plan = _plan(scenes, renderers, foreseen, directory, fresh=fresh)
    tell(plan)
    at_work = {cell.place.renderer.name for cell in plan.cells}
    needless: set[str] = set() if fresh else kept.keys() - at_work
    tried = _tried([renderer for renderer in renderers if renderer.name not in needless])
    versions: dict[str, str | None] = {**kept, **tried}
    return plan if versions == foreseen else _plan(scenes, renderers, versions, directory, fresh=fresh)


def _tried(renderers: Sequence[Renderer]) -> dict[str, str | None]:
    """The version of each renderer; all are tried side by side, each in a process of its own."""
    with ThreadPoolExecutor() as pool:
        return dict(zip((renderer.name for renderer in renderers), pool.map(tried_version, renderers), strict=True))


def _plan(
    scenes: Mapping[str, Scene],
    renderers: Sequence[Renderer],
    versions: Mapping[str, str | None],
    directory: Path,
    *,
    fresh: bool,
) -> Plan:
    """The plan for renderers of these versions."""
    settled: list[Cell] = []
    by_scene: dict[str, tuple[PlannedCell, ...]] = {}
    for source, scene in scenes.items():
        planned: list[PlannedCell] = []
        for place in _places(source, scene, renderers, versions):
            step = _step(place)
            if isinstance(step, PlannedCell) and not fresh:
                step = _finished(directory, place) or step
            if isinstance(step, Cell):
                settled.append(step)
            else:
                planned.append(step)
        if planned:
            by_scene[source] = tuple(planned)
    return Plan(tuple(settled), by_scene, {renderer.name: versions[renderer.name] for renderer in renderers})


def _places(
    source: str, scene: Scene, renderers: Iterable[Renderer], versions: Mapping[str, str | None]
) -> Iterator[CellPlace]:
    """All cells of a scene."""
    of_scene = scene_digest(scene)
    for renderer in renderers:
        version = versions[renderer.name]
        for integrator in renderer.integrators:
            key = cell_key(of_scene, renderer, integrator, version)
            yield CellPlace(scene, renderer, integrator, key, source, version)


def _step(place: CellPlace) -> Cell | PlannedCell:
    """The cell as it is settled without rendering, or as it is to be rendered."""
    unavailable = why_unavailable(place.renderer, place.version)
    if unavailable is not None:
        return settled_cell(place, Verdict.UNAVAILABLE, f"{place.renderer.name} is {unavailable}")
    depth = depth_or_reason(place.scene, place.renderer, place.integrator)
    if isinstance(depth, str):
        return settled_cell(place, Verdict.INCOMPARABLE, depth)
    error_model = error_model_of(place.renderer, place.version)
    assert error_model is not None, "else it is unavailable"
    return PlannedCell(place, depth, error_model.in_scene(place.scene))


def _finished(directory: Path, place: CellPlace) -> Cell | None:
    """The cell of an earlier run, if nothing it depends on has changed; an error is tried again."""
    cell = whole_cell(directory, place.folder)
    return cell if cell is not None and cell.key == place.key and cell.verdict != Verdict.ERROR else None
