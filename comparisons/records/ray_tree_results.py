"""What came of comparing a ray tree that a program printed: the contract between comparing and showing."""

from __future__ import annotations

from typing import Literal

from raytruth.comparisons.records.results import Record

What = Literal["origin", "direction", "primitive", "distance", "normal", "local", "missing", "extra", "color"]


class Divergence(Record):
    """The first thing of a tree that no right tracer has."""

    path: str
    """How the ray came about: a letter for each bounce."""
    what: What
    found: tuple[float, ...] = ()
    """What the program printed; empty where it printed nothing, or hits nothing."""
    low: tuple[float, ...] = ()
    high: tuple[float, ...] = ()
    """What it may be, of the way that fits best; empty where nothing is to be hit."""


class Comparison(Record):
    """What came of comparing a tree."""

    agreed: int
    """How many rays were found as they should be, before the first that is not."""
    divergence: Divergence | None
    open_paths: tuple[str, ...] = ()
    """Of rays that may go more ways than are told apart: they and what follows them are not compared."""
