from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth import spec_command
from raytruth.specification.traceability import TABLE
from tests.raytruth.running import document, refusal, run
from tests.specification.test_traceability import FILES

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-1", "CMD-2", "CMD-3", "CMD-4", "PRJ-6")


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A small project in the place of ours, which has no committed table yet."""
    for path, text in FILES.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    monkeypatch.setattr(spec_command, "ROOT", tmp_path)
    monkeypatch.setattr(spec_command, "scenes_by_function", lambda: {None: ("x", "y"), "f": ("y",), "g": ()})
    monkeypatch.setattr(spec_command, "scenes_by_fault", lambda _: {"two": ("killer",)})
    return tmp_path


def test_the_table_is_written_and_then_nothing_is_missing(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = run(capsys, "spec")
    assert status == 1
    assert err.splitlines()[-1] == "raytruth: docs/traceability.md is out of date: run `raytruth spec --write`."
    status, out, err = run(capsys, "spec", "--write")
    assert status == 0
    assert out.splitlines() == ["A-1\t1\t1\tone", "A-2\t1\t1\ttwo", "P-1\t1\t0\t"]
    assert "raytruth:" not in err
    assert (project / TABLE).is_file()
    assert run(capsys, "spec")[0] == 0


def test_what_is_gone_gives_1_and_a_sentence(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "spec", "--write")[0] == 0
    (project / "tests/test_a.py").unlink()
    status, _, err = run(capsys, "spec")
    assert status == 1
    assert "raytruth: A-1 has no test" in err
    assert "docs/traceability.md holds A-1 by `tests/test_a.py::test_both`, which is gone" in err


@pytest.mark.usefixtures("project")
def test_json_tells_tests_scenes_and_faults_of_each_clause(capsys: pytest.CaptureFixture[str]) -> None:
    run(capsys, "spec", "--write")
    told = document(capsys, "spec")
    assert told["findings"] == []
    assert told["clauses"][0] == {
        "id": "A-1",
        "tests": ["tests/test_a.py::test_both"],
        "scenes": ["y"],
        "faults": ["one"],
    }
    assert told["clauses"][1]["scenes"] == ["killer"]
    assert [clause["id"] for clause in told["clauses"]] == ["A-1", "A-2", "P-1"]


def test_without_the_tests_it_says_where_they_are(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (project / "tests").rename(project / "elsewhere")
    assert "run it in a clone of the repository" in refusal(capsys, "spec")


def test_a_test_that_is_not_python_is_one_sentence(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (project / "tests/test_a.py").write_text("def", encoding="utf-8")
    assert refusal(capsys, "spec").startswith("raytruth: tests/test_a.py, line 1: this is not Python")
