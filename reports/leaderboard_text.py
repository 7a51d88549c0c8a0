"""The score of a scene, and a leaderboard, in plain lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reports.wording import plural

if TYPE_CHECKING:
    from raytruth.comparisons.records.leaderboard import Leaderboard, SceneScore


def score_lines(score: SceneScore) -> list[str]:
    """How many faults a scene finds, and which; false alarms first, since they disqualify."""
    lines = [f"{score.scene} finds {_worth(score)}."]
    if score.false_alarms:
        lines.append(f"  It flags what is right, and so has no place on a board: {', '.join(score.false_alarms)}.")
    return [*lines, f"  Found: {', '.join(score.killed_by_it) or 'nothing'}."]


def board_lines(board: Leaderboard) -> list[str]:
    """A line for each place, the best first; equals share a place."""
    lines, place = ["Leaderboard:"], 0
    for number, score in enumerate(board.entries, start=1):
        place = place if number > 1 and board.entries[number - 2].rank == score.rank else number
        lines.append(f"  {place}. {score.name}: {_worth(score)} ({score.scene})")
    return lines


def _worth(score: SceneScore) -> str:
    return f"{score.killed} of {score.faults} faults with {score.pixels} {plural('pixel', score.pixels)}"
