"""What `raytruth run` tells on standard error: what it will do, about how long that takes, and how far it has come."""

from __future__ import annotations

import time
from math import ceil
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from raytruth.comparisons.matrix.run import forecast_of, run_plan
from raytruth.comparisons.records.results import Verdict
from raytruth.output import tell

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path

    from raytruth.comparisons.matrix.plan import Plan
    from raytruth.comparisons.records.results import Cell

# In a log a line tells what is left, this often: seldom beside the lines of cells, often enough to see that it goes on.
SECONDS_BETWEEN_LINES = 30.0
# A report of the whole library takes some ten seconds: it is made anew while the run goes on, but not at its cost.
SHARE_FOR_REPORTS = 0.05


def intention(plan: Plan, scenes: int, renderers: int, jobs: int) -> str:
    """What a run of this plan will do, in one sentence."""
    kept = sum(cell.source is not None for cell in plan.settled)
    parts = [
        f"{_count(len(plan.cells), 'cell')} to judge",
        f"{kept} kept",
        f"{len(plan.settled) - kept} not comparable",
    ]
    size = f"{_count(scenes, 'scene')} × {_count(renderers, 'renderer')}"
    return f"{size}: {', '.join(parts)}; {_takes(plan, jobs)}."


def change(foreseen: Plan, plan: Plan, jobs: int) -> str | None:
    """What is otherwise than foreseen now that renderers were tried, in one sentence; None if nothing is."""
    if len(plan.cells) == len(foreseen.cells):
        return None
    missing = sorted({cell.renderer for cell in plan.settled if cell.verdict == Verdict.UNAVAILABLE})
    reason = f" without {', '.join(missing)}" if missing else ""
    return f"{_count(len(plan.cells), 'cell')} to judge{reason}; {_takes(plan, jobs)}."


def judged(plan: Plan, out: Path, jobs: int) -> Iterator[Cell]:
    """The cells that the plan leaves to do, as they are finished, while it is told how far that has come."""
    forecast = forecast_of(plan, jobs)
    total = len(plan.cells)
    console = Console(stderr=True)
    left = TextColumn("{task.fields[left]}")
    # All of it has room on a terminal of 80 columns.
    columns = (TextColumn("{task.description}"), BarColumn(20), MofNCompleteColumn(), TimeElapsedColumn(), left)
    told = time.monotonic()
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task("Judging", total=total, left=_left(forecast.seconds_left))
        for done, cell in enumerate(run_plan(plan, out, jobs, forecast), start=1):
            yield cell
            words = _left(forecast.seconds_left)
            bar.update(task, completed=done, left=words)
            if not console.is_terminal or cell.verdict in {Verdict.FAIL, Verdict.ERROR}:
                tell(f"[{done}/{total}] {cell.scene} {cell.renderer} {cell.integrator}: {cell.verdict}")
            if not console.is_terminal and time.monotonic() > told + SECONDS_BETWEEN_LINES:
                told = time.monotonic()
                tell(f"raytruth: {words}")
    if total:
        forecast.pace.keep()


def shown_as_they_come(
    settled: Iterable[Cell], cells: Iterable[Cell], show: Callable[[Sequence[Cell]], None]
) -> list[Cell]:
    """All of them; now and then `show` is given those that there are by then."""
    so_far = list(settled)
    start, spent = time.monotonic(), 0.0
    for cell in cells:
        so_far.append(cell)
        before = time.monotonic()
        if before - start > SECONDS_BETWEEN_LINES + spent / SHARE_FOR_REPORTS:
            show(so_far)
            spent += time.monotonic() - before
    return so_far


def _takes(plan: Plan, jobs: int) -> str:
    return in_words(forecast_of(plan, jobs).seconds_left) if plan.cells else "nothing to do"


def _left(seconds: float) -> str:
    return f"{in_words(seconds)} left"


def in_words(seconds: float) -> str:
    """A length of time, no more exact than an estimate is."""
    if seconds < 10:
        return "a few seconds"
    if seconds < 90:
        return f"about {10 * ceil(seconds / 10)} seconds"
    return f"about {ceil(seconds / 60)} minutes"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
