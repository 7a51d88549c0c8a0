from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.specification.clauses import (
    MarkedFault,
    MarkedTest,
    SourceError,
    clauses_of,
    marked_faults,
    marked_faults_in,
    marked_tests,
    marked_tests_in,
)

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("PRJ-6")

MARKED = """
pytestmark = [pytest.mark.usefixtures("x"), pytest.mark.clause("A-1")]

@pytest.mark.parametrize("x", [1])
@pytest.mark.clause("A-2", "A-3")
def test_one(x): ...

def test_two(): ...

def helper(): ...
"""

FAULTY = """
@fault("A-1", "camera_frame", "hint")
def one(scene): ...

@output_fault("A-2", "hint", BYTES)
def two(image): ...

@cache
def helper(): ...
"""


def test_clauses_are_found_in_their_order(tmp_path: Path) -> None:
    (tmp_path / "spec.md").write_text("- **B-1** One, as A-9.\n  **A-8** no\n- **A-1** Two\n", encoding="utf-8")
    assert clauses_of(tmp_path, "spec.md") == ("B-1", "A-1")


def test_a_test_names_its_own_clauses_and_those_of_its_file() -> None:
    one, two = marked_tests_in("tests/test_x.py", MARKED)
    assert one == MarkedTest("test_one", ("A-2", "A-3"), ("A-1",))
    assert two == MarkedTest("test_two", (), ("A-1",))


def test_a_fault_names_its_clause_and_the_function_that_it_replaces() -> None:
    assert marked_faults_in("x.py", FAULTY) == (
        MarkedFault("one", "A-1", "camera_frame"),
        MarkedFault("two", "A-2", None),
    )


def test_files_are_named_from_the_root_and_those_without_faults_left_out(tmp_path: Path) -> None:
    for path, text in {"tests/a/test_x.py": MARKED, "tests/a/x.py": MARKED, "comparisons/faults/f.py": FAULTY}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    (tmp_path / "comparisons/faults/catalogue.py").write_text("x = 1\n", encoding="utf-8")
    assert list(marked_tests(tmp_path)) == ["tests/a/test_x.py"]
    assert list(marked_faults(tmp_path)) == ["comparisons/faults/f.py"]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("x = (", "test_x.py, line 1: this is not Python ('(' was never closed)"),
        ("pytestmark = pytest.mark.clause(ID)", "test_x.py, line 1: expected a text in quotes, found ID"),
    ],
)
def test_what_cannot_be_read_is_one_sentence(text: str, sentence: str) -> None:
    with pytest.raises(SourceError) as caught:
        marked_tests_in("test_x.py", text)
    assert str(caught.value) == sentence
