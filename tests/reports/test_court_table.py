from __future__ import annotations

import csv
import io

import pytest

from raytruth.comparisons.court.cases import all_cases
from raytruth.comparisons.court.hearing import judged
from raytruth.comparisons.court.questions import MISSED, Answer
from raytruth.comparisons.court.witnesses import Statement
from raytruth.reports.court_table import case_rows, count_rows, csv_text, markdown

pytestmark = pytest.mark.clause("CRT-4")

CASES = {
    name: all_cases()[name] for name in ("beside-a-box-in-parallel", "edge-of-two-triangles", "tangent-of-a-sphere")
}
RESULTS = judged(
    CASES,
    [
        Statement("good", "1", (MISSED, Answer(hit=True, distance=1.0, primitive=0), None)),
        Statement("bad|one", "2", (Answer(hit=True), MISSED, Answer(hit=True, distance=3.0))),
        Statement("worse", "3", (Answer(hit=True), None, None)),
        Statement("broken", None, (None, None, None), "it fell"),
    ],
)


def test_each_witness_is_counted_and_an_error_told() -> None:
    assert count_rows(RESULTS) == [
        ("good", "1", "2", "2", "0", "0", "0"),
        ("bad|one", "2", "3", "1", "1", "1", "0"),
        ("worse", "3", "1", "0", "0", "1", "0"),
        ("broken", "", "error: it fell", "", "", "", ""),
    ]


def test_each_case_names_who_is_wrong() -> None:
    assert case_rows(RESULTS) == [
        ("beside-a-box-in-parallel", "box", "miss", "false hit: bad|one + worse"),
        ("edge-of-two-triangles", "triangles", "hit", "missed: bad|one"),
        ("tangent-of-a-sphere", "sphere", "touch", ""),
    ]


def test_the_spreadsheet_has_a_line_for_each_answer() -> None:
    rows = list(csv.DictReader(io.StringIO(csv_text(RESULTS))))
    assert [(row["case"], row["witness"], row["outcome"]) for row in rows if row["outcome"] != "error"] == [
        ("beside-a-box-in-parallel", "good", "right"),
        ("beside-a-box-in-parallel", "bad|one", "false hit"),
        ("beside-a-box-in-parallel", "worse", "false hit"),
        ("edge-of-two-triangles", "good", "right"),
        ("edge-of-two-triangles", "bad|one", "missed"),
        ("tangent-of-a-sphere", "bad|one", "right"),
    ]
    assert rows[-2]["distance"] == "3.0"


def test_no_name_breaks_a_table_in_markdown() -> None:
    lines = [line for line in markdown(RESULTS).splitlines() if line]
    assert len({line.count("|") for line in lines[:5]}) == 1
    assert "[Through the diagonal of a square](https://github.com/mikedh/trimesh/issues/1766)" in markdown(RESULTS)
