"""`raytruth scenes coverage`."""

from __future__ import annotations

from typing import Any

from raytruth.options import AsJson  # noqa: TC001 - the command line reads annotations at run time
from raytruth.output import print_json, print_table, progress, say
from raytruth.scenes.coverage import sayings
from raytruth.scenes.pair_coverage import Coverage, coverage

HOLE = 1


def scenes_coverage(*, as_json: AsJson = False) -> int:
    """Show what the scene format can say that no scene says: holes through which a mistake slips unseen.

    Counted are keys that are set to something other than their default, and alternatives, each in how many scenes of
    the library; and pairs of them, in the library and in the family `language`, which draws scenes for the others
    (`raytruth run --families`). Exit status 1 if there is a hole.

    Example: `raytruth scenes coverage`

    Parameters
    ----------
    as_json
        Print one JSON document instead of text.
    """
    with progress("Reading the scenes"):
        found = coverage()
    if as_json:
        print_json(_document(found))
    else:
        _show(found)
    return HOLE if found.holes or found.pair_holes else 0


def _document(found: Coverage) -> dict[str, Any]:
    return {
        "sayings": [
            {"saying": saying, "library": found.by_library[saying], "family": found.by_family[saying]}
            for saying in sayings()
        ],
        "pairs": found.pairs,
        "pairs_only_in_family": found.only_in_family,
        "pairs_not_needed": dict(found.impossible),
        "holes": list(found.holes),
        "pair_holes": [list(pair) for pair in found.pair_holes],
    }


def _show(found: Coverage) -> None:
    rows = [(saying, str(found.by_library[saying]), str(found.by_family[saying])) for saying in sayings()]
    print_table(("What a scene can say", "scenes of the library", "of the family"), rows)
    say(f"{found.pairs} pairs can be said together; {found.only_in_family} of them only the family `language` says.")
    for reason, count in found.impossible.items():
        say(f"{count} more pairs need not be: {reason}.")
    for saying in found.holes:
        say(f"hole: no scene of the library says that {saying}")
    for one, other in found.pair_holes:
        say(f"hole: no scene says both that {one} and that {other}")
    if not (found.holes or found.pair_holes):
        say("No hole.")
