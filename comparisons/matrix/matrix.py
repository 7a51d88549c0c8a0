"""The conformance matrix: every scene on every renderer that can be compared with its truth."""

from __future__ import annotations

from collections import deque
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, ThreadPoolExecutor, wait
from dataclasses import dataclass
from multiprocessing import get_context
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.feasible_sets.kept_feasible_sets import kept_feasible_set
from raytruth.comparisons.judgement.verdict import Evidence
from raytruth.comparisons.matrix.cell import CELL_FILE, TRUTH_FILE, CellPlace, integrator_of, run_cell
from raytruth.comparisons.matrix.cell_key import cell_key
from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.matrix.kept_versions import kept_version, tried_version
from raytruth.comparisons.processes.interruption import at_work, interruption_held_back, start_worker
from raytruth.comparisons.records.image_files import write_image
from raytruth.comparisons.records.renderings import Rays
from raytruth.comparisons.records.results import Cell, Verdict
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.reference_tracer.certified_image import certified_image
from raytruth.reference_tracer.rendering import primary_rays, render
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from concurrent.futures import Future
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.renderers.protocol import Integrator, Renderer
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class PlannedCell:
    """A cell that is to be rendered, at this depth."""

    place: CellPlace
    depth: int


@dataclass(frozen=True)
class Plan:
    """What a run has to do, and the cells that are settled without rendering."""

    settled: tuple[Cell, ...]
    by_scene: dict[str, tuple[PlannedCell, ...]]
    """By what names the scene on the command line."""
    versions: Mapping[str, str | None]
    """Of each renderer; None where it cannot run here."""


def plan_run(sources: Sequence[str], renderers: Sequence[str], directory: Path, *, fresh: bool) -> Plan:
    """Settle what is unavailable, incomparable, or already in the directory; the rest is to be rendered.

    A cell is taken from the directory if its key (cell_key.py) is the same, unless `fresh`. Where nothing is left to
    render, what renderers told of their versions earlier will do (kept_versions.py); else each is tried.
    """
    kept = {} if fresh else {name: it for name in renderers if (it := kept_version(all_renderers()[name])) is not None}
    versions = kept | _tried([name for name in renderers if name not in kept])
    plan = _plan(sources, renderers, versions, directory, fresh=fresh)
    if kept and plan.by_scene:
        plan = _plan(sources, renderers, _tried(renderers), directory, fresh=fresh)
    return plan


def _tried(renderers: Sequence[str]) -> dict[str, str | None]:
    """The version of each renderer; all are tried side by side, each in a process of its own."""
    with ThreadPoolExecutor() as pool:
        return dict(zip(renderers, pool.map(lambda name: tried_version(all_renderers()[name]), renderers), strict=True))


def _plan(
    sources: Sequence[str],
    renderers: Sequence[str],
    versions: Mapping[str, str | None],
    directory: Path,
    *,
    fresh: bool,
) -> Plan:
    """The plan for renderers of these versions."""
    settled: list[Cell] = []
    by_scene: dict[str, tuple[PlannedCell, ...]] = {}
    for source in sources:
        scene = open_scene(source)
        planned: list[PlannedCell] = []
        for name in renderers:
            for integrator in all_renderers()[name].integrators:
                step = _planned(scene, source, all_renderers()[name], integrator, versions[name])
                done = _finished(directory, step) if isinstance(step, PlannedCell) and not fresh else None
                if isinstance(step, Cell):
                    settled.append(step)
                elif done is not None:
                    settled.append(done)
                else:
                    planned.append(step)
        if planned:
            by_scene[source] = tuple(planned)
    return Plan(tuple(settled), by_scene, {name: versions[name] for name in renderers})


def run_plan(plan: Plan, directory: Path, jobs: int) -> Iterator[Cell]:
    """The cells of the plan as they are finished, from `jobs` processes side by side.

    First the truth of a scene is made, then all cells of one error model are one task. When the caller stops early,
    what runs is finished and the rest is dropped.
    """
    waiting = deque(_Task(source) for source in sorted(plan.by_scene, key=_effort(plan), reverse=True))
    running: dict[Future[list[Cell]], _Task] = {}
    # Fresh interpreters: threads of a forked one may hold locks for ever.
    with ProcessPoolExecutor(jobs, get_context("spawn"), start_worker) as pool:
        while waiting or running:
            while waiting and len(running) < jobs:
                task = waiting.popleft()
                with interruption_held_back():
                    running[pool.submit(_do, task, directory)] = task
            for done in wait(running, return_when=FIRST_COMPLETED).done:
                task = running.pop(done)
                failure = done.exception()
                if failure is not None:
                    reason = f"raytruth itself failed on this scene: {type(failure).__name__}: {failure}"
                    lost = task.cells or plan.by_scene[task.source]
                    yield from (_settled(cell.place, Verdict.ERROR, reason) for cell in lost)
                elif task.cells:
                    yield from done.result()
                else:
                    # Before the next scene, so that little is lost when the run is killed.
                    groups = _by_error_model(plan, task.source)
                    waiting.extendleft(_Task(task.source, group) for group in reversed(groups))


