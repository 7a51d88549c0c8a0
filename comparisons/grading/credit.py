"""From right and wrong pixels to points: nothing else of a submission is looked at here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.scene_expectations import PixelFit


@dataclass(frozen=True)
class SceneCounts:
    """How many pixels of a scene's picture fared how; all 0 where there is no picture."""

    judged: int = 0
    wrong: int = 0
    unjudged: int = 0
    declared: int = 0
    """Right ones that are so only by an epsilon or a departure."""
    counted: int = 0
    """Those that partial credit is given for, and of these the right ones."""
    counted_right: int = 0


NO_PICTURE = SceneCounts()


def counts_of(fit: PixelFit) -> SceneCounts:
    """The counts of a picture's pixels."""
    counted = fit.counted & ~fit.unjudged
    return SceneCounts(
        judged=int((~fit.unjudged).sum()),
        wrong=int(fit.wrong.sum()),
        unjudged=int(fit.unjudged.sum()),
        declared=int(fit.declared.sum()),
        counted=int(counted.sum()),
        counted_right=int((counted & fit.right).sum()),
    )


def scene_credit(counts: SceneCounts, assignment: Assignment) -> float:
    """What share of a scene's points it gets, 0 to 1: all where no pixel is wrong, else a part by the right ones.

    Pixels that are right only as declared count as right, unless they are more than the assignment allows: then the
    scene is not without a mistake.
    """
    if counts.judged == 0:  # nothing can be held against a picture of which every pixel is open
        return 1.0 if counts.unjudged else 0.0
    if counts.wrong == 0 and counts.declared <= assignment.declared_pixels * counts.judged:
        return 1.0
    right = counts.counted_right / counts.counted if counts.counted else 0.0
    return assignment.partial_credit * right


def topic_points(
    assignment: Assignment, scenes: Mapping[str, Sequence[str]], counts: Mapping[str, SceneCounts]
) -> dict[str, tuple[float, float]]:
    """Points and most points of each topic that has scenes: `scenes` by topic, `counts` by scene.

    A topic's most points are its share of all weights; it gets the mean credit of its scenes of these.
    """
    weights = {topic.id: topic.weight for topic in assignment.topics if topic.id in scenes}
    total = sum(weights.values())
    found = {}
    for topic, weight in weights.items():
        most = assignment.points * weight / total
        credits = [scene_credit(counts.get(scene, NO_PICTURE), assignment) for scene in scenes[topic]]
        found[topic] = (most * float(np.mean(sorted(credits))), most)  # sorted: sums do not depend on the order
    return found


def score_of(points: Iterable[tuple[float, float]], mistakes: int, assignment: Assignment) -> float:
    """The sum of all topics' points, less what so many global mistakes cost; never below 0."""
    return sum(sorted(point for point, _ in points)) * max(0.0, 1.0 - assignment.global_charge * mistakes)
