"""How problems are told: places, values and near misses, in one form everywhere."""

from __future__ import annotations

import difflib
import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

# A found text is quoted up to here, so that a sentence stays on a line.
LONGEST_QUOTE = 40


def quoted(text: str) -> str:
    """The text in quotes, shortened, with control characters and lone surrogates escaped."""
    shown = text if len(text) <= LONGEST_QUOTE else text[:LONGEST_QUOTE] + "…"
    return f"'{shown}'" if shown.isprintable() else json.dumps(shown)


def described(value: object) -> str:
    """A JSON value as a person would name it."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, Mapping):
        return "an object"
    if isinstance(value, Sequence):
        return f"a list of {len(value)}"
    return f"{value}"


def place(location: Iterable[str | int]) -> str:
    """A place in a scene file: `objects[3].radius`; keys that are no plain words are quoted."""
    text = ""
    for step in location:
        if isinstance(step, int):
            text += f"[{step}]"
        else:
            word = step if step.replace("-", "_").isidentifier() and len(step) <= LONGEST_QUOTE else quoted(step)
            text += f".{word}" if text else word
    return text or "the whole file"


def suggestion(word: str, known: Iterable[str]) -> str:
    """What may have been meant instead of an unknown word, or which words are known."""
    names = sorted(known)
    near = difflib.get_close_matches(word, names, n=3)
    if near:
        return "did you mean " + " or ".join(map(quoted, near)) + "?"
    return "known are " + ", ".join(map(quoted, names)) + "." if names else "there are none."
