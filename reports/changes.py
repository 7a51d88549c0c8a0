"""What changed between two results directories, cell by cell."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.wording import WAIVED, cells_by_place, outcome

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import Results

GOOD = {Verdict.PASS.value, Verdict.DECLARED.value, WAIVED}
BAD = {Verdict.FAIL.value, Verdict.ERROR.value}

TITLES = {
    "worse": "Failed now, and did not before",
    "better": "Failed before, and does not now",
    "other": "Another verdict",
    "larger": "The same verdict, a larger error",
    "smaller": "The same verdict, a smaller error",
    "new": "Not in the earlier results",
    "gone": "In the earlier results only",
}
"""The kinds of changes in the order in which they are told, with their words."""


@dataclass(frozen=True)
class Change:
    """A cell that is otherwise than it was; an outcome is None where there was, or is, no such cell."""

    kind: str
    place: tuple[str, str, str]
    """Scene, renderer, integrator."""
    before: str | None
    now: str | None
    error_before: float | None = None
    error_now: float | None = None


def changes(before: Results, now: Results) -> dict[str, list[Change]]:
    """All cells that changed, under the titles of their kinds; a kind without any is left out."""
    old, new = cells_by_place(before), cells_by_place(now)
    found: dict[str, list[Change]] = {kind: [] for kind in TITLES}
    for place in dict.fromkeys([*new, *old]):
        then, here = old.get(place), new.get(place)
        outcomes = None if then is None else outcome(then), None if here is None else outcome(here)
        errors = None if then is None else then.largest_error, None if here is None else here.largest_error
        kind = _kind(*outcomes, *errors)
        if kind is not None:
            found[kind].append(Change(kind, place, *outcomes, *errors))
    return {TITLES[kind]: listed for kind, listed in found.items() if listed}


def _kind(before: str | None, now: str | None, error_before: float | None, error_now: float | None) -> str | None:
    if before is None or now is None:
        return "new" if before is None else "gone"
    if before != now:
        if now in BAD and before not in BAD:
            return "worse"
        return "better" if before in BAD and now in GOOD else "other"
    if error_before is None or error_now is None or error_before == error_now:
        return None
    return "smaller" if error_now < error_before else "larger"
