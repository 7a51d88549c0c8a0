from __future__ import annotations

import io
from typing import TYPE_CHECKING

import pytest
from rich.console import Console

from raytruth.comparisons.records.kill_results import KILLS_FILE, FaultResult, KillResults, VariantResult
from raytruth.reports.kills import (
    SHADES,
    clauses_by_scene,
    gate_counts,
    margin,
    print_kills,
    shade,
    summary,
    write_kill_report,
)

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REP-1", "REP-2")


def fault(name: str, margins: dict[str, float | None], **changes: object) -> FaultResult:
    killed_by = tuple(scene for scene, value in margins.items() if value is None or value > 1)
    values = {
        "name": name,
        "words": "It is <b>wrong</b>.",
        "clause": "CAM-1",
        "hint": "Why?",
        "killed": bool(killed_by),
        "killed_by": killed_by,
        "margin": None if None in margins.values() else max(filter(None, margins.values()), default=0.0),
        "margins": margins,
        "errors": {},
        "gates": (),
    }
    return FaultResult.model_validate(values | changes)


RESULTS = KillResults(
    faults=(
        fault("swapped_axes", {"one": 12345.0, "two": 0.5}, gates=("gate",)),
        fault("endless_loop", {"one": None}, errors={"one": "TookTooLongError: <i>"}),
        fault("too_subtle", {"two": 0.25}),
    ),
    variants=(
        VariantResult(name="right", words="Fine.", margins={"one": 0.9}, errors={}, gates=("gate",), flagged=False),
        VariantResult(name="accused", words="Fine, too.", margins={"two": 3.0}, errors={}, gates=(), flagged=True),
    ),
    seconds=3.0,
    scenes={"one": 0.5, "two": 0.25},
    gates=("gate",),
    quick=("one",),
)


def test_the_summary_counts_what_is_killed_and_what_is_flagged() -> None:
    assert summary(RESULTS) == "2 of 3 faults are killed by 2 scenes; 1 of 2 legitimate variants are flagged."
    assert gate_counts(RESULTS)[1:] == [("gate", 1, 1)]


def test_the_console_names_survivors_and_false_alarms() -> None:
    stream = io.StringIO()
    print_kills(RESULTS, Console(file=stream, width=20))
    text = stream.getvalue()
    assert "SURVIVES  CAM-1   too_subtle: 0 of 1 scenes, margin 0.25\n" in text
    assert "killed    CAM-1   endless_loop: 1 of 1 scenes, margin ∞\n" in text
    assert "flagged   variant accused: on two\n" in text
    assert "Quick suite, 0.5 s a renderer: one\n" in text


def test_the_page_shows_every_margin_and_escapes_all_words(tmp_path: Path) -> None:
    (tmp_path / KILLS_FILE).write_text(RESULTS.model_dump_json(), encoding="utf-8")
    page = write_kill_report(tmp_path)
    text = page.read_text(encoding="utf-8")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["faults.html", "faults.json"]
    assert "swapped axes" in text
    assert "1.2e+04" in text
    assert "It is &lt;b&gt;wrong&lt;/b&gt;." in text
    assert "TookTooLongError: &lt;i&gt;" in text
    assert "<script" not in text


@pytest.mark.parametrize(
    ("value", "step"), [(0.0, 0), (1.0, 0), (1.01, 1), (101.0, 2), (1e4 + 1, 3), (1e30, SHADES), (None, SHADES)]
)
def test_a_shade_darker_is_a_hundred_times_farther(value: float | None, step: int) -> None:
    assert shade(value) == step


def test_margins_have_two_digits() -> None:
    assert [margin(value) for value in (None, 0.123, 98765.0, 2e9)] == ["∞", "0.12", "9.9e+04", ">1e9"]


@pytest.mark.clause("REP-12")
def test_a_scene_has_the_clauses_of_the_faults_that_it_kills(tmp_path: Path) -> None:
    assert clauses_by_scene(tmp_path) == {}
    (tmp_path / KILLS_FILE).write_text(RESULTS.model_dump_json(), encoding="utf-8")
    assert clauses_by_scene(tmp_path) == {"one": ("CAM-1",)}
    (tmp_path / KILLS_FILE).write_text("{", encoding="utf-8")
    assert clauses_by_scene(tmp_path) == {}
