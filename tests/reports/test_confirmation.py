from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.records.results import DeclaredPixels, FirstHitComparison, Judgement
from raytruth.reports.confirmation import confirming, in_one_line
from tests.reports.test_agreement import agreement, bare, cell, results

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.results import Cell

pytestmark = pytest.mark.clause("REP-7", "VER-14")


def declared(renderer: str, *pixels: tuple[int, int], count: int | None = None, **more: Any) -> Cell:
    """A cell that is as declared, not as due, at these pixels, of which `count` are told."""
    told = DeclaredPixels(count=count or len(pixels), largest_difference=0.5, pixels=pixels)
    judgement = Judgement(pixels=24, failing=0, unjudged=0, capped=0, ambiguous=0, declared=told, worst=None)
    return bare(renderer, "declared", judgement=judgement, **more)


def test_a_family_that_is_wrong_in_one_cell_confirms_nothing_and_others_do(tmp_path: Path) -> None:
    cells = [
        bare("one", "pass"),
        bare("one-fast", "fail"),
        bare("two", "pass"),
        bare("three", "incomparable"),
        bare("two", "pass", "b"),
        bare("three", "pass", "b"),
    ]
    assert confirming(results(*cells)) == {"a": {"two": frozenset()}, "b": {"three": frozenset(), "two": frozenset()}}
    line = "Independent references: 1 of 2 scenes confirmed by two or more; one-fast is wrong on a."
    assert in_one_line(results(*cells)) == line
    assert in_one_line(results(bare("raytruth", "pass"))) is None
    assert agreement(tmp_path, *cells).sentences[0].startswith("1 of 2 independent references agrees with")


def test_pixels_that_are_as_declared_are_not_confirmed_and_all_others_are() -> None:
    cells = [declared("one", (1, 2), (3, 4)), bare("two", "pass"), bare("three", "pass")]
    assert confirming(results(*cells))["a"]["one"] == {(1, 2), (3, 4)}
    assert in_one_line(results(*cells)) == "Independent references: 1 of 1 scene confirmed by two or more."
    line = "Independent references: 1 of 1 scene confirmed by two or more, but for 2 pixels in 1 of them."
    assert in_one_line(results(*cells[:2])) == line


def test_what_one_cell_of_a_project_leaves_open_another_may_confirm() -> None:
    both = results(declared("one", (1, 2), (3, 4)), declared("one-fast", (3, 4), (5, 0)))
    assert confirming(both) == {"a": {"one": {(3, 4)}}}
    assert confirming(results(declared("one", (1, 2)), bare("one-fast", "pass"))) == {"a": {"one": set()}}


def test_a_cell_of_which_not_all_declared_pixels_are_known_confirms_nothing() -> None:
    hits = FirstHitComparison(
        **dict.fromkeys(("compared", "primitive_mismatches", "ambiguous", "failing"), 0),
        **dict.fromkeys(("largest_depth_error", "largest_position_error", "largest_normal_error"), 0.0),
        declared=1,
    )
    for unknown in (
        declared("one", (1, 2), count=2),
        declared("one", (1, 2), first_hits=hits),
        bare("one", "declared", first_hits=hits),
    ):
        assert confirming(results(unknown)) == {"a": {}}


def test_an_agreement_tells_at_how_many_pixels_it_ends(tmp_path: Path) -> None:
    first, *others = agreement(tmp_path, declared("one", (1, 2)), cell(tmp_path, "two")).sentences
    assert first == "Both independent references agree with the truth: one (but for 1 pixel) and two."
    assert others == ["one/x is as declared, not as due, and confirms nothing at those pixels: so it is."]
