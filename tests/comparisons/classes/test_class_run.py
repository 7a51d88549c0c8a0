from __future__ import annotations

import shutil
from concurrent.futures import Executor, Future
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.classes.class_files import folder_names, kept_grade, kept_pictures, kept_row
from raytruth.comparisons.classes.class_run import class_rows, plan_of
from raytruth.comparisons.classes.exports import Submission, submissions_in
from raytruth.comparisons.classes.one_submission import Confined, Job, Outcome
from raytruth.comparisons.grading.grade import Occasion
from raytruth.comparisons.records.grade_results import Grade, TopicGrade
from raytruth.reference_tracer.storage.whole_files import write_whole
from tests.comparisons.classes.small_class import written_submission
from tests.comparisons.grading.small_scenes import ASSIGNMENT, small_scene

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.classes.class_run import ClassPlan
    from raytruth.comparisons.records.class_results import ClassRow

pytestmark = pytest.mark.clause("CLA-2", "CLA-3")


def grade(score: float, status: str = "graded") -> Grade:
    return Grade(
        raytruth_version="1",
        assignment="small",
        title="Small",
        submission="-",
        stage=None,
        attempt=1,
        told="diagnosis",
        status=status,
        score=score,
        maximum=100.0,
        clauses=(TopicGrade(id="all", title="All", points=score, maximum=100.0, scenes=()),),
        mistakes=(),
        scenes=(),
        diagnosis=(),
        seconds=0.0,
    )


class Grader(Executor):
    """Gives each student the outcome that is foreseen, or fails; and notes whom it was asked for."""

    def __init__(self, **outcomes: Outcome | Exception | float) -> None:
        self.outcomes, self.asked = outcomes, list[str]()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:  # noqa: ARG002 - an executor's signature
        """The outcome, already there."""
        (_, job) = args
        assert isinstance(job, Job)
        self.asked.append(job.submission.student)
        told = self.outcomes.get(job.submission.student, 100.0)
        future: Future[Any] = Future()
        if isinstance(told, Exception):
            future.set_exception(told)
        elif isinstance(told, Outcome):
            future.set_result(told)
        else:
            future.set_result(Outcome("graded", "", grade(told), {"scene": np.zeros((1, 1, 3), np.float32)}))
        return future


@pytest.fixture
def handed_in(tmp_path: Path) -> Path:
    for name in ("ada", "ben", "cleo"):
        written_submission(tmp_path / "class" / name)
    return tmp_path / "class"


def planned(folder: Path, *, regrade: bool = False, fresh: bool = False) -> ClassPlan:
    topics = {"all": (small_scene(),)}
    out = folder.parent / "out"
    return plan_of(
        submissions_in(folder), out, ASSIGNMENT, topics, Occasion(), Confined(), regrade=regrade, fresh=fresh
    )


def graded(plan: ClassPlan, grader: Grader) -> dict[str, ClassRow]:
    def write(folder: str, told: Grade) -> None:
        write_whole(plan.out / "students" / folder / "grade.json", told.model_dump_json())

    return {row.student: row for row in class_rows(plan, grader, 2, write)}


def test_whatever_one_submission_does_the_others_are_graded_and_its_row_tells_it(handed_in: Path) -> None:
    failing = Outcome("grader_error", "", grade(40.0, "grader_error"))
    rows = graded(planned(handed_in), Grader(ada=RuntimeError("its process ended"), ben=failing, cleo=62.5))
    assert [(rows[name].status, rows[name].score) for name in ("ada", "ben", "cleo")] == [
        ("grader_error", None),
        ("grader_error", None),
        ("graded", 62.5),
    ]
    assert "its process ended" in rows["ada"].reason
    assert rows["cleo"].topics == {"all": 62.5}
    assert list(kept_pictures(handed_in.parent / "out", "cleo")) == ["scene"]


