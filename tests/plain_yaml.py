"""Reads the plain part of YAML that workflow files need; no library for YAML is among what we install.

Mappings and lists by indentation, texts with or without double quotes, comments, and literal blocks (`|`). What is
beyond that is an error, never a guess.
"""

from __future__ import annotations

import re
from textwrap import dedent
from typing import Any

_KEY = re.compile(r"([A-Za-z_][\w-]*):(?: +(.+))?")
# A text without quotes that begins so would mean something else than its letters.
_BEYOND = tuple("&*!>%@`{[]}'\"|,?-#")


def read_yaml(text: str) -> Any:
    """The document: dictionaries, lists, texts, and None for what is empty. Raises ValueError for any other YAML."""
    lines = [line for line in text.splitlines() if not line.lstrip().startswith("#")]
    value, at = _node(lines, _next(lines, 0), 0)
    if at != len(lines):
        raise ValueError(f"expected the end, found {lines[at]!r}")
    return value


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _next(lines: list[str], at: int) -> int:
    """The first line from there on that is not empty."""
    return next((number for number in range(at, len(lines)) if lines[number].strip()), len(lines))


def _node(lines: list[str], at: int, indent: int) -> tuple[Any, int]:
    """What begins in a line, all of whose lines are indented so or more, and the number of the line behind it."""
    items: list[Any] = []
    mapping: dict[str, Any] = {}
    while at < len(lines) and _indent(lines[at]) == indent:
        content = lines[at].strip()
        match = _KEY.fullmatch(content)
        if content.startswith("- "):
            lines[at] = " " * (indent + 2) + content[2:]
            item, at = _node(lines, at, indent + 2)
            items.append(item)
        elif match is None:
            return _text(content), _next(lines, at + 1)
        elif match[1] in mapping:
            raise ValueError(f"the key {match[1]} stands twice")
        else:
            mapping[match[1]], at = _value(lines, at, indent, match[2])
    if items and mapping:
        raise ValueError(f"a list and keys are mixed before line {at}")
    return items or mapping, at


def _value(lines: list[str], at: int, indent: int, told: str | None) -> tuple[Any, int]:
    """What a key has, in its own line or below it."""
    if told == "|":
        end = next(
            (n for n in range(at + 1, len(lines)) if lines[n].strip() and _indent(lines[n]) <= indent), len(lines)
        )
        return dedent("\n".join(lines[at + 1 : end])).strip("\n") + "\n", end
    following = _next(lines, at + 1)
    if told is not None:
        return _text(told), following
    if following < len(lines) and _indent(lines[following]) > indent:
        return _node(lines, following, _indent(lines[following]))
    return None, following


def _text(told: str) -> str:
    if match := re.fullmatch(r'"([^"\\]*)"', told):
        return match[1]
    if told.startswith(_BEYOND) or re.search(r": | #|:$", told):
        raise ValueError(f"expected a plain text, found {told!r}")
    return told
