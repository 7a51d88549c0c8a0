"""Directives and parameters as pbrt-v4 reads them (src/pbrt/parser.cpp)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.exporters.comments import one_line

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    Value = str | bool | float | Iterable[float]
    """A string is text of ours without quotes or backslashes."""


def comment(text: str) -> str:
    """A comment of one line."""
    return f"# {one_line(text)}\n"


def directive(name: str, kind: str, parameters: Mapping[str, Value]) -> str:
    """A directive with the name of what it makes and its parameters; a parameter's key is its type and name."""
    lines = [f'{name} "{kind}"', *(f'    "{key}" {_written(value)}' for key, value in parameters.items())]
    return "\n".join(lines) + "\n"


def attributes(*directives: str) -> str:
    """A block at whose end pbrt forgets materials, lights and transformations that were set in it."""
    inner = "".join(directives).rstrip("\n").replace("\n", "\n    ")
    return f"AttributeBegin\n    {inner}\nAttributeEnd\n"


def numbers(values: Iterable[float]) -> str:
    """Numbers beside each other, printed so that they read back as the same."""
    return " ".join(repr(value) for value in values)


def _written(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    return f"[ {numbers((value,) if isinstance(value, float | int) else value)} ]"
