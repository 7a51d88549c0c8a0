from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.court import witnesses
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CRT-4", "CMD-1", "CMD-3")


@pytest.fixture(autouse=True)
def forms_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Programs of others are asked by the tests of witnesses."""
    monkeypatch.setattr(witnesses, "WORKERS", {})


def test_one_document_holds_truth_and_answers(capsys: pytest.CaptureFixture[str]) -> None:
    results = document(capsys, "court", "flat-box")
    (case,) = results["cases"]
    assert results["schema_version"] == 1
    assert case["truth"]["hit"] is True
    assert case["answers"]["box: strict"]["outcome"] == "missed"
    assert case["answers"]["box: padded"]["outcome"] == "right"


def test_tables_are_printed_and_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    csv, summary = tmp_path / "court.csv", tmp_path / "court.md"
    status, out, _ = run(capsys, "court", "flat-box", "tiny-sphere", "--csv", str(csv), "--summary", str(summary))
    assert status == 0
    assert "flat-box\tbox\thit\tmissed: box: strict" in out
    assert csv.read_text(encoding="utf-8").startswith("case,shape,truth,witness")
    assert "| Case | Truth |" in summary.read_text(encoding="utf-8")


def test_an_unknown_case_is_refused_with_those_that_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    assert "flat-box" in refusal(capsys, "court", "round-box")
