"""Scores of scenes that students have designed, as `raytruth faults --scene` and a leaderboard file hold them."""

from __future__ import annotations

import fcntl
from typing import TYPE_CHECKING

from pydantic import Field, ValidationError

from raytruth.comparisons.records.results import Record
from raytruth.reference_tracer.storage.whole_files import write_whole

if TYPE_CHECKING:
    from pathlib import Path

# More than a course has students; each takes some kilobytes.
MOST_ENTRIES = 10_000
# A name as people have it.
LONGEST_NAME = 60


class SceneScore(Record):
    """How many faults a scene finds, and with how many pixels."""

    name: str = Field(min_length=1, max_length=LONGEST_NAME)
    """Whose scene it is."""
    scene: str
    killed: int
    faults: int
    """How many there are in the catalogue."""
    pixels: int
    killed_by_it: tuple[str, ...]
    """The faults, by their names."""
    missed: tuple[str, ...]
    false_alarms: tuple[str, ...]
    """Right variants that it flags: with one of these it has no place on the board."""

    @property
    def rank(self) -> tuple[int, int]:
        """Less is better: more faults first, then fewer pixels."""
        return -self.killed, self.pixels


class Leaderboard(Record):
    """The best scene of each name, the best first."""

    schema_version: int = 1
    entries: tuple[SceneScore, ...] = Field((), max_length=MOST_ENTRIES)


class LeaderboardError(Exception):
    """The file is no leaderboard; the message is one sentence."""


def read_leaderboard(path: Path) -> Leaderboard:
    """The board in a file; an empty one where there is no such file. Raises LeaderboardError, OSError."""
    try:
        return Leaderboard.model_validate_json(path.read_bytes())
    except FileNotFoundError:
        return Leaderboard()
    except ValidationError as error:
        raise LeaderboardError(
            f"{path}: expected a leaderboard, as --leaderboard writes it, found another file."
        ) from error


def entered(path: Path, score: SceneScore) -> Leaderboard:
    """The board with this score, written to the file; a better one of the same name stays.

    Several processes may enter scores at once: each waits for the others. Raises LeaderboardError, OSError.
    """
    with path.with_name(f"{path.name}.lock").open("wb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        board = with_score(read_leaderboard(path), score)
        write_whole(path, board.model_dump_json(indent=1))
    return board


def with_score(board: Leaderboard, score: SceneScore) -> Leaderboard:
    """The board with the better of this score and the one that its name has already."""
    own = [it for it in board.entries if it.name == score.name]
    others = [it for it in board.entries if it.name != score.name]
    best = min([*own, score], key=lambda it: it.rank)
    return Leaderboard(entries=tuple(sorted([*others, best], key=lambda it: (it.rank, it.name))))