@dataclass(frozen=True)
class _Task:
    """Work of one process: cells of one scene and one error model; without cells, the truth of the scene."""

    source: str
    cells: tuple[PlannedCell, ...] = ()


def _do(task: _Task, directory: Path) -> list[Cell]:
    with at_work():
        return run_cells(task.source, task.cells, directory) if task.cells else make_truth(task.source, directory)


def _effort(plan: Plan) -> Callable[[str], int]:
    """An estimate of how a scene's work compares with others', so that no long one is left for the end."""

    def effort(source: str) -> int:
        scene = open_scene(source)
        # Each bounce is another ray for each pixel of each feasible set, and the truth is as much work again.
        pixels = scene.camera.width * scene.camera.height
        return pixels * (1 + scene.max_depth) * (1 + len(_by_error_model(plan, source)))

    return effort


def _by_error_model(plan: Plan, source: str) -> list[tuple[PlannedCell, ...]]:
    """The cells of a scene that share a feasible set."""
    groups: dict[ErrorModel, list[PlannedCell]] = {}
    for cell in plan.by_scene[source]:
        groups.setdefault(all_renderers()[cell.place.renderer].error_model, []).append(cell)
    return [tuple(group) for group in groups.values()]


def make_truth(source: str, directory: Path) -> list[Cell]:
    """Leave the truth of a scene in the results and in the cache of certified images; there are no cells yet."""
    scene = open_scene(source)
    folder = directory / "cells" / scene.name
    folder.mkdir(parents=True, exist_ok=True)
    write_image(folder / TRUTH_FILE, _truth(scene).astype(np.float32))
    return []


def run_cells(source: str, planned: Sequence[PlannedCell], directory: Path) -> list[Cell]:
    """The feasible set of one scene and one error model, then every cell that is judged by it."""
    scene = open_scene(source)
    renderers = [all_renderers()[cell.place.renderer] for cell in planned]
    has_image = any(
        integrator_of(renderer, cell.place.integrator).gives != "first hits"
        for cell, renderer in zip(planned, renderers, strict=True)
    )
    feasible = kept_feasible_set(scene, renderers[0].error_model, with_colors=has_image)
    evidence = Evidence(scene, _truth(scene), Rays(*primary_rays(scene)), feasible)
    return [
        run_cell(cell.place, renderer, cell.depth, evidence, directory)
        for cell, renderer in zip(planned, renderers, strict=True)
    ]


def _truth(scene: Scene) -> NDArray[np.float64]:
    """The certified image; where that is undecided, the outcome next to the float64 image's value, if any is known."""
    image = certified_image(scene)
    truth = image.middle.copy()
    if image.undecided:
        rounded = np.asarray(render(scene), dtype=np.float64)
        for (column, line), reason in image.undecided.items():
            value = rounded[line, column]
            outcomes = [outcome.middle for outcome in reason.outcomes] or [value]
            truth[line, column] = min(outcomes, key=lambda outcome: float(np.abs(value - outcome).max()))
    return truth


def _planned(
    scene: Scene, source: str, renderer: Renderer, integrator: Integrator, version: str | None
) -> Cell | PlannedCell:
    key = cell_key(scene, renderer, integrator, version)
    place = CellPlace(scene.name, renderer.name, integrator.name, key, source, version)
    if version is None:
        return _settled(place, Verdict.UNAVAILABLE, f"{renderer.name} is not installed: {renderer.install}")
    depth = depth_or_reason(scene, renderer, integrator)
    if isinstance(depth, str):
        return _settled(place, Verdict.INCOMPARABLE, depth)
    return PlannedCell(place, depth)


def _settled(place: CellPlace, verdict: Verdict, reason: str) -> Cell:
    return Cell(
        scene=place.scene,
        renderer=place.renderer,
        integrator=place.integrator,
        verdict=verdict,
        reason=reason,
        command=place.command,
        key=place.key,
    )


def _finished(directory: Path, planned: PlannedCell) -> Cell | None:
    """The cell of an earlier run, if nothing it depends on has changed; an error is tried again."""
    try:
        text = (directory / planned.place.folder / CELL_FILE).read_text(encoding="utf-8")
        cell = Cell.model_validate_json(text)
    except (OSError, ValueError):
        return None
    return cell if cell.key == planned.place.key and cell.verdict != Verdict.ERROR else None
