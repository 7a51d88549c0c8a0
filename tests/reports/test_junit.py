from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING
from xml.etree import ElementTree as Xml

import pytest

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.junit import junit_xml
from raytruth.reports.loading import load_results
from raytruth.reports.wording import WAIVED, outcome
from tests.reports.sample_results import FAILING_PIXEL, HOSTILE, write_sample

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.results import Results

pytestmark = pytest.mark.clause("REP-9")

KINDS = {
    Verdict.FAIL: "failure",
    Verdict.ERROR: "error",
    WAIVED: "skipped",
    Verdict.INCOMPARABLE: "skipped",
    Verdict.UNAVAILABLE: "skipped",
}


@pytest.fixture(scope="module")
def directory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_sample(tmp_path_factory.mktemp("results"))


@pytest.fixture(scope="module")
def results(directory: Path) -> Results:
    return load_results(directory)


def cases(directory: Path, results: Results, *, strict: bool = False) -> dict[tuple[str, str], Xml.Element]:
    """Each testcase by its class and its name."""
    root = Xml.fromstring(junit_xml(directory, results, strict=strict))
    found = list(root.iter("testcase"))
    by_place = {(case.get("classname", ""), case.get("name", "")): case for case in found}
    assert len(by_place) == len(found)
    return by_place


def kind(case: Xml.Element) -> str | None:
    return next((name for name in ("failure", "error", "skipped") if case.find(name) is not None), None)


def test_each_cell_is_one_testcase_that_ends_as_its_verdict_says(directory: Path, results: Results) -> None:
    found = cases(directory, results)
    assert len(found) == len(results.cells)
    for cell in results.cells:
        case = found[f"{cell.renderer}.{cell.integrator}", cell.scene]
        assert kind(case) == KINDS.get(outcome(cell))
        if kind(case):
            told = case.find(str(kind(case)))
            assert told is not None
            assert told.get("type") == outcome(cell)
            assert cell.reason in told.get("message", "")


def test_the_counts_of_each_element_are_those_of_its_testcases(directory: Path, results: Results) -> None:
    root = Xml.fromstring(junit_xml(directory, results))
    for element in (root, *root.iter("testsuite")):
        inside = list(element.iter("testcase"))
        kinds = Counter(map(kind, inside))
        assert int(element.get("tests", "")) == len(inside)
        assert int(element.get("failures", "")) == kinds["failure"]
        assert int(element.get("errors", "")) == kinds["error"]
        assert int(element.get("skipped", "")) == kinds["skipped"]
        seconds = sum(float(case.get("time", "")) for case in inside)
        assert float(element.get("time", "")) == pytest.approx(seconds, abs=1e-3 * len(inside))


def test_a_failure_tells_its_worst_pixel_and_an_error_the_end_of_its_log(directory: Path, results: Results) -> None:
    found = cases(directory, results)
    x, y = FAILING_PIXEL
    failure = found["closed_form.local", "lambert-sphere"].find("failure")
    assert failure is not None
    assert f"Worst pixel ({x}, {y})" in str(failure.text)
    log = found["mitsuba.path", "whitted-1980"].findtext("system-err")
    assert str(log).endswith("last line")


def test_a_waived_failure_is_skipped_with_the_waivers_reason(directory: Path, results: Results) -> None:
    skipped = cases(directory, results)["closed_form.local", "whitted-1980"].find("skipped")
    assert skipped is not None
    assert "waived: It takes <b>air</b> for glass." in skipped.get("message", "")


@pytest.mark.clause("VER-14")
def test_what_is_as_declared_passes_with_a_note_and_fails_where_strict(directory: Path, results: Results) -> None:
    place = ("povray.trace", "whitted-1980")
    assert "as declared, not as due" in str(cases(directory, results)[place].findtext("system-out"))
    strict = cases(directory, results, strict=True)
    assert kind(strict[place]) == "failure"
    others = {name: kind(case) for name, case in strict.items() if name != place}
    assert others == {name: kind(case) for name, case in cases(directory, results).items() if name != place}


@pytest.mark.clause("REP-2")
def test_any_text_gives_a_document_that_reads_back_without_control_characters(
    directory: Path, results: Results
) -> None:
    hostile = f"{HOSTILE}]]>\x00\x1b[31m\ud800￾&#0;"
    cell = next(cell for cell in results.cells if cell.verdict == Verdict.FAIL)
    told = cell.model_copy(update={"reason": hostile, "scene": hostile, "log": f"nowhere/{hostile}"})
    case = cases(directory, results.model_copy(update={"cells": (told,)}))
    ((_, name), element), *_ = case.items()
    shown = f"{HOSTILE}]]>��[31m��&#0;"
    assert name == shown
    failure = element.find("failure")
    assert failure is not None
    assert failure.get("message") == shown
    assert not list(failure)


@pytest.mark.clause("REP-1")
def test_a_log_that_is_missing_is_told_in_its_place(directory: Path, results: Results) -> None:
    crashed = next(cell for cell in results.cells if cell.verdict == Verdict.ERROR)
    lost = crashed.model_copy(update={"log": "cells/nowhere/log.txt"})
    ((_, case),) = cases(directory, results.model_copy(update={"cells": (lost,)})).items()
    assert "cells/nowhere/log.txt cannot be read" in str(case.findtext("system-err"))
