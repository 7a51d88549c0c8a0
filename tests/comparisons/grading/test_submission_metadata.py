from __future__ import annotations

import json
import re
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.grading.submission_metadata import MetadataError, parsed_date, read_submission_metadata
from raytruth.reports.gradescope import gradescope_results
from tests.reports.test_grade_reports import FAILED, GRADE

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.grading.submission_metadata import SubmissionMetadata

pytestmark = pytest.mark.clause("GRD-5")

DUE = "2018-07-31T23:00:00.000000-07:00"


def read(folder: Path, data: Any) -> SubmissionMetadata:
    path = folder / "submission_metadata.json"
    path.write_text(data if isinstance(data, str) else json.dumps(data))
    return read_submission_metadata(path)


def test_an_attempt_that_raytruth_could_not_grade_is_not_lost(tmp_path: Path) -> None:
    graded, failed = (json.loads(gradescope_results(grade)) for grade in (GRADE, FAILED))
    earlier = [{"score": 61.5, "results": graded}, {"score": None, "results": failed}, {"score": 0.0, "results": None}]
    assert read(tmp_path, {"id": 7, "previous_submissions": earlier}).attempt == 2
    assert read(tmp_path, {"id": 7}).attempt == 1


def test_a_submission_has_a_seed_of_its_own_which_is_the_same_again(tmp_path: Path) -> None:
    first, again, other = (read(tmp_path, {"id": number}).seed for number in (7, 7, 8))
    assert first == again != other


def test_the_last_date_at_which_a_student_may_hand_in_counts(tmp_path: Path) -> None:
    assert read(tmp_path, {"id": 7, "assignment": {"due_date": DUE, "late_due_date": None}}).due == datetime(
        2018, 8, 1, 6, tzinfo=UTC
    )
    late = {"due_date": DUE, "late_due_date": DUE.replace("07-31", "08-02")}
    assert read(tmp_path, {"id": 7, "assignment": late}).due == datetime(2018, 8, 3, 6, tzinfo=UTC)


@pytest.mark.clause("CMD-2")
@pytest.mark.parametrize(
    ("data", "told"),
    [
        ("{", "expected valid JSON"),
        ("[" * 100_000, "expected valid JSON"),
        ([], "id: expected the number of a submission"),
        ({"id": 7, "previous_submissions": 3}, "previous_submissions: expected a list"),
        ({"id": 7, "assignment": {"due_date": "soon"}}, "assignment.due_date: expected a date"),
    ],
)
def test_another_file_is_refused_in_a_sentence(tmp_path: Path, data: Any, told: str) -> None:
    with pytest.raises(MetadataError, match=re.escape(told)):
        read(tmp_path, data)
    with pytest.raises(MetadataError, match=r"expected Gradescope.s submission_metadata\.json"):
        read_submission_metadata(tmp_path / "none.json")


@pytest.mark.clause("CMD-2")
@pytest.mark.parametrize("text", ["yesterday", "2026-12-01", "2026-12-01T10:00:00"])
def test_a_date_without_an_offset_is_refused(text: str) -> None:
    with pytest.raises(MetadataError, match=rf"--date: expected a date with time and offset from UTC.*'{text}'"):
        parsed_date(text, "--date")
