"""A grade as JUnit XML: a suite for each topic, a testcase for each scene."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree as Xml

from raytruth.reports.grade_text import scene_sentence
from raytruth.reports.wording import printable

if TYPE_CHECKING:
    from raytruth.comparisons.records.grade_results import Grade

_ELEMENTS = {"wrong": "failure", "error": "error", "grader_error": "skipped"}
"""What a testcase holds that is not right; what raytruth itself could not grade is no failure."""
_COUNTS = {"failure": "failures", "error": "errors", "skipped": "skipped"}


def grade_junit(grade: Grade) -> bytes:
    """The document, in UTF-8, from what the student may be told."""
    root = Xml.Element("testsuites", name="raytruth grade")
    scenes = {it.name: it for it in grade.scenes}
    for topic in grade.clauses:
        suite = Xml.SubElement(root, "testsuite", name=printable(topic.title))
        for name in topic.scenes:
            scene = scenes.get(name)
            seconds = f"{scene.seconds or 0.0:.3f}" if scene else "0.000"
            case = Xml.SubElement(suite, "testcase", classname=printable(topic.id), name=printable(name), time=seconds)
            if scene is not None and scene.verdict in _ELEMENTS:
                told = printable(scene_sentence(scene))
                Xml.SubElement(case, _ELEMENTS[scene.verdict], type=scene.verdict, message=told)
        _count(suite)
    _count(root)
    Xml.indent(root)
    document: bytes = Xml.tostring(root, encoding="utf-8", xml_declaration=True)
    return document + b"\n"


def _count(element: Xml.Element) -> None:
    """State how many cases an element holds of each kind."""
    cases = list(element.iter("testcase"))
    element.set("tests", str(len(cases)))
    for kind, name in _COUNTS.items():
        element.set(name, str(sum(case.find(kind) is not None for case in cases)))
