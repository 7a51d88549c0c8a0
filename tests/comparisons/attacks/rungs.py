"""Which rungs of the ladder this machine has."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from raytruth.comparisons.attacks.attacks import behaves
from raytruth.comparisons.attacks.grader import attacked_grader
from raytruth.comparisons.sandboxes.sandbox import missing_for

if TYPE_CHECKING:
    from raytruth.comparisons.sandboxes.sandbox import Rung


@cache
def why_not(rung: Rung) -> str:
    """Why nothing can be tried on a rung here; empty where it can. That it is a reason, test_attacks.py holds."""
    missing = missing_for(rung)
    if missing is not None:
        return missing
    with attacked_grader() as grader:
        return behaves(rung, grader)
