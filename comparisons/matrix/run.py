"""A run of the matrix: renders and judges what the plan leaves to do, in processes side by side."""

from __future__ import annotations

from collections import deque
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from dataclasses import dataclass
from multiprocessing import get_context
from typing import TYPE_CHECKING, Literal

import numpy as np

from raytruth.comparisons.judgement.judged_truth import judged_truth
from raytruth.comparisons.judgement.kept_expectation import kept_expectation
from raytruth.comparisons.matrix.cell import TRUTH_FILE, run_cell, settled_cell
from raytruth.comparisons.processes.interruption import at_work, interruption_held_back, start_worker
from raytruth.comparisons.records.image_files import write_image
from raytruth.comparisons.records.results import Cell, Verdict

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from concurrent.futures import Future
    from pathlib import Path

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.matrix.plan import Plan, PlannedCell
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True, eq=False)
class _Task:
    """Work of one process for cells of one scene: the truth that they need, or, of one error model, the cells."""

    makes: Literal["truth", "cells"]
    cells: tuple[PlannedCell, ...]


def run_plan(plan: Plan, directory: Path, jobs: int) -> Iterator[Cell]:
    """The cells of the plan as they are finished, from `jobs` processes side by side.

    First the truth of a scene is made, then all cells of one error model are one task. When the caller stops early,
    what runs is finished and the rest is dropped.
    """
    waiting = deque(_Task("truth", cells) for cells in sorted(plan.by_scene.values(), key=_effort, reverse=True))
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
                    yield from (settled_cell(lost.place, Verdict.ERROR, reason) for lost in task.cells)
                elif task.makes == "cells":
                    yield from done.result()
                else:
                    # Before the next scene, so that little is lost when the run is killed.
                    waiting.extendleft(_Task("cells", group) for group in reversed(_by_error_model(task.cells)))


def _do(task: _Task, directory: Path) -> list[Cell]:
    with at_work():
        if task.makes == "cells":
            return run_cells(task.cells, directory)
        make_truth(task.cells[0].place.scene, directory)
        return []


def _effort(cells: Sequence[PlannedCell]) -> int:
    """An estimate of how a scene's work compares with others', so that no long one is left for the end."""
    scene = cells[0].place.scene
    # Each bounce is another ray for each pixel of each feasible set, and the truth is as much work again.
    pixels = scene.camera.width * scene.camera.height
    return pixels * (1 + scene.max_depth) * (1 + len(_by_error_model(cells)))


def _by_error_model(cells: Sequence[PlannedCell]) -> list[tuple[PlannedCell, ...]]:
    """The cells of a scene that share a feasible set."""
    groups: dict[ErrorModel, list[PlannedCell]] = {}
    for cell in cells:
        groups.setdefault(cell.error_model, []).append(cell)
    return [tuple(group) for group in groups.values()]


def make_truth(scene: Scene, directory: Path) -> None:
    """Leave the truth of a scene in the results and in the cache of certified images."""
    folder = directory / "cells" / scene.name
    folder.mkdir(parents=True, exist_ok=True)
    write_image(folder / TRUTH_FILE, judged_truth(scene).astype(np.float32))


def run_cells(planned: Sequence[PlannedCell], directory: Path) -> list[Cell]:
    """The feasible set of one scene and one error model, then every cell that is judged by it."""
    scene, error_model = planned[0].place.scene, planned[0].error_model
    has_image = any(cell.place.integrator.gives != "first hits" for cell in planned)
    expectation = kept_expectation(scene, error_model, with_colors=has_image)
    return [run_cell(cell.place, cell.depth, expectation, directory) for cell in planned]
