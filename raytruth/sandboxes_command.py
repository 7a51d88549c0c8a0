"""`raytruth sandboxes`."""

from __future__ import annotations

from raytruth.comparisons.attacks.ladder import tried
from raytruth.comparisons.sandboxes.sandbox import RUNGS
from raytruth.options import AsJson  # noqa: TC001 - cyclopts reads annotations at run time
from raytruth.output import print_json, progress, say
from raytruth.reports.sandbox_text import attack_words

FAILED = 1


def sandboxes(*, as_json: AsJson = False) -> int:
    """Try all attacks on each sandbox, and tell what held.

    Parameters
    ----------
    as_json
        Print one JSON document instead of text.
    """
    with progress("Attacking the sandboxes"):
        results = [tried(rung) for rung in RUNGS]
    if as_json:
        print_json({"sandboxes": [it.model_dump(mode="json") for it in results]})
    else:
        for result in results:
            say(f"{result.rung}: {'works' if result.works else f'cannot be used: {result.reason}'}")
            for attack in result.attacks:
                say(f"  {attack.attack}: {attack_words(attack)}")
    return 0 if any(it.works for it in results) else FAILED
