from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.records.leaderboard import (
    Leaderboard,
    LeaderboardError,
    SceneScore,
    entered,
    read_leaderboard,
    with_score,
)

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("GRD-10")


def score(name: str, killed: int, pixels: int) -> SceneScore:
    return SceneScore(
        name=name,
        scene="mine",
        killed=killed,
        faults=100,
        pixels=pixels,
        killed_by_it=(),
        missed=(),
        false_alarms=(),
    )


SCORES = st.builds(score, st.sampled_from(["Ada", "Bo", "Cy"]), st.integers(0, 9), st.integers(1, 9))


@given(st.lists(SCORES, max_size=8), st.randoms())
def test_each_name_has_its_best_scene_whatever_the_order(scores: list[SceneScore], order: st.DataObject) -> None:
    board = Leaderboard()
    for it in scores:
        board = with_score(board, it)
    for name in {it.name for it in scores}:
        (own,) = [it for it in board.entries if it.name == name]
        assert own.rank == min(it.rank for it in scores if it.name == name)
    assert [it.rank for it in board.entries] == sorted(it.rank for it in board.entries)
    shuffled = list(scores)
    order.shuffle(shuffled)  # type: ignore[attr-defined]  # a Random
    again = Leaderboard()
    for it in shuffled:
        again = with_score(again, it)
    assert again == board


def test_more_faults_come_first_and_of_equals_fewer_pixels(tmp_path: Path) -> None:
    path = tmp_path / "board.json"
    for it in (score("Ada", 5, 9), score("Bo", 6, 300), score("Cy", 5, 4), score("Bo", 3, 1)):
        board = entered(path, it)
    assert [it.name for it in board.entries] == ["Bo", "Cy", "Ada"]
    assert read_leaderboard(path) == board


def test_no_score_is_lost_where_several_are_entered_at_once(tmp_path: Path) -> None:
    path = tmp_path / "board.json"
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda number: entered(path, score(f"name-{number}", number, 1)), range(24)))
    assert len(read_leaderboard(path).entries) == 24


@pytest.mark.clause("CMD-2")
def test_another_file_is_refused_and_left_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "board.json"
    path.write_text('{"entries": 3}')
    with pytest.raises(LeaderboardError, match="expected a leaderboard"):
        entered(path, score("Ada", 1, 1))
    assert path.read_text() == '{"entries": 3}'
