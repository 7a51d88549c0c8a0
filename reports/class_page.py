"""The page of a class, for the teacher: who has which points, what explains them, and who is alike."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from statistics import median
from typing import TYPE_CHECKING

from jinja2 import Environment, PackageLoader, StrictUndefined

from raytruth.comparisons.records.class_results import STUDENTS_FOLDER
from raytruth.reports import wording
from raytruth.reports.class_tables import what_explains
from raytruth.reports.grade_pages import STUDENT_PAGE, TEACHER_PAGE
from raytruth.reports.grade_text import points

if TYPE_CHECKING:
    from raytruth.comparisons.records.class_results import ClassResults, ClassRow

CLASS_PAGE = "class.html"
# Tenths of the points, as in marks.
_BINS = 10


@dataclass(frozen=True)
class TopicSpread:
    """How the points of a topic are spread over the graded submissions."""

    title: str
    maximum: float
    mean: float
    middle: float
    bins: tuple[int, ...]
    """How many have up to a tenth, two tenths, … of its points; those with all are in the last."""


def topic_spreads(results: ClassResults) -> list[TopicSpread]:
    """Of the whole first, then of each topic; none where nothing is graded."""
    graded = [it for it in results.rows if it.status == "graded" and it.score is not None]
    if not graded:
        return []
    whole = _spread("All topics", results.maximum, [it.score or 0.0 for it in graded])
    return [whole] + [
        _spread(title, most, [it.topics.get(topic, 0.0) for it in graded])
        for topic, (title, most) in results.topics.items()
    ]


def groups(results: ClassResults) -> list[tuple[str, list[ClassRow]]]:
    """The submissions by what explains them, the largest group first."""
    sizes = Counter(it.group for it in results.rows)
    return [
        (group, [it for it in results.rows if it.group == group])
        for group, _ in sorted(sizes.items(), key=lambda item: (-item[1], item[0]))
    ]


def class_headline(results: ClassResults) -> str:
    """How many are graded, and how well."""
    scores = [it.score for it in results.rows if it.status == "graded" and it.score is not None]
    failed = sum(it.status == "grader_error" for it in results.rows)
    others = len(results.rows) - len(scores) - failed
    told = f"{len(scores)} of {len(results.rows)} {wording.plural('submission', len(results.rows))} graded"
    told += (
        f", half of them with {points(median(scores))} of {points(results.maximum)} points or more" if scores else ""
    )
    told += f"; {others} could not be run" if others else ""
    return f"{told}; raytruth itself failed on {failed}." if failed else f"{told}."


def class_page(results: ClassResults) -> str:
    """The page, which names faults and is for the teacher alone."""
    loader = PackageLoader("raytruth.reports")
    environment = Environment(
        loader=loader,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=lambda value: wording.printable(value) if type(value) is str else value,
    )
    environment.filters["points"] = points
    environment.filters["explained"] = what_explains
    spreads = topic_spreads(results)
    return environment.get_template("class.html.jinja").render(
        results=results,
        headline=class_headline(results),
        spreads=spreads,
        tallest=max((max(it.bins) for it in spreads), default=1),
        groups=groups(results),
        names={it.folder: it.student for it in results.rows},
        students=STUDENTS_FOLDER,
        student_page=STUDENT_PAGE,
        teacher_page=TEACHER_PAGE,
        style=loader.get_source(environment, "report.css")[0],
    )


def _spread(title: str, most: float, values: list[float]) -> TopicSpread:
    places = Counter(min(_BINS - 1, int(_BINS * value / most)) if most else _BINS - 1 for value in values)
    bins = tuple(places[place] for place in range(_BINS))
    return TopicSpread(title, most, sum(values) / len(values), median(values), bins)
