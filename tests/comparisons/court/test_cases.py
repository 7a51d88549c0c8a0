from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.court.cases import CaseError, all_cases

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CRT-2")


def test_there_are_cases_of_many_sources_and_no_two_ask_the_same() -> None:
    cases = all_cases().values()
    assert len(cases) >= 25
    projects = {"/".join(str(source).split("/")[2:5]) for case in cases for source in case.sources}
    assert len(projects) >= 12
    assert len({case.question for case in cases}) == len(cases)


def test_all_mistakes_of_all_files_are_told_at_once(tmp_path: Path) -> None:
    (tmp_path / "first.json").write_text("{", encoding="utf-8")
    (tmp_path / "second.json").write_text('{"title": 3, "sources": []}', encoding="utf-8")
    with pytest.raises(CaseError) as raised:
        all_cases(tmp_path)
    lines = str(raised.value).splitlines()
    assert {line.split(":")[0] for line in lines} == {"first.json", "second.json"}
    for key in ("title", "sources", "dispute", "numbers", "question"):
        assert any(line.startswith(f"second.json: {key}: ") for line in lines)
