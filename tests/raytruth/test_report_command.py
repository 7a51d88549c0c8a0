from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.raytruth.running import document, refusal
from tests.reports.sample_results import write_sample

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-2", "CMD-4")


def test_the_report_is_rebuilt_from_the_directory(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    directory = write_sample(tmp_path / "results")
    told = document(capsys, "report", str(directory))
    assert told == {"report": str(directory / "report.html")}
    assert "<html" in (directory / "report.html").read_text(encoding="utf-8")


def test_a_missing_directory_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "no results directory" in refusal(capsys, "report", str(tmp_path / "nothing"))


def test_broken_results_are_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "results.json").write_text("{")
    assert "not valid JSON" in refusal(capsys, "report", str(tmp_path))
