"""The results as a page of the documents."""

from __future__ import annotations

from typing import TYPE_CHECKING

from benchmarks.mistakes.measurement import key_of
from benchmarks.mistakes.mistakes import FOLDER

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.mistakes.measurement import Results, Told
    from benchmarks.mistakes.mistakes import Mistake

PAGE = FOLDER.parent.parent / "docs" / "diagnosis.md"
BEGIN, END = "<!-- mistakes: begin -->\n", "<!-- mistakes: end -->"
# How many names a reader of a grade looks at: of one mistake, and of two.
FEW, FEW_OF_PAIRS = 3, 4


def write_page(results: Results, mistakes: Sequence[Mistake], pairs: Sequence[tuple[Mistake, Mistake]]) -> None:
    """Replace the block between the two marks."""
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    _, after = rest.split(END)
    PAGE.write_text(f"{before}{BEGIN}{block(results, mistakes, pairs)}\n{END}{after}", encoding="utf-8")


def block(results: Results, mistakes: Sequence[Mistake], pairs: Sequence[tuple[Mistake, Mistake]]) -> str:
    """The counts, then a row for each submission that was measured."""
    told = results.told
    known = [it for it in mistakes if it.known_as and key_of((it,)) in told]
    unknown = [it for it in mistakes if not it.known_as and key_of((it,)) in told]
    both = [pair for pair in pairs if key_of(pair) in told]
    measured, every = len(known) + len(unknown) + len(both), len(mistakes) + len(pairs)
    lines = [f"Measured: {measured} of {every} submissions.", "", *summary(results, known, unknown, both)]
    lines += ["", "### One mistake", ""]
    lines += ["| mistake | in | points lost first | in the catalogue | told first | proved | place |"]
    lines += ["|---|---|---|---|---|--:|--:|"]
    lines += [_row(it, told[key_of((it,))]) for it in known]
    lines += ["", "### Mistakes that the catalogue lacks", ""]
    lines += [
        "| mistake | in | points lost first | told first | proved | said to be unknown |",
        "|---|---|---|---|--:|---|",
    ]
    lines += [_unknown_row(it, told[key_of((it,))]) for it in unknown]
    lines += ["", "### Two mistakes at once", ""]
    lines += ["| mistakes | in the catalogue | told | proved | places |", "|---|---|---|--:|--:|"]
    lines += [_pair_row(pair, told[key_of(pair)]) for pair in both]
    return "\n".join(lines)


def summary(
    results: Results, known: Sequence[Mistake], unknown: Sequence[Mistake], pairs: Sequence[tuple[Mistake, Mistake]]
) -> list[str]:
    """How many were told rightly, of how many."""
    told = results.told
    places = [place_of(it, told[key_of((it,))]) for it in known]
    right_topic = sum(is_lost_first(it, told[key_of((it,))]) for it in [*known, *unknown])
    said = sum(told[key_of((it,))].is_unknown for it in unknown)
    found = sum(max(places_of(pair, told[key_of(pair)])) <= FEW_OF_PAIRS for pair in pairs)
    return [
        "| what | how often |",
        "|---|--:|",
        f"| points are lost first in the topic of the mistake | {_share(right_topic, len(known) + len(unknown))} |",
        f"| the true fault is told first | {_share(sum(place == 1 for place in places), len(known))} |",
        f"| it is among the first three | {_share(sum(place <= FEW for place in places), len(known))} |",
        f"| a mistake that the catalogue lacks is said to be unknown | {_share(said, len(unknown))} |",
        f"| of two mistakes at once both are among the first four | {_share(found, len(pairs))} |",
    ]


def is_lost_first(mistake: Mistake, told: Told) -> bool:
    """Whether the first topic that lost points is that of the mistake, or none did where it is charged apart."""
    return next(iter(told.lost), None) == mistake.topic


def place_of(mistake: Mistake, told: Told) -> float:
    """Where the true name stands among those told, from 1; infinity where it does not."""
    return next((place for place, name in enumerate(told.names, start=1) if name in mistake.known_as), float("inf"))


def places_of(pair: tuple[Mistake, Mistake], told: Told) -> tuple[float, float]:
    """The places of both."""
    return place_of(pair[0], told), place_of(pair[1], told)


def _row(mistake: Mistake, told: Told) -> str:
    place = _number(place_of(mistake, told))
    lost, first, proved = _lost(mistake, told), _code(told.names[:1]), _proved(told)
    return f"| {mistake.name} | {mistake.language} | {lost} | {_known_as(mistake)} | {first} | {proved} | {place} |"


def _unknown_row(mistake: Mistake, told: Told) -> str:
    said = "yes" if told.is_unknown else "**no**"
    lost, first, proved = _lost(mistake, told), _code(told.names[:1]), _proved(told)
    return f"| {mistake.name} | {mistake.language} | {lost} | {first} | {proved} | {said} |"


def _pair_row(pair: tuple[Mistake, Mistake], told: Told) -> str:
    places = ", ".join(_number(place) for place in places_of(pair, told))
    known_as = " and ".join(_known_as(mistake) for mistake in pair)
    names = _code(told.names[:FEW_OF_PAIRS])
    return f"| {pair[0].name}; {pair[1].name} | {known_as} | {names} | {_proved(told)} | {places} |"


def _known_as(mistake: Mistake) -> str:
    return " or ".join(f"`{name}`" for name in sorted(mistake.known_as))


def _lost(mistake: Mistake, told: Told) -> str:
    first = told.lost[0] if told.lost else "none"
    return first if is_lost_first(mistake, told) else f"{first}, not {mistake.topic or 'none'}"


def _proved(told: Told) -> str:
    return f"{told.explained} of {told.looked_at}" if told.looked_at else "-"


def _code(names: Sequence[str]) -> str:
    return ", ".join(f"`{name}`" for name in names) or "-"


def _number(place: float) -> str:
    return "-" if place == float("inf") else str(int(place))


def _share(part: int, total: int) -> str:
    return f"{part} of {total} ({100 * part / max(1, total):.0f} %)"
