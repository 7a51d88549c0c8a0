from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.matrix.tasks import Task, TaskQueue, plan_seconds, tasks_of
from tests.comparisons.matrix.runs import plan
from tests.comparisons.matrix.scene_files import scene_file

if TYPE_CHECKING:
    from pathlib import Path

    from tests.comparisons.matrix.pretending import Pretender

pytestmark = pytest.mark.clause("RES-6")


def truth(seconds: float, *cells: float) -> Task:
    return Task("truth", (), seconds, tuple(Task("cells", (), of_cells) for of_cells in cells))


def test_one_process_begins_with_the_shortest_scene_and_the_others_with_the_longest() -> None:
    queue = TaskQueue([truth(3), truth(1, 1), truth(9), truth(1, 4)])
    taken = [queue.next_task(shortest=shortest).all_seconds for shortest in (True, False, False, True)]
    assert taken == [2, 9, 5, 3]
    assert not queue


def test_what_follows_a_task_comes_before_the_next_scene() -> None:
    queue = TaskQueue([truth(1, 2, 3), truth(20)])
    first = queue.next_task(shortest=True)
    queue.done(first, shortest=True)
    assert [queue.next_task(shortest=True).seconds for _ in range(3)] == [2, 3, 20]


def test_a_process_without_scenes_of_its_own_helps_the_others() -> None:
    queue = TaskQueue([truth(1, 2, 3)])
    queue.done(queue.next_task(shortest=True), shortest=True)
    assert [queue.next_task(shortest=False).seconds, queue.next_task(shortest=True).seconds] == [2, 3]
    assert not queue


def test_the_tasks_of_a_plan_are_the_truth_of_each_scene_and_then_its_cells(
    pretender: Pretender, tmp_path: Path
) -> None:
    planned = plan(pretender, [scene_file(tmp_path, name) for name in ("one", "two")], tmp_path / "out")
    tasks = tasks_of(planned)
    assert [(task.makes, [after.makes for after in task.then]) for task in tasks] == [("truth", ["cells"])] * 2
    assert plan_seconds(planned) == pytest.approx(sum(task.seconds + task.then[0].seconds for task in tasks))
