from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comparisons import quick_suite
from comparisons.kill_matrix import small
from comparisons.quick_suite import quick_scenes, smallest_cover, write_quick_scenes, write_quick_suite
from scenes.library import open_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("VER-12")

NAMES = "abcde"


@given(
    st.lists(st.sets(st.sampled_from(NAMES), min_size=1), max_size=8),
    st.lists(st.integers(1, 9), min_size=5, max_size=5),
)
def test_the_cover_covers_and_none_is_cheaper(killers: list[set[str]], costs: list[int]) -> None:
    cost = dict(zip(NAMES, map(float, costs), strict=True))
    found = smallest_cover(killers, cost)
    assert all(scenes & set(found) for scenes in killers)
    subsets = [set(some) for size in range(6) for some in combinations(NAMES, size)]
    covering = [some for some in subsets if all(scenes & some for scenes in killers)]
    assert sum(cost[name] for name in found) == min(sum(cost[name] for name in some) for some in covering)


def test_the_suite_is_written_as_small_scene_files(tmp_path: Path) -> None:
    paths = write_quick_suite(tmp_path)
    assert [open_scene(path).name for path in paths] == list(quick_scenes())
    for path in paths:
        scene = open_scene(path)
        assert scene.camera == small(open_scene(scene.name)).camera


def test_another_suite_takes_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quick_suite, "QUICK_FILE", tmp_path / "quick.json")
    write_quick_scenes(["single-sphere"])
    assert quick_scenes() == ("single-sphere",)
