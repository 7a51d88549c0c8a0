"""From the counts of an image's pixels to its verdict, with the reason in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.records.results import Verdict

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import DeclaredPixels, Judgement

# One pixel in a hundred may stay unjudged: with more, a fault could hide where nobody looks.
MOST_UNJUDGED = 0.01


def verdict_of(judgement: Judgement) -> tuple[Verdict, str]:
    """Pass if every judged pixel lies in its feasible set and looks as it is due, and nearly all could be judged."""
    judged = judgement.pixels - judgement.unjudged
    pixels = "judged pixels" if judgement.unjudged else "pixels"
    aside = capped_in_words(judgement)
    if judgement.failing:
        return Verdict.FAIL, f"{judgement.failing} of {judged} {pixels} lie outside their feasible sets{aside}"
    if judgement.unjudged > MOST_UNJUDGED * judgement.pixels:
        return Verdict.INCOMPARABLE, unjudged_in_words(judgement.unjudged, judgement.pixels, "pixels")
    if judgement.declared:
        return Verdict.DECLARED, f"{declared_in_words(judgement.declared, judged, pixels)}{aside}"
    return Verdict.PASS, f"all {judged} {pixels} lie in their feasible sets{aside}"


# The first of these that any part of a cell has is the cell's.
FROM_WORST = (Verdict.FAIL, Verdict.INCOMPARABLE, Verdict.DECLARED, Verdict.PASS)


def together(image: tuple[Verdict, str], first_hits: tuple[Verdict, str]) -> tuple[Verdict, str]:
    """The verdict on a cell from those on its image and on its first hits, with the reasons of what does not pass."""
    worst = min(image[0], first_hits[0], key=FROM_WORST.index)
    reasons = [reason for verdict, reason in (first_hits, image) if verdict != Verdict.PASS]
    return worst, "; ".join(reasons) or image[1]


def with_shortcuts(verdict: Verdict, reason: str, shortcuts: str) -> tuple[Verdict, str]:
    """The same; how large the shortcuts are in the scene is told where they matter."""
    return verdict, f"{reason}; {shortcuts}" if verdict == Verdict.DECLARED else reason


def unjudged_in_words(unjudged: int, all_of_them: int, noun: str) -> str:
    """The reason of a cell too many of whose pixels, or first hits, cannot be judged."""
    return f"{unjudged} of {all_of_them} {noun} cannot be judged, since this arithmetic leaves everything open there"


def declared_in_words(declared: DeclaredPixels, judged: int, pixels: str) -> str:
    """How many pixels are as declared, how far from the truth, and which is the farthest."""
    x, y = declared.pixels[0]
    far = f"up to {declared.largest_difference:.3g} from the truth, at ({x}, {y})"
    return f"{declared.count} of {judged} {pixels} are as declared, not as due: {far}"


def capped_in_words(judgement: Judgement) -> str:
    """The counts of pixels that are not judged by each of their outcomes, in parentheses; nothing if there are none."""
    counts = {"in a box of several outcomes": judgement.capped, "not judged": judgement.unjudged}
    words = [f"{count} {what}" for what, count in counts.items() if count]
    return f" ({', '.join(words)})" if words else ""
