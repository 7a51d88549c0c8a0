from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.raytruth.running import document, refusal, run
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


@pytest.mark.clause("REP-9")
def test_junit_xml_and_a_summary_are_written_beside_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    directory = write_sample(tmp_path / "results")
    junit, summary = tmp_path / "junit.xml", tmp_path / "summary.md"
    told = document(capsys, "report", str(directory), "--junit", str(junit), "--summary", str(summary))
    assert told == {"report": str(directory / "report.html"), "junit": str(junit), "summary": str(summary)}
    assert "<testcase" in junit.read_text(encoding="utf-8")
    assert summary.read_text(encoding="utf-8").startswith("## raytruth")


@pytest.mark.clause("REP-9", "VER-14")
def test_strict_makes_a_failure_of_what_is_as_declared(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    directory = write_sample(tmp_path / "results")
    junit = tmp_path / "junit.xml"
    counts = []
    for more in ([], ["--strict"]):
        assert run(capsys, "report", str(directory), "--junit", str(junit), *more)[0] == 0
        counts.append(junit.read_text(encoding="utf-8").count("<failure"))
    assert counts == [1, 2]


@pytest.mark.parametrize("option", ["--junit", "--summary"])
def test_a_file_that_cannot_be_written_is_refused_before_any_work(
    option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    directory = write_sample(tmp_path / "results")
    nowhere = tmp_path / "nowhere" / "file"
    assert f"{option}: expected a file in a folder that exists" in refusal(
        capsys, "report", str(directory), option, str(nowhere)
    )
    assert f"{option}: expected the name of a file" in refusal(capsys, "report", str(directory), option, str(tmp_path))
    assert not (directory / "report.html").exists()


@pytest.mark.clause("REP-12")
def test_a_report_tells_what_changed_since_other_results(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    directory, earlier = write_sample(tmp_path / "results"), write_sample(tmp_path / "earlier")
    assert run(capsys, "report", str(directory), "--against", str(earlier))[0] == 0
    assert "Nothing changed." in (directory / "report.html").read_text(encoding="utf-8")
    assert "no results directory" in refusal(capsys, "report", str(directory), "--against", str(tmp_path / "nothing"))


@pytest.mark.clause("REP-10")
def test_a_single_file_is_written_beside_it_with_a_warning_if_it_is_large(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    directory = write_sample(tmp_path / "results")
    told = document(capsys, "report", str(directory), "--single-file")
    single = directory / "report-single-file.html"
    assert told == {"report": str(directory / "report.html"), "single_file": str(single)}
    assert single.stat().st_size > 100_000
    monkeypatch.setattr("raytruth.written_report.LARGEST_ATTACHMENT", 100_000)
    status, out, err = run(capsys, "report", str(directory), "--single-file")
    assert status == 0
    assert f"In one file: {single}" in out
    assert "many mail services refuse it" in err


@pytest.mark.clause("REP-6")
def test_on_the_terminal_no_page_is_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    directory = write_sample(tmp_path / "results")
    status, out, _ = run(capsys, "report", str(directory), "--terminal")
    assert status == 0
    assert "fail         lambert-sphere closed_form/local" in out
    assert not (directory / "report.html").exists()
    (directory / "results.json").write_text("{")
    assert "not valid JSON" in refusal(capsys, "report", str(directory), "--terminal")
