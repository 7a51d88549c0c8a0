"""Grades one submission: its pictures, the reading that is best for it, its points, and what explains the rest."""

from __future__ import annotations

import time
from dataclasses import dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING

from raytruth.comparisons.grading.assignment_scenes import private_names
from raytruth.comparisons.grading.credit import scene_credit, score_of, topic_points
from raytruth.comparisons.grading.diagnosis import evidence_of
from raytruth.comparisons.grading.explanation import diagnosis
from raytruth.comparisons.grading.faulty_tracers import single_faults
from raytruth.comparisons.grading.first_difference import region_of, unexplained
from raytruth.comparisons.grading.global_mistakes import AS_IT_IS
from raytruth.comparisons.grading.reading import best_reading
from raytruth.comparisons.grading.scene_grading import graded_picture, judged_as
from raytruth.comparisons.grading.submission import as_graded
from raytruth.comparisons.records.grade_results import Grade, MistakeGrade, SceneGrade, TopicGrade
from raytruth.comparisons.renderers.program.declared_model import output_model_of
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from concurrent.futures import Executor
    from datetime import datetime

    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.global_mistakes import Reading
    from raytruth.comparisons.grading.scene_grading import GradedPicture
    from raytruth.comparisons.records.grade_results import Diagnosed
    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class Occasion:
    """When a submission is graded."""

    stage: str | None = None
    attempt: int = 1
    date: datetime | None = None
    """When it was handed in, with its offset from UTC; None: before all dates of the assignment."""
    seed: int = 0
    """What was added to the seeds of scenes that are drawn: by it private ones are told from others."""


def grade_submission(
    program: ProgramRenderer,
    assignment: Assignment,
    topics: Mapping[str, Sequence[Scene]],
    occasion: Occasion,
    pool: Executor,
) -> Grade:
    """The grade of a program for the scenes of each topic, by their ids. What goes wrong in a worker of the pool on one
    scene is an error of the grader: that scene counts for nothing, and the grade says so.
    """
    start = time.perf_counter()
    given, declared = as_graded(program, assignment), output_model_of(program.declaration)
    scenes = {scene.name: scene for of_topic in topics.values() for scene in of_topic}
    jobs = {name: pool.submit(graded_picture, given, assignment, scene, declared) for name, scene in scenes.items()}
    failures = {name: str(job.exception()) for name, job in jobs.items() if job.exception() is not None}
    pictures = {name: job.result() for name, job in jobs.items() if name not in failures}
    names = {topic: [it.name for it in of_topic if it.name in pictures] for topic, of_topic in topics.items()}
    names = {topic: of_topic for topic, of_topic in names.items() if of_topic}
    reading = AS_IT_IS
    if any(picture.counts.wrong for picture in pictures.values()):
        images = {name: it.submitted.image for name, it in pictures.items() if it.submitted.image is not None}
        own = {name: scenes[name] for name in pictures}
        reading = best_reading(images, own, assignment, names, declared, pool)
        if reading != AS_IT_IS:
            pictures = _reread(pictures, reading, assignment, declared, pool)
    tells_all = assignment.tells_private(occasion.date)
    private = private_names(assignment, occasion.seed)
    shown = [it for name, it in pictures.items() if tells_all or name not in private]
    explained = diagnose(shown, reading, declared, assignment, pool)
    return _record(assignment, occasion, program.name, names, pictures, failures, reading, explained, start)


def diagnose(
    pictures: Sequence[GradedPicture], reading: Reading, declared: OutputModel, assignment: Assignment, pool: Executor
) -> tuple[list[Diagnosed], str]:
    """The known mistakes that explain what is wrong, and where it shows first if none explains all of it."""
    evidence = evidence_of(pictures, reading, declared, assignment)
    if not any(it.wrong.any() for it in evidence):
        return [], ""
    told = diagnosis(evidence, single_faults(), pool)
    if any(it.is_whole for it in told):
        return told, ""
    return told, unexplained(evidence, in_part=bool(told))


def _reread(
    pictures: Mapping[str, GradedPicture],
    reading: Reading,
    assignment: Assignment,
    declared: OutputModel,
    pool: Executor,
) -> dict[str, GradedPicture]:
    """The same pictures, judged with the mistakes of the reading undone."""
    jobs = {
        name: pool.submit(judged_as, reading, it.submitted, assignment, it.scene, declared)
        for name, it in pictures.items()
    }
    return {name: job.result() for name, job in jobs.items()}


