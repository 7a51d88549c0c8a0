"""The scenes of an assignment: which there are, how large, and which of them are due at a stage."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.matrix.quick_suite import small
from raytruth.scenes.families.catalogue import family
from raytruth.scenes.library import open_scene
from raytruth.scenes.loading import SceneError
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.grading.assignment import Assignment, FamilyScenes, Stage
    from raytruth.scenes.scene import Scene


def scenes_of(
    assignment: Assignment, folder: Path, seed: int = 0, stage: Stage | None = None
) -> dict[str, tuple[Scene, ...]]:
    """The scenes of each topic that has any, by the topic's id; relative paths start at `folder`.

    `seed` is added to the seeds of families. Scenes that are not due at the stage are left out.
    Raises SceneError with every problem of every scene.
    """
    problems: list[str] = []
    found: dict[str, tuple[Scene, ...]] = {}
    for topic in assignment.topics:
        scenes = [scene for source in topic.scenes for scene in _opened(source, folder, problems)]
        for drawn in topic.families:
            scenes += _drawn(drawn, seed, problems)
        sized = scenes if assignment.full_size else [small(scene) for scene in scenes]
        due = tuple(scene for scene in sized if is_due(scene, stage))
        if due:
            found[topic.id] = due
    if problems:
        raise SceneError(problems)
    return found


def is_due(scene: Scene, stage: Stage | None) -> bool:
    """Whether a program must render the scene at this stage."""
    required = {feature.lower() for feature in required_features(scene)}
    return stage is None or required.isdisjoint(stage.without)


def _opened(source: str, folder: Path, problems: list[str]) -> list[Scene]:
    """The scene, or none and what is wrong with it."""
    try:
        return [open_scene(str(folder / source) if source.lower().endswith(".json") else source)]
    except SceneError as error:
        problems += error.problems
        return []


def _drawn(drawn: FamilyScenes, seed: int, problems: list[str]) -> list[Scene]:
    """The scenes of a family, each with a name that tells it from the others."""
    try:
        return [
            family(drawn.family, drawn.parameter, seed + own).model_copy(
                update={"name": f"{drawn.family}-{drawn.parameter:g}-{seed + own}"}
            )
            for own in drawn.seeds
        ]
    except (ValueError, ArithmeticError) as error:
        problems.append(f"family {drawn.family}: its parameter {drawn.parameter:g} gives no scene ({error}).")
        return []
