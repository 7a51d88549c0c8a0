from __future__ import annotations

import csv
import json
from typing import Any

import pytest

from raytruth.comparisons.records.class_results import ClassResults, ClassRow, Likeness, Move
from raytruth.reports.class_page import class_headline, class_page, groups, topic_spreads
from raytruth.reports.class_tables import canvas_csv, class_csv, moodle_csv, table_rows
from raytruth.reports.service_results import service_results
from tests.reports.test_grade_reports import FAILED, GRADE, HOSTILE

pytestmark = pytest.mark.clause("CLA-5", "CLA-6")


def row(student: str, score: float | None, group: str, **more: Any) -> ClassRow:
    own: dict[str, Any] = {
        "folder": student,
        "student": student,
        "identifier": "7",
        "status": "graded" if score is not None else "grader_error",
        "score": score,
        "maximum": 100.0,
        "topics": {"one": score / 2} if score is not None else {},
        "group": group,
    }
    return ClassRow(**(own | more))


RESULTS = ClassResults(
    raytruth_version="1",
    assignment="whitted",
    title=HOSTILE,
    maximum=100.0,
    topics={"one": ("Shadows", 50.0)},
    rows=(
        row("ada", 100.0, "all right"),
        row("ben", 40.0, "no_pi", move=Move(before=20.0, after=40.0, why=("A scene was wrong and is right.",))),
        row("cleo", 41.0, "no_pi"),
        row(HOSTILE, None, "raytruth itself failed", reason="=1+1\nno room"),
        row("eve", 0.0, "refused", status="refused", topics={}, reason="A link."),
    ),
    likenesses=(Likeness(first="ben", second="cleo", alike=30, looked_at=40),),
)


def test_submissions_are_grouped_by_mistake_and_topics_are_spread_over_tenths() -> None:
    assert next((group, [it.student for it in own]) for group, own in groups(RESULTS)) == ("no_pi", ["ben", "cleo"])
    whole, shadows = topic_spreads(RESULTS)
    assert whole.bins == (0, 0, 0, 0, 2, 0, 0, 0, 0, 1)
    assert (shadows.title, shadows.middle, sum(shadows.bins)) == ("Shadows", 20.5, 3)
    assert class_headline(RESULTS) == (
        "3 of 5 submissions graded, half of them with 41 of 100 points or more; 1 could not be run; "
        "raytruth itself failed on 1."
    )


def test_the_page_escapes_everything_and_tells_who_moved_and_who_is_alike() -> None:
    page = class_page(RESULTS)
    assert "<script>alert" not in page
    assert "\x1b" not in page
    assert "Moved from 20 to 40. A scene was wrong and is right." in page
    assert '<th scope="row">ben</th><td>cleo</td><td>30</td><td>40</td>' in page
    assert 'href="students/ben/teacher.html"' in page
    assert 'href="students/eve/' in page


def test_a_class_without_submissions_that_could_be_graded_has_a_page_too() -> None:
    empty = RESULTS.model_copy(update={"rows": RESULTS.rows[3:], "likenesses": ()})
    assert topic_spreads(empty) == []
    assert "Points of each topic" not in class_page(empty)


def test_tables_hold_a_row_for_each_and_nothing_that_a_spreadsheet_computes() -> None:
    rows = list(csv.DictReader(class_csv(RESULTS).splitlines()))
    assert [it["points"] for it in rows] == ["100", "40", "41", "", "0"]
    assert [it["one"] for it in rows] == ["50", "20", "20.5", "", ""]
    assert rows[3]["reason"] == "'=1+1 no room"
    assert "\x1b" not in class_csv(RESULTS)
    assert table_rows(RESULTS)[4] == ("eve", "0", "100", "refused: A link.")


def test_moodle_finds_its_three_columns_and_students_no_solution() -> None:
    rows = list(csv.DictReader(moodle_csv(RESULTS).splitlines()))
    assert {"Identifier", "Grade", "Last modified (grade)"} <= rows[0].keys()
    assert [(it["Identifier"], it["Grade"]) for it in rows][1:4] == [
        ("Participant 7", "40"),
        ("Participant 7", "41"),
        ("Participant 7", ""),
    ]
    assert rows[1]["Feedback comments"] == "Shadows: 20 of 50"
    assert "no_pi" not in moodle_csv(RESULTS)


def test_canvas_finds_students_by_id_and_the_points_possible() -> None:
    head, possible, first, *_ = csv.reader(canvas_csv(RESULTS).splitlines())
    assert head[:5] == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]
    assert (possible[0], possible[5]) == ("    Points Possible", "100")
    assert (first[1], first[5]) == ("7", "100")


@pytest.mark.clause("CLA-7")
def test_a_service_gets_a_share_or_the_points_and_no_score_where_raytruth_failed() -> None:
    prairielearn = json.loads(service_results("prairielearn", GRADE))
    assert (prairielearn["gradable"], prairielearn["score"]) == (True, 0.615)
    assert [it["max_points"] for it in prairielearn["tests"]] == [50.0, 50.0]
    assert json.loads(service_results("prairielearn", FAILED)) == {
        "gradable": False,
        "message": "raytruth itself failed on wrong: this is no grade, and no fault of the submission.",
    }
    classroom = json.loads(service_results("github-classroom", GRADE))
    assert (classroom["status"], classroom["max_score"], classroom["tests"][0]["score"]) == ("fail", 100.0, 61.5)
    assert json.loads(service_results("github-classroom", FAILED))["status"] == "error"
    assert json.loads(service_results("gradescope", GRADE))["score"] == 61.5
