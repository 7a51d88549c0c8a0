"""The words, signs and number formats that every report shares."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.comparisons.records.results import Verdict

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.records.results import Cell, Results


@dataclass(frozen=True)
class Wording:
    """How an outcome is shown: a sign that needs no colour, a word, the word in a count, and what it means."""

    sign: str
    word: str
    counted: str
    meaning: str


WAIVED = "waived"
"""What a failure that a waiver excuses is shown as."""

WORDINGS: dict[str, Wording] = {
    Verdict.PASS: Wording("✓", "pass", "passed", "every judged pixel is what a right renderer may give"),
    Verdict.DECLARED: Wording(
        "◐",
        "declared",
        "as declared, not as due",
        "feasible, but visibly not the truth: by a shortcut that is declared",
    ),
    Verdict.FAIL: Wording("✗", "fail", "failed", "at least one pixel cannot come from a right renderer"),
    WAIVED: Wording("≠", "waived", "failed as waived", "a failure of known reason, which does not make the run fail"),
    Verdict.INCOMPARABLE: Wording(
        "–", "incomparable", "incomparable", "the scene and the renderer do not define the same image"
    ),
    Verdict.UNAVAILABLE: Wording("?", "unavailable", "unavailable", "the renderer is not installed here"),
    Verdict.ERROR: Wording("!", "error", "ended in an error", "the renderer crashed, hung or wrote no readable image"),
}


def outcome(cell: Cell) -> str:
    """The cell's verdict, or `waived`."""
    return WAIVED if cell.waived is not None and cell.verdict == Verdict.FAIL else cell.verdict.value


def outcome_counts(results: Results) -> dict[str, int]:
    """How many cells have each outcome: all verdicts, zeros included, and waived failures if there are any."""
    counts = Counter(outcome(cell) for cell in results.cells)
    return {known: counts[known] for known in WORDINGS if known != WAIVED or counts[WAIVED]}


def headline(results: Results) -> str:
    """The run's outcome in one sentence."""
    counts = outcome_counts(results)
    troubles = {known: counts.get(known, 0) for known in (Verdict.DECLARED, Verdict.FAIL, WAIVED, Verdict.ERROR)}
    judged = counts[Verdict.PASS] + sum(troubles.values())
    told = [f"{count} {_is(known, count)}{WORDINGS[known].counted}" for known, count in troubles.items() if count]
    if told:
        return f"Of {judged} comparable {plural('cell', judged)}, {listed(told)}"
    if judged == 0:
        return "No cell could be compared"
    return "The one comparable cell passed" if judged == 1 else f"All {judged} comparable cells passed"


def _is(known: str, count: int) -> str:
    """The verb that the words of an outcome lack in a sentence, and a blank."""
    if known != Verdict.DECLARED:
        return ""
    return "is " if count == 1 else "are "


def summary(results: Results) -> str:
    """The counts of all outcomes in one sentence."""
    counts = ", ".join(f"{count} {WORDINGS[known].counted}" for known, count in outcome_counts(results).items())
    total = len(results.cells)
    return f"{total} {plural('cell', total)}: {counts}."


def capped(results: Results) -> str | None:
    """How many pixels of all judged cells are not judged by each of their outcomes; None where no cell was judged."""
    judgements = [cell.judgement for cell in results.cells if cell.judgement is not None]
    if not judgements:
        return None
    pixels = sum(judgement.pixels for judgement in judgements)
    unjudged = sum(judgement.unjudged for judgement in judgements)
    merged = sum(judgement.capped for judgement in judgements)
    of_all = f"of {pixels:,} pixels in {len(judgements)} judged {plural('cell', len(judgements))}"
    if unjudged + merged == 0:
        return f"Capped pixels: none {of_all}."
    share = number(100 * (unjudged + merged) / pixels)
    kinds = f"{merged:,} in a box of several outcomes, {unjudged:,} not judged"
    return f"Capped pixels: {unjudged + merged:,} {of_all} ({share} %): {kinds}."


def columns(results: Results) -> list[tuple[str, str]]:
    """The matrix's columns (renderer, integrator) that have a cell, in the order of the renderers' records."""
    present = dict.fromkeys((cell.renderer, cell.integrator) for cell in results.cells)
    ordered: dict[tuple[str, str], None] = {}
    for renderer in results.renderers:
        declared = [(renderer.name, integrator) for integrator in renderer.integrators]
        undeclared = [column for column in present if column[0] == renderer.name]
        ordered |= dict.fromkeys(column for column in [*declared, *undeclared] if column in present)
    return list(ordered)


def cells_by_place(results: Results) -> dict[tuple[str, str, str], Cell]:
    """Each cell under (scene, renderer, integrator)."""
    return {(cell.scene, cell.renderer, cell.integrator): cell for cell in results.cells}


def number(value: float | None) -> str:
    """A number with three significant digits: plain between 0.001 and 9999, else with an exponent, as in 7.15e-6."""
    if value is None:
        return "–"
    if math.isnan(value):
        return "not a number"
    if math.isinf(value):
        return "infinite" if value > 0 else "−infinite"
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e4:
        return f"{value:.3g}" if abs(value) < 1e3 else f"{value:.0f}"
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def exact(value: float) -> str:
    """A number with nine digits, which tell any two float32 apart (Matula 1968), a value from its bound, too."""
    return f"{value:.9g}" if math.isfinite(value) else number(value)


def printable(text: str) -> str:
    """The text with every control character, of a terminal or of the writing direction, replaced by a visible mark."""
    return "".join(character if character.isprintable() or character in "\n\t" else "�" for character in text)


def listed(names: Sequence[str]) -> str:
    """Names in a row as in a sentence: `a`, `a and b`, `a, b and c`."""
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names)


def plural(noun: str, count: int) -> str:
    """The noun with its s where the count asks for one."""
    return noun if abs(count) == 1 else f"{noun}s"


def evidence(cell: Cell) -> list[str]:
    """What more there is to say of a cell whose image fails, a sentence each: the worst pixel, with its numbers."""
    worst = None if cell.judgement is None or cell.verdict != Verdict.FAIL else cell.judgement.worst
    if worst is None:
        return []
    value, truth, low, high = (
        f"({', '.join(map(exact, colour))})" for colour in (worst.value, worst.truth, worst.low, worst.high)
    )
    return [
        f"Worst pixel ({worst.x}, {worst.y}): it is {value}, the truth is {truth}, and the nearest that it may be is "
        f"{low} to {high}."
    ]
