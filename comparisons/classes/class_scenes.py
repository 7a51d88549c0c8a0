"""What all submissions of a class are judged by, made once for each scene before any is graded."""

from __future__ import annotations

from concurrent.futures import wait
from typing import TYPE_CHECKING

from raytruth.comparisons.classes.apart import apart
from raytruth.comparisons.feasible_sets.kept_feasible_sets import kept_feasible_set
from raytruth.comparisons.grading.allowed_models import radiance_model
from raytruth.comparisons.judgement.judged_truth import judged_truth

if TYPE_CHECKING:
    from collections.abc import Sequence
    from concurrent.futures import Executor

    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.scenes.scene import Scene


def make_expectations(scenes: Sequence[Scene], assignment: Assignment, pool: Executor, workers: int) -> None:
    """Leave the truth of each scene, and what each allowed model may give, in the cache; each once, side by side.

    What fails here is told later: it fails in each submission again, as an error of the grader.
    """
    shares = [share for first in range(workers) if (share := scenes[first::workers])]
    wait([pool.submit(apart, expect_here, share, assignment) for share in shares])


def expect_here(scenes: Sequence[Scene], assignment: Assignment) -> None:
    """The same in this process."""
    for scene in scenes:
        judged_truth(scene)
        for model in assignment.models:
            kept_feasible_set(scene, radiance_model(model))
