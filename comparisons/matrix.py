"""The conformance matrix: every scene on every renderer that can be compared with its truth."""

from __future__ import annotations

import hashlib
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from multiprocessing import get_context
from typing import TYPE_CHECKING

import numpy as np

from comparisons.cell import CELL_FILE, TRUTH_FILE, CellPlace, run_cell
from comparisons.comparability import depth_or_reason
from comparisons.feasible_set import feasible_set
from comparisons.image_judgement import Evidence
from comparisons.images import write_image
from comparisons.renderer import Rays
from comparisons.renderers.catalogue import all_renderers
from comparisons.results import Cell, Verdict
from reference_tracer.certified_image import certified_image, collect_garbage_rarely
from reference_tracer.rendering import primary_rays, render
from reference_tracer.source_digest import source_digest
from scenes.library import open_scene

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from comparisons.error_model import ErrorModel
    from comparisons.feasible_set import FeasibleSet
    from comparisons.renderer import Integrator, Renderer
    from scenes.scene import Scene


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


def plan_run(sources: Sequence[str], renderers: Sequence[str], directory: Path, *, fresh: bool) -> Plan:
    """Settle what is unavailable, incomparable, or already in the directory; the rest is to be rendered.

    A cell is taken from the directory if its key is the same, that is the scene, the renderer's version and all of our
    own code, unless `fresh`.
    """
    settled: list[Cell] = []
    by_scene: dict[str, tuple[PlannedCell, ...]] = {}
    versions = {name: all_renderers()[name].version() for name in renderers}
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
    return Plan(tuple(settled), by_scene)


def run_plan(plan: Plan, directory: Path, jobs: int) -> Iterator[Cell]:
    """The cells of the plan as they are finished; scenes run side by side in `jobs` processes.

    When the caller stops early, what runs is finished and the rest is dropped.
    """
    # Fresh interpreters: threads of a forked one may hold locks for ever.
    with ProcessPoolExecutor(jobs, get_context("spawn"), collect_garbage_rarely) as pool:
        # The scenes with the most cells first, so that no long one is left for the end.
        order = sorted(plan.by_scene, key=lambda source: -len(plan.by_scene[source]))
        waiting = {pool.submit(run_scene, source, plan.by_scene[source], directory): source for source in order}
        try:
            for done in as_completed(waiting):
                failure = done.exception()
                if failure is None:
                    yield from done.result()
                else:
                    reason = f"raytruth itself failed on this scene: {type(failure).__name__}: {failure}"
                    planned = plan.by_scene[waiting[done]]
                    yield from (_settled(cell.place, Verdict.ERROR, reason) for cell in planned)
        finally:
            pool.shutdown(cancel_futures=True)


def run_scene(source: str, planned: Sequence[PlannedCell], directory: Path) -> list[Cell]:
    """Truth once, the feasible set once for each error model, then every cell of one scene."""
    scene = open_scene(source)
    truth = _truth(scene)
    rays = Rays(*primary_rays(scene))
    folder = directory / "cells" / scene.name
    folder.mkdir(parents=True, exist_ok=True)
    write_image(folder / TRUTH_FILE, truth.astype(np.float32))
    feasible: dict[ErrorModel, FeasibleSet] = {}
    cells = []
    for cell in planned:
        renderer = all_renderers()[cell.place.renderer]
        model = renderer.error_model
        if model not in feasible:
            feasible[model] = feasible_set(scene, model)
        evidence = Evidence(scene, truth, rays, feasible[model])
        cells.append(run_cell(cell.place, renderer, cell.depth, evidence, directory))
    return cells


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
    key = _key(scene, renderer, integrator, version)
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


def _key(scene: Scene, renderer: Renderer, integrator: Integrator, version: str | None) -> str:
    code = source_digest("scenes", "reference_tracer", "comparisons")
    parts = (scene.model_dump_json(), renderer.name, integrator.name, str(version), code)
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]