def _record(
    assignment: Assignment,
    occasion: Occasion,
    submission: str,
    names: Mapping[str, Sequence[str]],
    pictures: Mapping[str, GradedPicture],
    failures: Mapping[str, str],
    reading: Reading,
    explained: tuple[list[Diagnosed], str],
    start: float,
) -> Grade:
    points = topic_points(assignment, names, {name: it.counts for name, it in pictures.items()})
    scenes = _scene_grades(assignment, occasion, pictures, failures)
    return Grade(
        raytruth_version=version("raytruth"),
        assignment=assignment.name,
        title=assignment.title,
        submission=submission,
        stage=occasion.stage,
        attempt=occasion.attempt,
        told=assignment.told(occasion.attempt, occasion.date),
        seed=occasion.seed,
        date=occasion.date.isoformat() if occasion.date else None,
        tells_private=assignment.tells_private(occasion.date),
        status="grader_error" if failures else "graded",
        score=score_of(points.values(), len(reading), assignment),
        maximum=score_of([(most, most) for _, most in points.values()], 0, assignment),
        clauses=_topic_grades(points, names, assignment),
        mistakes=_mistake_grades(points, reading, assignment),
        scenes=scenes,
        diagnosis=tuple(explained[0]),
        unexplained=explained[1],
        seconds=time.perf_counter() - start,
    )


def _scene_grades(
    assignment: Assignment,
    occasion: Occasion,
    pictures: Mapping[str, GradedPicture],
    failures: Mapping[str, str],
) -> tuple[SceneGrade, ...]:
    """All scenes in the order of their names, those that raytruth itself could not grade among them."""
    private = private_names(assignment, occasion.seed)
    scenes = [_scene_grade(it, assignment, is_private=name in private) for name, it in pictures.items()]
    scenes += [
        SceneGrade(
            name=name,
            purpose="",
            verdict="grader_error",
            credit=0.0,
            reason=f"raytruth itself failed: {why}",
            is_private=name in private,
        )
        for name, why in failures.items()
    ]
    return tuple(sorted(scenes, key=lambda it: it.name))


def _topic_grades(
    points: Mapping[str, tuple[float, float]], names: Mapping[str, Sequence[str]], assignment: Assignment
) -> tuple[TopicGrade, ...]:
    titles = {topic.id: topic.title for topic in assignment.topics}
    return tuple(
        TopicGrade(id=topic, title=titles[topic], points=got, maximum=most, scenes=tuple(names[topic]))
        for topic, (got, most) in points.items()
    )


def _mistake_grades(
    points: Mapping[str, tuple[float, float]], reading: Reading, assignment: Assignment
) -> tuple[MistakeGrade, ...]:
    """Each global mistake with an equal part of what all of them cost."""
    lost = score_of(points.values(), 0, assignment) - score_of(points.values(), len(reading), assignment)
    return tuple(MistakeGrade(name=it.name, words=it.words, hint=it.hint, charge=lost / len(reading)) for it in reading)


def _scene_grade(picture: GradedPicture, assignment: Assignment, *, is_private: bool) -> SceneGrade:
    """What came of a scene that was rendered, or that the program could not render."""
    counts, given, scene = picture.counts, picture.submitted, picture.scene
    credit = scene_credit(counts, assignment)
    features = tuple(sorted(name.lower().replace("_", " ") for name in required_features(scene)))
    told = {"name": scene.name, "purpose": scene.purpose, "features": features, "credit": credit}
    told["is_private"] = is_private
    if given.image is None:
        return SceneGrade(**told, verdict="error", reason=given.problem, seconds=given.seconds)
    region = None
    if counts.wrong:
        columns, rows = region_of(picture.wrong)
        region = (*columns, *rows)
    return SceneGrade(
        **told,
        verdict="right" if credit == 1.0 else "wrong",
        reason=_reason(picture),
        pixels=counts.judged + counts.unjudged,
        wrong=counts.wrong,
        unjudged=counts.unjudged,
        declared=counts.declared,
        region=region,
        seconds=given.seconds,
    )


def _reason(picture: GradedPicture) -> str:
    counts = picture.counts
    aside = f" ({counts.unjudged} cannot be judged)" if counts.unjudged else ""
    if counts.wrong:
        return f"{counts.wrong} of {counts.judged} pixels are what no right program gives{aside}"
    if counts.declared:
        by = "right only by an epsilon or a departure that the assignment allows"
        return f"all {counts.judged} pixels are right, {counts.declared} of them {by}{aside}"
    return f"all {counts.judged} pixels are right{aside}"
