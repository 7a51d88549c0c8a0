"""Sectors of the plane around a point, and whether they leave a gap: exact, without angles."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

Direction = tuple[Fraction, Fraction]
Sector = tuple[Direction, Direction]
"""All directions from the first counterclockwise to the second, by at most half a turn."""


def surrounds(sectors: Sequence[Sector]) -> bool:
    """Whether every direction is in a sector.

    A gap begins where a sector ends. So there is none if each sector's end lies in another, short of that one's end.
    """
    return bool(sectors) and all(any(_goes_on_beyond(other, end) for other in sectors) for _, end in sectors)


def is_counterclockwise(corners: Sequence[Direction]) -> bool:
    """Whether three corners, not on one line, run counterclockwise."""
    (ax, ay), (bx, by), (cx, cy) = corners
    return _turn((bx - ax, by - ay), (cx - ax, cy - ay)) > 0


def _goes_on_beyond(sector: Sector, direction: Direction) -> bool:
    """Whether the sector holds this direction and those just counterclockwise of it."""
    start, end = sector
    if _turn(start, direction) == 0 and _same_side(start, direction):
        return True
    return _turn(start, direction) > 0 and (_turn(direction, end) > 0 or _turn(start, end) == 0)


def _turn(a: Direction, b: Direction) -> Fraction:
    """Positive where b is counterclockwise of a by less than half a turn, 0 where both are on one line."""
    return a[0] * b[1] - a[1] * b[0]


def _same_side(a: Direction, b: Direction) -> bool:
    return a[0] * b[0] + a[1] * b[1] > 0