@pytest.mark.parametrize("status", ["refused", "no_program", "build_failed"])
def test_what_cannot_be_run_has_no_points_and_its_student_reads_why(status: Any, handed_in: Path) -> None:
    rows = graded(planned(handed_in), Grader(ada=Outcome(status, "There is a link.")))
    assert (rows["ada"].status, rows["ada"].score, rows["ada"].reason) == (status, 0.0, "There is a link.")
    told = kept_grade(handed_in.parent / "out", "ada")
    assert told is not None
    assert told.unexplained == "There is a link."


def test_an_interrupted_class_goes_on_where_it_was_and_failures_are_tried_again(handed_in: Path) -> None:
    plan = planned(handed_in)
    rows = class_rows(plan, Grader(ada=RuntimeError("-")), 1, lambda *_: None)
    next(rows)
    next(rows)
    rows.close()
    again = planned(handed_in)
    assert again.left == ["ada", "cleo"]
    assert list(again.kept) == ["ben"]
    grader = Grader()
    graded(again, grader)
    assert grader.asked == ["ada", "cleo"]
    assert planned(handed_in).left == []


def test_a_submission_is_graded_again_where_a_file_of_it_has_changed_and_all_are_where_that_is_asked_for(
    handed_in: Path,
) -> None:
    graded(planned(handed_in), Grader())
    (handed_in / "ben" / "more.py").write_text("")
    assert planned(handed_in).left == ["ben"]
    assert planned(handed_in, fresh=True).left == ["ada", "ben", "cleo"]


def test_another_state_of_raytruth_leaves_grades_until_one_asks_and_then_tells_which_move(
    handed_in: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    graded(planned(handed_in), Grader(ada=50.0))
    monkeypatch.setattr("raytruth.comparisons.classes.class_run.code_digest", lambda: "another")
    assert (planned(handed_in).left, planned(handed_in).by_other_code) == ([], 3)
    plan = planned(handed_in, regrade=True)
    assert plan.left == ["ada", "ben", "cleo"]
    better = grade(75.0).model_copy(update={"raytruth_version": "2"})
    rows = graded(plan, Grader(ada=Outcome("graded", "", better, {})))
    assert rows["ben"].move is None
    assert rows["ada"].move is not None
    assert (rows["ada"].move.before, rows["ada"].move.after) == (50.0, 75.0)
    assert rows["ada"].move.why == ("raytruth 1 is 2 now.",)
    assert planned(handed_in, regrade=True).left == []


def test_a_failure_of_raytruth_leaves_the_earlier_grade(handed_in: Path) -> None:
    graded(planned(handed_in), Grader(ada=50.0))
    rows = graded(planned(handed_in, fresh=True), Grader(ada=RuntimeError("no room")))
    assert (rows["ada"].status, rows["ada"].score) == ("graded", 50.0)
    assert "no room" in rows["ada"].reason
    kept = kept_row(handed_in.parent / "out", "ada")
    assert kept is not None
    assert kept.row.score == 50.0


def test_a_row_that_is_damaged_is_made_again(handed_in: Path) -> None:
    graded(planned(handed_in), Grader())
    for content, name in ((b"{", "ada"), (b"\xff", "ben")):
        (handed_in.parent / "out" / "students" / name / "row.json").write_bytes(content)
    shutil.rmtree(handed_in.parent / "out" / "students" / "cleo")
    assert planned(handed_in).left == ["ada", "ben", "cleo"]


def test_folders_are_named_plainly_and_no_two_alike_whatever_students_are_called() -> None:
    students = ["ada", "Ada", "../../etc", "", "x" * 1_000_000, "\x1b[31m", "Zoë", "ada", "-", ".", "\udcff"]
    names = folder_names([Submission(name, (), str(place)) for place, name in enumerate(students)])
    assert len({name.lower() for name in names}) == len(names)
    assert all(
        0 < len(name) <= 80 and "/" not in name and not name.startswith(".") and name.isascii() for name in names
    )
    assert names[0] == "ada"
