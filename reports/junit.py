"""The verdicts of a results directory as JUnit XML, which continuous integration shows as tests: one a cell.

The elements are those that GitLab, Jenkins and GitHub's actions read: `testsuites`, in it a `testsuite` for each
renderer and integrator, in it a `testcase` for each scene.
"""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree as Xml

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.loading import ReportError, read_log
from raytruth.reports.wording import WAIVED, columns, evidence, outcome, printable

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from raytruth.comparisons.records.results import Cell, Results

_ELEMENTS = {
    Verdict.FAIL: "failure",
    Verdict.ERROR: "error",
    WAIVED: "skipped",  # JUnit has no word for a failure that is expected; pytest writes it so, too
    Verdict.INCOMPARABLE: "skipped",
    Verdict.UNAVAILABLE: "skipped",
}
"""What a testcase holds that is no pass, by its outcome."""
_COUNTS = {"failure": "failures", "error": "errors", "skipped": "skipped"}


def junit_xml(directory: Path, results: Results, *, strict: bool = False) -> bytes:
    """The document, in UTF-8; where `strict`, what is as declared, not as due, is a failure, too."""
    root = Xml.Element("testsuites", name="raytruth")
    for renderer, integrator in columns(results):
        of_column = [cell for cell in results.cells if (cell.renderer, cell.integrator) == (renderer, integrator)]
        suite = Xml.SubElement(root, "testsuite", name=printable(f"{renderer}/{integrator}"))
        for cell in of_column:
            suite.append(_testcase(directory, cell, strict=strict))
        _count(suite, of_column)
        if results.created:
            suite.set("timestamp", printable(results.created))
    _count(root, results.cells)
    Xml.indent(root)
    document: bytes = Xml.tostring(root, encoding="utf-8", xml_declaration=True)
    return document + b"\n"


def _testcase(directory: Path, cell: Cell, *, strict: bool) -> Xml.Element:
    """A cell: its name is the scene, its class is the renderer with the integrator."""
    classname = f"{cell.renderer}.{cell.integrator}"
    case = Xml.Element("testcase", classname=printable(classname), name=printable(cell.scene), time=_time([cell]))
    known = outcome(cell)
    as_failure = strict and known == Verdict.DECLARED
    element = "failure" if as_failure else _ELEMENTS.get(known)
    reason = cell.reason if cell.waived is None else f"{cell.reason}; waived: {cell.waived.reason} {cell.waived.link}"
    if element is not None:
        told = Xml.SubElement(case, element, type=known, message=printable(reason))
        told.text = printable("\n".join([reason, *evidence(cell), cell.command]))
    elif known == Verdict.DECLARED:
        Xml.SubElement(case, "system-out").text = printable(f"declared: {reason}")
    if cell.verdict in {Verdict.FAIL, Verdict.ERROR} and cell.log is not None:
        Xml.SubElement(case, "system-err").text = printable(_log(directory, cell.log))
    return case


def _log(directory: Path, relative: str) -> str:
    """Its last lines, or why there are none."""
    try:
        return read_log(directory, relative)
    except ReportError as error:
        return str(error)


def _count(element: Xml.Element, cells: Iterable[Cell]) -> None:
    """State how many cases an element holds of each kind, and how long they took."""
    cases = list(element.iter("testcase"))
    element.set("tests", str(len(cases)))
    for kind, name in _COUNTS.items():
        element.set(name, str(sum(case.find(kind) is not None for case in cases)))
    element.set("time", _time(cells))


def _time(cells: Iterable[Cell]) -> str:
    """Seconds of the renderers alone, to the millisecond."""
    return f"{sum(cell.seconds or 0.0 for cell in cells):.3f}"
