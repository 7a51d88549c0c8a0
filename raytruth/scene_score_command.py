"""`raytruth faults --scene`: the reverse assignment, to design a scene that finds many faults with few pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.kills.kill_run import run_kills
from raytruth.comparisons.kills.scene_score import scene_score
from raytruth.comparisons.records.leaderboard import LONGEST_NAME, LeaderboardError, entered, read_leaderboard
from raytruth.errors import UsageError
from raytruth.options import open_scene
from raytruth.output import print_json, progress, say
from raytruth.reports.leaderboard_text import board_lines, score_lines

if TYPE_CHECKING:
    from pathlib import Path

FAILED = 1


def score_scene(source: str, name: str | None, board: Path | None, out: Path, *, fresh: bool, as_json: bool) -> int:
    """Print the score of a scene, and enter it into a leaderboard; exit status 1 if it flags what is right.

    `name` is whose scene it is, by default the scene's own name. Raises UsageError.
    """
    scene = open_scene(source)
    whose = scene.name if name is None else name
    if not 1 <= len(whose) <= LONGEST_NAME:
        raise UsageError(f"--by: expected a name of 1 to {LONGEST_NAME} characters, found {len(whose)}.")
    try:
        if board is not None:
            read_leaderboard(board)  # before any work
        with progress("Judging faults and variants"):
            (kills,) = run_kills([scene], out, 1, fresh=fresh)
        score = scene_score(whose, scene, kills)
        placed = entered(board, score) if board is not None and not score.false_alarms else None
    except LeaderboardError as error:
        raise UsageError(f"--leaderboard: {error}") from error
    if as_json:
        places = placed.model_dump(mode="json")["entries"] if placed else None
        print_json({**score.model_dump(mode="json"), "leaderboard": places})
    else:
        say("\n".join([*score_lines(score), *(board_lines(placed) if placed else [])]))
    return FAILED if score.false_alarms else 0
