"""One scene of a submission in a process of its own: the picture, and how it fares under each reading of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.grading.allowed_models import radiance_model
from raytruth.comparisons.grading.credit import SceneCounts, counts_of
from raytruth.comparisons.grading.global_mistakes import (
    AS_IT_IS,
    corrected,
    rays_of,
    readings,
    rendered_scene,
    written_values,
)
from raytruth.comparisons.grading.scene_expectations import SceneExpectations
from raytruth.comparisons.grading.submission import submitted
from raytruth.comparisons.measures.visibility import differs_visibly
from raytruth.comparisons.processes.interruption import at_work
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.global_mistakes import Reading
    from raytruth.comparisons.grading.submission import Submitted
    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
    from raytruth.reference_tracer.camera_rays import CameraRays
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True, eq=False)
class GradedPicture:
    """A picture as it is, and where it is wrong."""

    scene: Scene
    submitted: Submitted
    counts: SceneCounts
    right: NDArray[np.bool_]
    wrong: NDArray[np.bool_]


def expectations_of(scene: Scene, assignment: Assignment) -> SceneExpectations:
    """What the assignment allows of the scene's pixels."""
    return SceneExpectations(scene, [radiance_model(model) for model in assignment.models])


@at_work()
def graded_picture(
    program: ProgramRenderer, assignment: Assignment, scene: Scene, declared: OutputModel
) -> GradedPicture:
    """Run the program on the scene, and judge its picture as it is."""
    return judged_as(AS_IT_IS, submitted(program, scene), assignment, scene, declared)


@at_work()
def judged_as(
    reading: Reading, given: Submitted, assignment: Assignment, scene: Scene, declared: OutputModel
) -> GradedPicture:
    """A picture that is there already, taken to have these mistakes."""
    if given.image is None:
        nowhere = np.zeros((scene.camera.height, scene.camera.width), dtype=bool)
        return GradedPicture(scene, given, SceneCounts(), nowhere, nowhere)
    fit = expectations_of(scene, assignment).fit(given.image, declared, reading)
    return GradedPicture(scene, given, counts_of(fit), fit.right, fit.wrong)


@at_work()
def counts_by_reading(
    image: NDArray[np.float64],
    assignment: Assignment,
    scene: Scene,
    declared: OutputModel,
    places: Sequence[int],
) -> dict[int, SceneCounts]:
    """The counts of a picture under some of all readings, by their places in the list."""
    expectations, known = expectations_of(scene, assignment), readings(declared)
    return {place: counts_of(expectations.fit(image, declared, known[place])) for place in places}


@at_work()
def visible_agreement(image: NDArray[np.float64], scene: Scene, declared: OutputModel) -> dict[int, int]:
    """For each reading how many pixels look like what the tracer renders for it, which takes no feasible set.

    It only tells for which readings the truth of other rays is worth finding.
    """
    rendered: dict[tuple[str, CameraRays], NDArray[np.float64]] = {}
    found = {}
    for place, reading in enumerate(readings(declared)):
        shown, rays = rendered_scene(reading, scene), rays_of(reading)
        key = (shown.name, rays)
        if key not in rendered:
            rendered[key] = np.asarray(render(shown, FLOAT, rays.behaviour()), dtype=np.float64)
        seen = ~differs_visibly(corrected(reading, image), written_values(reading, rendered[key])).any(axis=2)
        found[place] = int(seen.sum())
    return found
