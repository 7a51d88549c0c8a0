"""A class as tables: on a terminal, for a spreadsheet, and as Moodle and Canvas take grades from a teacher."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

from raytruth.reports.grade_text import points
from raytruth.reports.wording import printable

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from raytruth.comparisons.records.class_results import ClassResults, ClassRow

CLASS_CSV, MOODLE_CSV, CANVAS_CSV = "class.csv", "moodle.csv", "canvas.csv"
HEADERS = ("student", "points", "of", "what explains it")


def table_rows(results: ClassResults) -> list[tuple[str, str, str, str]]:
    """A row for each submission, as HEADERS has it."""
    return [(it.student, _score(it), points(it.maximum), what_explains(it)) for it in results.rows]


def what_explains(row: ClassRow) -> str:
    """The group of a submission, and why it is not graded."""
    return f"{row.group}: {row.reason}" if row.reason else row.group


def class_csv(results: ClassResults) -> str:
    """All that is known of each submission, with the points of each topic."""
    topics = list(results.topics)
    head = ["student", "identifier", "email", "status", "points", "of", *topics, "what explains it", "reason", "folder"]
    rows = [
        [it.student, it.identifier, it.email, it.status, _score(it), points(it.maximum)]
        + [points(it.topics[topic]) if topic in it.topics else "" for topic in topics]
        + [it.group, it.reason, it.folder]
        for it in results.rows
    ]
    return _csv([head, *rows])


def moodle_csv(results: ClassResults) -> str:
    """A grading worksheet of Moodle's assignment module, which takes Identifier, Grade and a date of the last change.

    Feedback tells the points of each topic and no solution. A submission that raytruth failed on has no grade.
    """
    head = ["Identifier", "Full name", "Email address", "Grade", "Maximum Grade", "Last modified (grade)"]
    rows = [
        [
            f"Participant {it.identifier}",
            it.student,
            it.email,
            _score(it),
            points(it.maximum),
            "-",
            _feedback(it, results),
        ]
        for it in results.rows
    ]
    return _csv([[*head, "Feedback comments"], *rows])


def canvas_csv(results: ClassResults) -> str:
    """A gradebook of Canvas: it knows students by ID, and asks whether the last column is a new assignment."""
    head = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", results.title]
    most = ["    Points Possible", "", "", "", "", points(results.maximum)]
    return _csv([head, most, *([it.student, it.identifier, "", it.email, "", _score(it)] for it in results.rows)])


def _score(row: ClassRow) -> str:
    return "" if row.score is None else points(row.score)


def _feedback(row: ClassRow, results: ClassResults) -> str:
    """What a student may be told in any case: the points of each topic, or why there are none."""
    if row.status != "graded":
        return "" if row.status == "grader_error" else row.reason
    told = (
        f"{title}: {points(row.topics.get(topic, 0.0))} of {points(most)}"
        for topic, (title, most) in results.topics.items()
    )
    return "; ".join(told)


def _csv(rows: Iterable[Sequence[str]]) -> str:
    file = io.StringIO()
    csv.writer(file, lineterminator="\n").writerows([_cell(text) for text in row] for row in rows)
    return file.getvalue()


def _cell(text: str) -> str:
    """On one line; a text that a spreadsheet would compute begins with an apostrophe, which it shows as text."""
    shown = printable(" ".join(text.splitlines())) if text.strip() else text
    return f"'{shown}" if shown.startswith(("=", "+", "-", "@")) and shown != "-" else shown
