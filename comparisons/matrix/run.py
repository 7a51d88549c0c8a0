"""A run of the matrix: renders and judges what the plan leaves to do, in processes side by side."""

from __future__ import annotations

import time
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from dataclasses import dataclass
from multiprocessing import get_context
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.judgement.judged_truth import judged_truth
from raytruth.comparisons.judgement.kept_expectation import kept_expectation
from raytruth.comparisons.matrix.cell import TRUTH_FILE, run_cell, settled_cell
from raytruth.comparisons.matrix.estimate import kept_pace
from raytruth.comparisons.matrix.tasks import TaskQueue, plan_seconds, tasks_of
from raytruth.comparisons.processes.interruption import at_work, interruption_held_back, start_worker
from raytruth.comparisons.records.image_files import write_image
from raytruth.comparisons.records.results import Cell, Verdict

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from concurrent.futures import Future
    from pathlib import Path

    from raytruth.comparisons.matrix.estimate import Pace
    from raytruth.comparisons.matrix.plan import Plan, PlannedCell
    from raytruth.comparisons.matrix.tasks import Task
    from raytruth.scenes.scene import Scene


@dataclass
class Forecast:
    """How much of a run is left, which it brings up to date."""

    pace: Pace
    jobs: int
    """How many processes work side by side."""
    left: float
    """Seconds of one process for all that is not done, as estimate.py has it."""

    def done(self, task: Task, seconds: float) -> None:
        """Take a task from what is left that took one process so long."""
        self.left -= task.seconds
        self.pace.note(task.seconds, seconds)

    @property
    def seconds_left(self) -> float:
        """About how long the run still takes."""
        return self.pace.seconds(max(0.0, self.left)) / self.jobs


def forecast_of(plan: Plan, jobs: int) -> Forecast:
    """Of a run of the plan that has not begun."""
    return Forecast(kept_pace(), jobs, plan_seconds(plan))


def run_plan(plan: Plan, directory: Path, jobs: int, forecast: Forecast | None = None) -> Iterator[Cell]:
    """The cells of the plan as they are finished, from `jobs` processes side by side.

    First the truth of a scene is made, then all cells of one error model are one task. When the caller stops early,
    what runs is finished and the rest is dropped.
    """
    forecast = forecast or forecast_of(plan, jobs)
    queue = TaskQueue(tasks_of(plan))
    running: dict[Future[tuple[list[Cell], float]], tuple[Task, bool]] = {}
    # Fresh interpreters: threads of a forked one may hold locks for ever.
    with ProcessPoolExecutor(jobs, get_context("spawn"), start_worker) as pool:
        while queue or running:
            while queue and len(running) < jobs:
                shortest = not any(is_short for _, is_short in running.values())
                task = queue.next_task(shortest=shortest)
                with interruption_held_back():
                    running[pool.submit(_do, task.makes, task.cells, directory)] = task, shortest
            for done in wait(running, return_when=FIRST_COMPLETED).done:
                task, shortest = running.pop(done)
                failure = done.exception()
                if failure is not None:
                    forecast.left -= task.all_seconds
                    reason = f"raytruth itself failed on this scene: {type(failure).__name__}: {failure}"
                    yield from (settled_cell(lost.place, Verdict.ERROR, reason) for lost in task.cells)
                else:
                    cells, seconds = done.result()
                    forecast.done(task, seconds)
                    queue.done(task, shortest=shortest)
                    yield from cells


def _do(makes: str, cells: Sequence[PlannedCell], directory: Path) -> tuple[list[Cell], float]:
    """The cells that a task makes, and how many seconds it took."""
    start = time.perf_counter()
    done: list[Cell] = []
    with at_work():
        if makes == "cells":
            done = run_cells(cells, directory)
        else:
            make_truth(cells[0].place.scene, directory)
    return done, time.perf_counter() - start


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
