"""Which global mistakes a submission has made: those with which it gets most, less what they cost."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.grading.credit import NO_PICTURE, score_of, topic_points
from raytruth.comparisons.grading.global_mistakes import needs_other_rays, readings
from raytruth.comparisons.grading.scene_grading import counts_by_reading, visible_agreement

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from concurrent.futures import Executor

    import numpy as np
    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.credit import SceneCounts
    from raytruth.comparisons.grading.global_mistakes import Reading
    from raytruth.scenes.scene import Scene

# Of readings that need the truth of other rays, which takes seconds a scene, the two that look most like the pictures:
# half a pixel to opposite corners looks alike where a picture is mirrored.
MOST_OTHER_RAYS = 2


def best_place(
    counts: Mapping[int, Mapping[str, SceneCounts]],
    mistakes: Mapping[int, int],
    assignment: Assignment,
    topics: Mapping[str, Sequence[str]],
) -> int:
    """The place of the reading with the highest score; of equals that with the fewest mistakes, then the first.

    `counts` by reading and scene; `mistakes` is how many a reading has.
    """

    def score(place: int) -> tuple[float, int, int]:
        points = topic_points(assignment, topics, counts[place]).values()
        return score_of(points, mistakes[place], assignment), -mistakes[place], -place

    return max(counts, key=score)


def best_reading(
    images: Mapping[str, NDArray[np.float64]],
    scenes: Mapping[str, Scene],
    assignment: Assignment,
    topics: Mapping[str, Sequence[str]],
    declared: OutputModel,
    pool: Executor,
) -> Reading:
    """The reading of all pictures together that is best for the student."""
    known = readings(declared)
    seen = list(
        pool.map(visible_agreement, images.values(), [scenes[name] for name in images], [declared] * len(images))
    )
    totals = {place: sum(agreement[place] for agreement in seen) for place in (seen[0] if seen else {})}
    by_own_rays = max((total for place, total in totals.items() if not needs_other_rays(known[place])), default=0)
    promising = [place for place in totals if needs_other_rays(known[place]) and totals[place] > by_own_rays]
    promising = sorted(promising, key=lambda place: (-totals[place], place))[:MOST_OTHER_RAYS]
    places = [place for place, reading in enumerate(known) if not needs_other_rays(reading)] + promising
    jobs = {
        name: pool.submit(counts_by_reading, image, assignment, scenes[name], declared, places)
        for name, image in images.items()
    }
    by_scene = {name: job.result() for name, job in jobs.items()}
    by_place = {
        place: {name: by_scene[name][place] if name in by_scene else NO_PICTURE for name in scenes} for place in places
    }
    mistakes = {place: len(known[place]) for place in places}
    return known[best_place(by_place, mistakes, assignment, topics)]
