"""What a student is told of a grade: no solution, and no more than the assignment's feedback allows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.grading.assignment import LEVELS

if TYPE_CHECKING:
    from raytruth.comparisons.records.grade_results import Grade

# More guesses than a student can follow up.
MOST_HINTS = 3


def for_student(grade: Grade) -> Grade:
    """The same grade without names and sentences that say what the mistake is, and without what is told later only."""
    level = LEVELS.index(grade.told)
    tells_topics, tells_scenes, tells_pixels, tells_diagnosis = (level >= step for step in range(1, 5))
    shown = [it for it in grade.diagnosis if it.is_whole][:1] or list(grade.diagnosis[:MOST_HINTS])
    hints = [
        it.model_copy(update={"fault": f"mistake {number}", "words": ""}) for number, it in enumerate(shown, start=1)
    ]
    scenes = grade.scenes if tells_scenes else ()
    if not tells_pixels:
        scenes = tuple(it.model_copy(update={"region": None}) for it in scenes)
    mistakes = [
        it.model_copy(update={"name": f"mistake {number}", "words": ""})
        for number, it in enumerate(grade.mistakes, start=1)
    ]
    return grade.model_copy(
        update={
            "clauses": grade.clauses if tells_topics else (),
            "scenes": scenes,
            "mistakes": tuple(mistakes) if tells_topics else (),
            "diagnosis": tuple(hints) if tells_diagnosis else (),
            "unexplained": grade.unexplained if tells_diagnosis else "",
        }
    )
