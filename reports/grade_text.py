"""A grade in plain lines: on a terminal, in Gradescope, and in JUnit's failures."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from raytruth.comparisons.records.grade_results import Diagnosed, Grade, MistakeGrade, SceneGrade


def points(value: float) -> str:
    """Points with two digits behind the point, as far as they are not 0."""
    return f"{value:.2f}".rstrip("0").rstrip(".")


def headline(grade: Grade) -> str:
    """The score in one sentence, or that there is none by raytruth's own fault."""
    if grade.status == "grader_error":
        failed = ", ".join(it.name for it in grade.scenes if it.verdict == "grader_error")
        aside = f" on {failed}" if failed else ""
        return f"raytruth itself failed{aside}: this is no grade, and no fault of the submission."
    return f"{points(grade.score)} of {points(grade.maximum)} points."


def grade_lines(grade: Grade) -> list[str]:
    """All that a grade holds, a line each."""
    lines = [f"{grade.title}: {headline(grade)}"]
    lines += [f"  {it.title}: {points(it.points)} of {points(it.maximum)}" for it in grade.clauses]
    lines += [
        f"  Charged once, undone, and the rest graded: -{points(it.charge)}. {_mistake(it)}" for it in grade.mistakes
    ]
    lines += [f"  {it.verdict} {it.name}: {scene_sentence(it)}" for it in grade.scenes if it.verdict != "right"]
    lines += [f"  {diagnosis_sentence(it)}" for it in grade.diagnosis]
    return [*lines, f"  {grade.unexplained}"] if grade.unexplained else lines


def scene_sentence(scene: SceneGrade) -> str:
    """What came of a scene, and where it is wrong."""
    if scene.region is None:
        return f"{scene.reason.rstrip('.')}."
    left, right, top, bottom = scene.region
    return f"{scene.reason}, in columns {left} to {right}, rows {top} to {bottom}."


def diagnosis_sentence(told: Diagnosed) -> str:
    """How much a fault explains, and where to look; what it is, if that is in the record."""
    share = 100.0 * told.likelihood
    proof = f"{told.explained} of {told.looked_at} wrong pixels ({share:.0f} %) are what a tracer gives with"
    which = f"the mistake {told.fault}: {told.words}" if told.words else "one known mistake."
    against = f" But {told.contradicted} right pixels speak against it." if told.contradicted else ""
    open_ones = f" Of {told.left_open} more nothing can be proved." if told.left_open else ""
    return f"{told.clause}: {proof} {which}{against}{open_ones} {told.hint}"


def _mistake(told: MistakeGrade) -> str:
    return f"{told.words} {told.hint}".strip()
