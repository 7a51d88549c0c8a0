"""What a student is told of a grade: no solution, and no more than the assignment's feedback allows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.grading.assignment import LEVELS

if TYPE_CHECKING:
    from raytruth.comparisons.records.grade_results import Grade

# More guesses than a student can follow up.
MOST_HINTS = 3


def for_student(grade: Grade) -> Grade:
    """The same grade without names and sentences that say what the mistake is, without what is told later only, and
    without what the grader's machine does not hold.
    """
    grade = grade if grade.tells_private else _without_private(grade)
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
            "sandbox": None,
        }
    )


def _without_private(grade: Grade) -> Grade:
    """The same without what its private scenes gave: their points count as lost so far, and how many is told.

    So what is shown says nothing of them, and is never full marks while some are open.
    """
    private = {it.name for it in grade.scenes if it.is_private}
    credits = {it.name: it.credit for it in grade.scenes}
    topics = []
    for topic in grade.clauses:
        shown = tuple(name for name in topic.scenes if name not in private)
        share = topic.maximum / len(topic.scenes)  # a topic gets the mean of its scenes
        points = share * sum(sorted(credits[name] for name in shown))
        hidden = share * (len(topic.scenes) - len(shown))
        topics.append(topic.model_copy(update={"scenes": shown, "points": points, "hidden": hidden}))
    before, after = (sum(it.points for it in clauses) for clauses in (grade.clauses, topics))
    left = after / before if before else 0.0
    mistakes = [it.model_copy(update={"charge": it.charge * left}) for it in grade.mistakes]
    return grade.model_copy(
        update={
            "clauses": tuple(topics),
            "mistakes": tuple(mistakes),
            "scenes": tuple(it for it in grade.scenes if not it.is_private),
            "score": after - sum(it.charge for it in mistakes),
            "hidden": sum(it.hidden for it in topics),
        }
    )
