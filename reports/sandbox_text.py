"""What came of attacks on sandboxes, in sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from raytruth.comparisons.records.sandbox_results import AttackResult, RungResult


def sandbox_sentence(result: RungResult) -> str:
    """Which sandbox a program ran in, and which attacks it does not hold."""
    if result.rung == "none":
        return f"The program runs in no sandbox: {result.reason}."
    held = len(result.attacks) - len(result.not_enforced)
    begin = (
        f"The program runs in the sandbox {result.rung}, which held {held} of {len(result.attacks)} attacks tried here"
    )
    if not result.not_enforced:
        return f"{begin}."
    return f"{begin}; not enforced: {', '.join(it.attack for it in result.not_enforced)}."


def attack_words(result: AttackResult) -> str:
    """What came of one attack, with what it reached."""
    return f"{result.result}: {result.detail}" if result.result != "held" and result.detail else result.result
