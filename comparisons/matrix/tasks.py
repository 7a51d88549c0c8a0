"""The work of a run in tasks, each of one process, and the order in which they are begun."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from raytruth.comparisons.matrix.estimate import cells_seconds, truth_seconds

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.matrix.plan import Plan, PlannedCell


@dataclass(frozen=True, eq=False)
class Task:
    """Work of one process for cells of one scene: the truth that they need, or, of one error model, the cells."""

    makes: Literal["truth", "cells"]
    cells: tuple[PlannedCell, ...]
    seconds: float
    """How long it takes, as estimate.py has it."""
    then: tuple[Task, ...] = ()
    """What can be begun when it is done."""

    @property
    def all_seconds(self) -> float:
        """Of the task and of all that follows it."""
        return self.seconds + sum(task.all_seconds for task in self.then)


def tasks_of(plan: Plan) -> list[Task]:
    """A task for the truth of each scene, each followed by those of its cells, the shortest first."""
    return [_scene_task(cells) for cells in plan.by_scene.values()]


def plan_seconds(plan: Plan) -> float:
    """How long one process takes for the plan, as estimate.py has it."""
    return sum(task.all_seconds for task in tasks_of(plan))


def _scene_task(cells: tuple[PlannedCell, ...]) -> Task:
    groups = [Task("cells", group, cells_seconds(group)) for group in _by_error_model(cells)]
    then = tuple(sorted(groups, key=lambda task: task.seconds))
    return Task("truth", cells, truth_seconds(cells), then)


def _by_error_model(cells: Sequence[PlannedCell]) -> list[tuple[PlannedCell, ...]]:
    """The cells of a scene that share a feasible set."""
    groups: dict[ErrorModel, list[PlannedCell]] = {}
    for cell in cells:
        groups.setdefault(cell.error_model, []).append(cell)
    return [tuple(group) for group in groups.values()]


class TaskQueue:
    """Which task is next.

    One process begins with the shortest scene and goes on to longer ones, so that the first verdicts come at once; all
    others begin with the longest, so that none of these is left for the end. A scene that is begun is finished before
    the next one, so that little is lost when the run is killed.
    """

    def __init__(self, tasks: Iterable[Task]) -> None:
        """`tasks` are those that can be begun."""
        self._waiting = deque(sorted(tasks, key=lambda task: task.all_seconds))
        self._begun: dict[bool, deque[Task]] = {True: deque(), False: deque()}

    def __bool__(self) -> bool:
        """Whether there is a next one."""
        return bool(self._waiting or self._begun[True] or self._begun[False])

    def next_task(self, *, shortest: bool) -> Task:
        """Take a task, of the shortest scene or of the longest; of the other kind if there is none."""
        for begun in (self._begun[shortest], *([] if self._waiting else [self._begun[not shortest]])):
            if begun:
                return begun.popleft()
        return self._waiting.popleft() if shortest else self._waiting.pop()

    def done(self, task: Task, *, shortest: bool) -> None:
        """What follows the task, taken as one of the shortest or of the longest scenes, can be begun."""
        self._begun[shortest].extend(task.then)
