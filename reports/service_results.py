"""A grade as PrairieLearn and GitHub Classroom read it; for Gradescope see gradescope.py."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from raytruth.reports.grade_text import grade_lines, headline, scene_sentence
from raytruth.reports.gradescope import gradescope_results
from raytruth.reports.wording import printable

if TYPE_CHECKING:
    from raytruth.comparisons.records.class_results import Service
    from raytruth.comparisons.records.grade_results import Grade, TopicGrade


def service_results(service: Service, grade: Grade) -> str:
    """The document for a service, from what the student may be told."""
    if service == "gradescope":
        return gradescope_results(grade)
    document = _for_prairielearn(grade) if service == "prairielearn" else _for_classroom(grade)
    return json.dumps(document, indent=1)


def _for_prairielearn(grade: Grade) -> dict[str, Any]:
    """As "External grading", section Grading results, has it. What is not gradable costs no attempt."""
    if grade.status == "grader_error":
        return {"gradable": False, "message": headline(grade)}
    return {
        "gradable": True,
        "score": grade.score / grade.maximum if grade.maximum else 0.0,
        "message": headline(grade),
        "output": printable("\n".join(grade_lines(grade))),
        "tests": [
            {
                "name": printable(it.title),
                "points": it.points,
                "max_points": it.maximum,
                "output": printable(_scenes_of(grade, it)),
            }
            for it in grade.clauses
        ],
    }


def _for_classroom(grade: Grade) -> dict[str, Any]:
    """As GitHub's autograding reporter adds up the points of its runners; `markdown` is for the job's page."""
    is_whole = grade.status == "graded" and grade.score == grade.maximum
    status = "error" if grade.status == "grader_error" else "pass" if is_whole else "fail"
    test = {"name": grade.title, "status": status, "score": grade.score, "message": headline(grade)}
    return {
        "version": 1,
        "status": status,
        "max_score": grade.maximum,
        "tests": [{**test, "test_code": "", "filename": "", "line_no": 0, "execution_time": ""}],
        "markdown": "\n".join(f"    {printable(line)}" for line in grade_lines(grade)),
    }


def _scenes_of(grade: Grade, topic: TopicGrade) -> str:
    own = [it for it in grade.scenes if it.name in topic.scenes]
    return "\n".join(f"{it.name}: {scene_sentence(it)}" for it in own)
