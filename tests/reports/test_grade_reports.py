from __future__ import annotations

import json
from xml.etree import ElementTree as Xml

import pytest

from raytruth.comparisons.records.grade_results import Diagnosed, Grade, MistakeGrade, SceneGrade, TopicGrade
from raytruth.reports.grade_junit import grade_junit
from raytruth.reports.grade_pages import grade_page
from raytruth.reports.grade_text import grade_lines, points
from raytruth.reports.gradescope import MOST_CHARACTERS, gradescope_results

HOSTILE = "<script>alert(1)</script>\x1b[31m"
GRADE = Grade(
    raytruth_version="1",
    assignment="shadows",
    title=HOSTILE,
    submission="mine",
    stage="first-week",
    attempt=2,
    told="diagnosis",
    score=61.5,
    maximum=100.0,
    clauses=(
        TopicGrade(id="one", title="One", points=50.0, maximum=50.0, scenes=("right",)),
        TopicGrade(id="two", title="Two", points=16.5, maximum=50.0, scenes=("wrong", "broken")),
    ),
    mistakes=(MistakeGrade(name="mirrored", words="Turned.", hint="Which way?", charge=5.0),),
    scenes=(
        SceneGrade(name="broken", purpose="-", verdict="error", credit=0.0, reason=HOSTILE * 200),
        SceneGrade(name="right", purpose="-", verdict="right", credit=1.0, reason="all is right", seconds=0.25),
        SceneGrade(
            name="wrong", purpose="Why.", verdict="wrong", credit=0.4, reason="9 are wrong", region=(1, 2, 3, 4)
        ),
    ),
    diagnosis=(
        Diagnosed(
            fault="no_pi",
            clause="ILL-3",
            words="There is no π.",
            hint="What divides?",
            likelihood=0.75,
            explained=3,
            looked_at=4,
            contradicted=1,
            left_open=7,
            scenes=("wrong",),
            is_whole=False,
        ),
    ),
    unexplained="None of the known mistakes explains this.",
    seconds=1.5,
)
FAILED = GRADE.model_copy(
    update={
        "status": "grader_error",
        "scenes": (SceneGrade(name="wrong", purpose="-", verdict="grader_error", credit=0.0, reason="no room"),),
    }
)


@pytest.mark.clause("GRD-7")
def test_lines_tell_points_verdicts_and_proofs() -> None:
    lines = grade_lines(GRADE)
    assert lines[0].endswith("61.5 of 100 points.")
    assert lines[1:3] == ["  One: 50 of 50", "  Two: 16.5 of 50"]
    assert "  wrong wrong: 9 are wrong, in columns 1 to 2, rows 3 to 4." in lines
    proof = "  ILL-3: 3 of 4 wrong pixels (75 %) are what a tracer gives with the mistake no_pi: There is no π."
    assert f"{proof} But 1 right pixels speak against it. Of 7 more nothing can be proved. What divides?" in lines
    assert lines[-1].strip() == GRADE.unexplained
    assert [points(value) for value in (0.0, 12.0, 12.345, 0.1)] == ["0", "12", "12.35", "0.1"]


@pytest.mark.clause("GRD-7")
def test_gradescope_reads_score_and_a_test_for_each_topic_within_a_screen_each() -> None:
    document = json.loads(gradescope_results(GRADE))
    assert document["score"] == 61.5
    tests = {it["number"]: it for it in document["tests"]}
    assert (tests["one"]["score"], tests["one"]["max_score"], tests["one"]["status"]) == (50.0, 50.0, "passed")
    assert tests["two"]["status"] == "failed"
    assert all(len(it["output"]) <= MOST_CHARACTERS + 2 for it in document["tests"])
    assert "\x1b" not in gradescope_results(GRADE)
    assert "What divides?" in document["output"]


@pytest.mark.clause("GRD-5")
def test_what_raytruth_got_wrong_gives_gradescope_no_score_at_all_and_junit_no_failure() -> None:
    document = json.loads(gradescope_results(FAILED))
    assert "score" not in document
    assert "tests" not in document
    assert "no fault of the submission" in document["output"]
    assert Xml.fromstring(grade_junit(FAILED)).get("failures") == "0"
    assert "no grade" in grade_page(FAILED, for_teacher=False)


@pytest.mark.clause("GRD-7")
def test_junit_has_a_suite_for_each_topic_and_a_case_for_each_scene() -> None:
    root = Xml.fromstring(grade_junit(GRADE))
    assert {name: root.get(name) for name in ("tests", "failures", "errors", "skipped")} == {
        "tests": "3",
        "failures": "1",
        "errors": "1",
        "skipped": "0",
    }
    assert [suite.get("name") for suite in root] == ["One", "Two"]
    assert root[0][0].get("time") == "0.250"
    failure = root[1][0].find("failure")
    assert failure is not None
    assert failure.get("message") == "9 are wrong, in columns 1 to 2, rows 3 to 4."


@pytest.mark.clause("GRD-7", "REP-2")
@pytest.mark.parametrize("for_teacher", [False, True])
def test_no_text_of_a_submission_becomes_markup_and_pages_need_no_network(for_teacher: bool) -> None:
    page = grade_page(GRADE, for_teacher=for_teacher)
    assert "<script" not in page
    assert "\x1b" not in page
    assert "default-src 'none'" in page
    assert "http://" not in page
    assert "https://" not in page
    assert ("holds the solutions" in page) == for_teacher
