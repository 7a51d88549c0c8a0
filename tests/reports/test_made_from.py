from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from raytruth.reports.html import REPORT_FILE, write_html_report
from raytruth.reports.made_from import is_made_from, made_from
from tests.reports.sample_results import write_sample

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REP-8")


@pytest.fixture
def directory(tmp_path: Path) -> Path:
    return write_sample(tmp_path / "results")


def test_a_report_is_left_as_it_is_until_its_results_change(directory: Path) -> None:
    page = write_html_report(directory, unless_current=True)
    first = page.stat().st_mtime_ns
    write_html_report(directory, unless_current=True)
    assert page.stat().st_mtime_ns == first
    write_html_report(directory)
    second = page.stat().st_mtime_ns
    assert second > first
    log = next(directory.rglob("log.txt"))
    os.utime(log, ns=(1, 1))
    write_html_report(directory, unless_current=True)
    assert page.stat().st_mtime_ns > second


def test_other_results_or_files_have_another_digest(directory: Path) -> None:
    digests = [made_from(directory)]
    results = directory / "results.json"
    results.write_text(results.read_text(encoding="utf-8").replace("2 cores", "4 cores"), encoding="utf-8")
    digests.append(made_from(directory))
    next(directory.rglob("render.exr")).unlink()
    digests.append(made_from(directory))
    assert len(set(digests)) == len(digests)
    assert made_from(directory) == digests[-1]


def test_a_report_that_is_missing_or_of_another_origin_is_not_current(directory: Path) -> None:
    assert not is_made_from(directory / REPORT_FILE, made_from(directory))
    page = write_html_report(directory)
    assert is_made_from(page, made_from(directory))
    assert not is_made_from(page, "another")


def test_what_a_run_is_writing_or_replacing_meanwhile_does_not_count(
    directory: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A run shows its report while other cells are judged: files there come and go between listing and reading."""
    digest = made_from(directory)
    unfinished = directory / "cells" / "scene" / ".unfinished-renderer"
    unfinished.mkdir(parents=True)
    (unfinished / "picture.png").write_bytes(b"half a pict")
    assert made_from(directory) == digest
    gone = next(directory.rglob("log.txt"))
    status = type(gone).stat

    def vanishes(path: Path, **options: bool) -> os.stat_result:
        if path == gone:
            path.unlink(missing_ok=True)
        return status(path, **options)

    monkeypatch.setattr(type(gone), "stat", vanishes)
    assert made_from(directory) != digest
