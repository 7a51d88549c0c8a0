from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import TYPE_CHECKING

import pytest

from benchmarks.mistakes import measurement, mistakes, page
from benchmarks.mistakes.measurement import Results, Told, key_of, load_results, measured, save
from benchmarks.mistakes.mistakes import Mistake, all_mistakes, drawn_pairs, write_submission
from raytruth.comparisons.grading.assignment import Assignment
from raytruth.comparisons.grading.faulty_tracers import single_faults
from raytruth.comparisons.grading.global_mistakes import GLOBAL_MISTAKES
from tests.comparisons.grading.small_scenes import AtOnce, small_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("GRD-4")

MISTAKES = {mistake.name: mistake for mistake in all_mistakes()}
TOLD = Told(
    lost=("shadows", "whole"),
    names=("no_pi", "no_shadow_rays"),
    explained=3,
    looked_at=4,
    is_unknown=True,
    score=50.0,
    seconds=1.0,
)


def test_there_are_enough_mistakes_of_each_kind_and_no_two_of_one_name() -> None:
    assert len(MISTAKES) == len(all_mistakes()) >= 60
    assert sum(not mistake.known_as for mistake in MISTAKES.values()) >= 10
    assert {mistake.language for mistake in MISTAKES.values()} == set(mistakes.LANGUAGES)


@pytest.mark.parametrize("name", MISTAKES)
def test_each_mistake_finds_its_place_in_the_example(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        mistakes.subprocess, "run", lambda *_arguments, **_options: None
    )  # no compiler is needed for this
    mistake = MISTAKES[name]
    assert write_submission((mistake,), tmp_path).is_file()
    altered = (tmp_path / mistake.file).read_text(encoding="utf-8")
    assert mistake.new in altered
    assert altered != (mistakes.TRACERS / mistake.language / mistake.file).read_text(encoding="utf-8")
    if mistake.language == "python":
        ast.parse(altered)


def test_what_a_mistake_is_known_as_is_known() -> None:
    known = {tracer.name for tracer in single_faults()} | {mistake.name for mistake in GLOBAL_MISTAKES}
    assert frozenset[str]().union(*(mistake.known_as for mistake in MISTAKES.values())) <= known


def test_a_mistake_that_the_example_has_no_place_for_is_refused(tmp_path: Path) -> None:
    nowhere = Mistake(name="nowhere", language="python", file="tracer.py", topic="glass", old="no such line", new="")
    with pytest.raises(ValueError, match="nowhere: found 'no such line' 0 times"):
        write_submission((nowhere,), tmp_path)


def test_pairs_are_drawn_alike_each_time_of_mistakes_that_go_together() -> None:
    pairs = drawn_pairs(all_mistakes())
    assert pairs == drawn_pairs(all_mistakes())
    assert len({key_of(pair) for pair in pairs}) == mistakes.PAIRS
    assert all(one.known_as.isdisjoint(other.known_as) for one, other in pairs)
    same = [MISTAKES["Blinn everywhere"], MISTAKES["Phong everywhere"]]
    with pytest.raises(ValueError, match=r"Sample larger than population"):  # both stand in the same place
        drawn_pairs(same)


@dataclass(frozen=True)
class Quick:
    """A mistake, and the small scenes that show it."""

    mistake: str
    scenes: tuple[str, ...]
    told: str | None
    lost: tuple[str, ...]


@pytest.mark.parametrize(
    "quick",
    [
        Quick("gradient upside down", ("convex-mirror",), "gradient_upside_down", ("all",)),
        Quick("blue first", ("three-coloured-lights",), "channels_as_BGR", ()),
        Quick("normals bent upward", ("single-sphere",), None, ("all",)),
    ],
    ids=lambda quick: quick.mistake,
)
def test_a_few_mistakes_are_told_in_small_scenes(quick: Quick) -> None:
    scenes = [small_scene(name) for name in quick.scenes]
    stated = {"name": "few", "title": "Few", "models": [{}], "topics": [{"id": "all", "title": "All"}]}
    told = measured((MISTAKES[quick.mistake],), Assignment.model_validate(stated), {"all": scenes}, AtOnce())
    assert told.lost == quick.lost
    assert told.is_unknown == (quick.told is None)
    if quick.told is not None:
        assert told.names[0] == quick.told


def test_results_are_kept_whole(tmp_path: Path) -> None:
    assert load_results(tmp_path / "results.json") == Results()
    save(Results(told={"one": TOLD}), tmp_path / "results.json")
    assert load_results(tmp_path / "results.json") == Results(told={"one": TOLD})


def test_the_page_counts_what_was_told_rightly() -> None:
    known, other, unknown = MISTAKES["shadows forgotten"], MISTAKES["pi forgotten"], MISTAKES["shadows half as dark"]
    pair = (known, other)
    results = Results(told={key_of(given): TOLD for given in ((known,), (other,), (unknown,), pair)})
    lines = page.block(results, [known, other, unknown], [pair]).splitlines()
    assert lines[0] == "Measured: 4 of 4 submissions."
    assert lines[4:9] == [
        "| points are lost first in the topic of the mistake | 2 of 3 (67 %) |",
        "| the true fault is told first | 1 of 2 (50 %) |",
        "| it is among the first three | 2 of 2 (100 %) |",
        "| a mistake that the catalogue lacks is said to be unknown | 1 of 1 (100 %) |",
        "| of two mistakes at once both are among the first four | 1 of 1 (100 %) |",
    ]
    assert "| pi forgotten | cpp | shadows, not shading | `no_pi` | `no_pi` | 3 of 4 | 1 |" in lines
    assert any(line.startswith("| shadows forgotten; pi forgotten |") and line.endswith("| 2, 1 |") for line in lines)


def test_the_page_shows_the_results_that_are_kept() -> None:
    every = all_mistakes()
    results = load_results(measurement.RESULTS)
    text = page.PAGE.read_text(encoding="utf-8")
    assert page.block(results, every, drawn_pairs(every)) in text
    names = {key_of((mistake,)) for mistake in every} | {key_of(pair) for pair in drawn_pairs(every)}
    assert results.told.keys() <= names, "results of mistakes that are no more: python -m benchmarks.mistakes --again"
