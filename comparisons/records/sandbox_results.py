"""What came of attacks on a sandbox, as a file of JSON holds it: the contract between trying and showing."""

from __future__ import annotations

from typing import Literal

from raytruth.comparisons.records.results import Record


class AttackResult(Record):
    """What came of one attack."""

    attack: str
    result: Literal["held", "not enforced", "not tried"]
    """Not tried: the attack failed for another reason, which says nothing of the sandbox."""
    detail: str
    """What held it, or what it reached, in a clause; empty if nothing is to be said."""


class RungResult(Record):
    """What came of all attacks on one rung of the ladder."""

    rung: Literal["bubblewrap", "landlock", "user", "none"]
    works: bool
    """Whether a program that behaves runs in it."""
    reason: str = ""
    """Why it cannot be used here, in a clause."""
    attacks: tuple[AttackResult, ...] = ()

    @property
    def not_enforced(self) -> list[AttackResult]:
        """The attacks that were not held, or not shown to be."""
        return [it for it in self.attacks if it.result != "held"]
