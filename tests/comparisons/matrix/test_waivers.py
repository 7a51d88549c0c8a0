from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.matrix.waivers import Waiver, WaiverError, apply_waivers, load_waivers
from raytruth.comparisons.records.results import Cell, FirstHitComparison, Judgement, Verdict
from raytruth.scenes.library import library_names, open_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("VER-13")

WAIVER: dict[str, Any] = {
    "renderer": "povray",
    "version": "POV-Ray 3.7.*",
    "scene": "a",
    "integrator": "whitted",
    "most_failing_pixels": 3,
    "reason": "It is old.",
    "link": "https://example.org/fault",
}
VERSIONS = {"povray": "POV-Ray 3.7.0.10"}


def cell(verdict: Verdict = Verdict.FAIL, failing: int = 3, **more: Any) -> Cell:
    judgement = Judgement(pixels=9, failing=failing, unjudged=0, capped=0, ambiguous=0)
    names = {"scene": "a", "renderer": "povray", "integrator": "whitted", "reason": "", "command": ""}
    return Cell.model_validate({**names, "verdict": verdict, "judgement": judgement, **more})


def applied(found: Cell, versions: dict[str, str | None] | None = None, **changes: Any) -> tuple[Cell, list[str]]:
    waiver = Waiver.model_validate(WAIVER | changes)
    (after,), unmatched = apply_waivers([waiver], [found], VERSIONS if versions is None else versions, [])
    return after, unmatched


def test_a_cell_that_fails_as_its_waiver_says_is_waived_and_still_a_failure() -> None:
    after, unmatched = applied(cell())
    assert unmatched == []
    assert after.verdict == Verdict.FAIL
    assert after.waived is not None
    assert (after.waived.reason, after.waived.link) == ("It is old.", "https://example.org/fault")


def test_first_hits_that_fail_count_too() -> None:
    hits = FirstHitComparison(
        compared=9,
        primitive_mismatches=0,
        ambiguous=0,
        largest_depth_error=0,
        largest_position_error=0,
        largest_normal_error=0,
        failing=1,
    )
    assert applied(cell(failing=2, first_hits=hits))[0].waived is not None
    assert applied(cell(failing=3, first_hits=hits))[0].waived is None
    assert applied(cell(judgement=None, first_hits=hits))[0].waived is not None


@pytest.mark.parametrize(
    ("found", "told"),
    [
        (cell(failing=4), "4 pixels fail, more than the 3 that it excuses"),
        (cell(Verdict.PASS, 0), "the verdict is pass: remove it"),
        (cell(Verdict.INCOMPARABLE, 0), "the verdict is incomparable: remove it"),
    ],
)
def test_a_waiver_of_what_was_run_that_matches_nothing_is_told(found: Cell, told: str) -> None:
    after, (sentence,) = applied(found)
    assert after == found
    assert sentence == f"The waiver of povray/whitted on a matches nothing, since {told}."


@pytest.mark.parametrize(
    ("versions", "changes"),
    [
        (VERSIONS, {"scene": "b"}),
        (VERSIONS, {"renderer": "mitsuba"}),
        (VERSIONS, {"integrator": "path"}),
        ({"povray": "POV-Ray 3.8.0"}, {}),
        ({"povray": None}, {}),
        ({}, {}),
    ],
)
def test_a_waiver_of_what_was_not_run_is_left_alone(versions: dict[str, str | None], changes: dict[str, Any]) -> None:
    for found in (cell(), cell(Verdict.PASS, 0)):
        assert applied(found, versions, **changes) == (found, [])


def test_a_cell_that_ended_in_an_error_is_left_alone() -> None:
    found = cell(Verdict.ERROR, 0)
    assert applied(found) == (found, [])


def test_the_packaged_waivers_are_of_scenes_of_the_library_or_of_a_property() -> None:
    waivers = load_waivers()
    assert waivers
    assert {waiver.scene for waiver in waivers if waiver.scene is not None} <= set(library_names())


OF_PROPERTY = {key: value for key, value in WAIVER.items() if key not in {"scene", "most_failing_pixels"}}
OF_PROPERTY |= {"scenes_with": "nested dielectrics"}


@pytest.mark.parametrize(("scene", "has_it"), [("bubble-in-glass", True), ("glass-sphere", False), ("gone", False)])
def test_a_waiver_of_a_property_is_of_all_scenes_that_have_it_and_is_never_told(scene: str, has_it: bool) -> None:
    waiver = Waiver.model_validate(OF_PROPERTY)
    scenes = [open_scene(name) for name in library_names()]
    for found in (
        cell(failing=9, scene=scene),
        cell(Verdict.PASS, 0, scene=scene),
        cell(Verdict.ERROR, 0, scene=scene),
    ):
        (after,), unmatched = apply_waivers([waiver], [found], VERSIONS, scenes)
        assert (after.waived is not None) == (has_it and found.verdict == Verdict.FAIL)
        assert unmatched == []
    (other,), _ = apply_waivers([waiver], [cell(scene=scene, integrator="path")], VERSIONS, scenes)
    assert other.waived is None


def test_a_scene_with_more_failing_pixels_than_its_own_waiver_excuses_is_still_known_by_its_property() -> None:
    waivers = [Waiver.model_validate(WAIVER | {"scene": "bubble-in-glass"}), Waiver.model_validate(OF_PROPERTY)]
    (after,), unmatched = apply_waivers(
        waivers, [cell(failing=4, scene="bubble-in-glass")], VERSIONS, [open_scene("bubble-in-glass")]
    )
    assert after.waived is not None
    assert len(unmatched) == 1  # which fails the run all the same


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ([WAIVER | {"renderer": "povary"}], "[0].renderer: there is none called 'povary': did you mean 'povray'"),
        ([WAIVER, WAIVER | {"integrator": "path"}], "[1].integrator: there is none called 'path': known are 'whitted'"),
        ([WAIVER | {"link": "javascript:alert(1)"}], "[0].link: "),
        ([WAIVER | {"most_failing_pixels": -1}], "[0].most_failing_pixels: "),
        ([WAIVER | {"reason": ""}], "[0].reason: "),
        ([WAIVER | {"verdict": "fail"}], "[0].verdict: "),
        ([{}], "[0].renderer: Field required (and 4 more)."),
        ([OF_PROPERTY | {"scenes_with": "fog"}], "[0].scenes_with: "),
        ([OF_PROPERTY | {"scene": "a"}], "[0]: Value error, expected either scene or scenes_with"),
        ([OF_PROPERTY | {"most_failing_pixels": 1}], "[0]: Value error, expected most_failing_pixels with scene"),
        ({}, "the whole file: "),
    ],
)
def test_a_file_that_is_wrong_is_refused_in_one_sentence(content: Any, told: str, tmp_path: Path) -> None:
    path = tmp_path / "waivers.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(WaiverError) as refusal:
        load_waivers(path)
    assert str(refusal.value).startswith(f"{path}: {told}")
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("content", [b"", b"[", b"\xff", b"[" * 10_000])
def test_what_is_no_json_is_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "waivers.json"
    path.write_bytes(content)
    with pytest.raises(WaiverError, match="the whole file: Invalid JSON"):
        load_waivers(path)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    for path in (tmp_path / "nowhere.json", tmp_path):
        with pytest.raises(WaiverError, match="expected a readable file of waivers"):
            load_waivers(path)
