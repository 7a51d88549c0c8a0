"""A grade as Gradescope reads it: `results.json` of an autograder ("Autograder Specifications", Output Format)."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from raytruth.reports.grade_text import diagnosis_sentence, headline, scene_sentence
from raytruth.reports.wording import printable

if TYPE_CHECKING:
    from raytruth.comparisons.records.grade_results import Grade, TopicGrade

# A log of a crash may be long; a screen of it tells as much, and hundreds of submissions stay small.
MOST_CHARACTERS = 4000


def gradescope_results(grade: Grade) -> str:
    """The document, from what the student may be told. It has no score where raytruth itself has failed.

    Gradescope then reports a failure of the autograder, which is no zero.
    """
    told = [headline(grade), *(f"-{it.charge:.2f}: {it.hint}" for it in grade.mistakes)]
    told += [diagnosis_sentence(it) for it in grade.diagnosis] + ([grade.unexplained] if grade.unexplained else [])
    document: dict[str, Any] = {
        "execution_time": round(grade.seconds, 3),
        "output": _text("\n".join(told)),
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "extra_data": {"assignment": grade.assignment, "status": grade.status, "raytruth": grade.raytruth_version},
    }
    if grade.status == "graded":
        document |= {"score": round(grade.score, 4), "tests": [_test(grade, topic) for topic in grade.clauses]}
    return json.dumps(document, indent=1)


def _test(grade: Grade, topic: TopicGrade) -> dict[str, Any]:
    """A topic with what came of its scenes."""
    own = [it for it in grade.scenes if it.name in topic.scenes]
    is_whole = topic.points == topic.maximum
    return {
        "name": _text(topic.title),
        "number": topic.id,
        "score": round(topic.points, 4),
        "max_score": round(topic.maximum, 4),
        "status": "passed" if is_whole else "failed",
        "output": _text("\n".join(f"{it.name}: {scene_sentence(it)}" for it in own)),
        "visibility": "visible",
    }


def _text(text: str) -> str:
    shown = "\n".join(printable(line) for line in text.splitlines())
    return shown if len(shown) <= MOST_CHARACTERS else f"{shown[:MOST_CHARACTERS]} …"
