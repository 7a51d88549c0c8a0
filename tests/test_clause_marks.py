"""A test that names no clause, or one that does not exist, ends the run before it begins."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from tests.conftest import pytest_collection_modifyitems

pytestmark = pytest.mark.clause("PRJ-6")


def item(*clauses: str) -> Any:
    marks = [pytest.mark.clause(*clauses).mark] if clauses else []
    return SimpleNamespace(nodeid="tests/test_x.py::test_y", iter_markers=lambda _name: iter(marks))


def test_tests_that_name_clauses_may_run() -> None:
    pytest_collection_modifyitems([item("SPH-1"), item("SPH-2", "PRJ-6")])


def test_a_test_without_a_clause_stops_the_run() -> None:
    with pytest.raises(pytest.UsageError, match=r"tests/test_x.py::test_y names no clause: mark it with"):
        pytest_collection_modifyitems([item("SPH-1"), item()])


def test_a_clause_that_does_not_exist_stops_the_run() -> None:
    with pytest.raises(pytest.UsageError, match=r"names SPH-99, which is no clause of docs/spec.md"):
        pytest_collection_modifyitems([item("SPH-1", "SPH-99")])
