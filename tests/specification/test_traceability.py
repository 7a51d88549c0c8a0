from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.specification.traceability import TABLE, table_text, traceability

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("PRJ-6")

FILES = {
    "docs/spec.md": "- **A-1** One.\n- **A-2** Two.\n",
    "docs/promises.md": "- **P-1** Three.\n",
    "tests/test_a.py": '@pytest.mark.clause("A-1", "A-2")\ndef test_both(): ...\n',
    "tests/test_p.py": 'pytestmark = pytest.mark.clause("P-1")\n\ndef test_it(): ...\n\ndef test_it_again(): ...\n',
    "comparisons/faults/f.py": '@fault("A-1", "f", "?")\ndef one(): ...\n\n@fault("A-2", "g", "?")\ndef two(): ...\n',
}
WHOLE = {
    "A-1": (("tests/test_a.py::test_both",), ("one",)),
    "A-2": (("tests/test_a.py::test_both",), ("two",)),
    "P-1": (("tests/test_p.py",), ()),
}


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A small project in which nothing is missing."""
    for path, text in FILES.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    (tmp_path / TABLE).write_text(table_text(traceability(tmp_path).traces), encoding="utf-8")
    return tmp_path


def change(project: Path, path: str, old: str, new: str) -> tuple[str, ...]:
    """The findings after a change."""
    text = (project / path).read_text(encoding="utf-8")
    assert old in text
    (project / path).write_text(text.replace(old, new), encoding="utf-8")
    return traceability(project).findings


def test_where_nothing_is_missing_nothing_is_found(project: Path) -> None:
    found = traceability(project)
    assert found.findings == ()
    names = {trace.clause: (trace.tests, tuple(fault.name for fault in trace.faults)) for trace in found.traces}
    assert names == WHOLE


def test_a_clause_without_a_test_is_found_in_either_document(project: Path) -> None:
    first, second, *_ = change(project, "tests/test_a.py", '"A-1", ', "")
    assert first == 'A-1 has no test: mark one with @pytest.mark.clause("A-1").'
    assert second.startswith("docs/traceability.md holds A-1 by `tests/test_a.py::test_both`, which is gone")
    assert change(project, "docs/promises.md", "- **P-1**", "- **P-1** Three.\n- **P-2**")[1].startswith(
        "P-2 has no test"
    )


def test_a_clause_of_the_specification_without_a_fault_is_found(project: Path) -> None:
    assert change(project, "comparisons/faults/f.py", "A-2", "A-1")[0].startswith("A-2 has no fault")


def test_a_test_without_a_clause_is_found(project: Path) -> None:
    findings = change(project, "tests/test_a.py", "def test_both", "def test_both(): ...\n\n\ndef test_more")
    assert findings[0].startswith("tests/test_a.py::test_more names no clause")


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        ("tests/test_a.py", "tests/test_a.py::test_both names A-7, which is no clause of docs/spec.md"),
        ("comparisons/faults/f.py", "comparisons/faults/f.py: one breaks A-7, which is no clause of docs/spec.md"),
    ],
)
def test_a_clause_that_does_not_exist_is_found(project: Path, path: str, sentence: str) -> None:
    assert any(finding.startswith(sentence) for finding in change(project, path, '"A-1"', '"A-7"'))


def test_a_fault_that_breaks_a_promise_is_found(project: Path) -> None:
    findings = change(project, "comparisons/faults/f.py", '"A-2"', '"P-1"')
    assert any("two breaks P-1, which is no clause of docs/spec.md" in finding for finding in findings)


def test_a_table_without_what_there_is_or_without_a_file_is_out_of_date(project: Path) -> None:
    outdated = ("docs/traceability.md is out of date: run `raytruth spec --write`.",)
    another = 'def test_both(): ...\n\n\n@pytest.mark.clause("A-1")\ndef test_more'
    assert change(project, "tests/test_a.py", "def test_both", another)[-1:] == outdated
    (project / TABLE).write_text(table_text(traceability(project).traces), encoding="utf-8")
    assert change(project, TABLE, "fault `one`", "")[-1:] == outdated
    (project / TABLE).unlink()
    assert traceability(project).findings == outdated
