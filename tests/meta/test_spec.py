"""No test and no fault can go unnoticed."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.specification.clauses import FAULTS, TESTS, marked_faults, marked_tests
from raytruth.specification.traceability import traceability

pytestmark = pytest.mark.clause("PRJ-6")

ROOT = Path(__file__).parents[2]


def test_every_clause_is_covered_and_the_committed_table_is_true() -> None:
    assert traceability(ROOT).findings == ()


def test_the_faults_that_are_read_are_those_of_the_catalogue() -> None:
    read = {fault.name: fault for faults in marked_faults(ROOT).values() for fault in faults}
    assert {name: fault.clause for name, fault in read.items()} == {
        name: fault.clause for name, fault in all_faults().items()
    }
    for name, fault in all_faults().items():
        assert read[name].function == next(iter(fault.overrides), None)


def test_deleting_any_test_file_or_fault_file_is_found(tmp_path: Path) -> None:
    for folder in ("docs", TESTS, FAULTS):
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__", "pictures"))
    assert traceability(tmp_path).findings == ()
    tests, faults = marked_tests(ROOT), marked_faults(ROOT)
    assert len(tests) > 100
    assert len(faults) > 10
    for path in (*tests, *faults):
        text = (tmp_path / path).read_bytes()
        (tmp_path / path).unlink()
        findings = "\n".join(traceability(tmp_path).findings)
        gone = [path] if path in tests else [f"fault `{fault.name}`" for fault in faults[path]]
        assert [name for name in gone if name not in findings] == []
        (tmp_path / path).write_bytes(text)
    assert traceability(tmp_path).findings == ()
