"""Numbers, vectors and comments as POV-Ray's scene language writes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.exporters.comments import one_line

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


def vector(values: Iterable[float]) -> str:
    """A vector in POV-Ray's language, whose components read back as the same float64."""
    return f"<{', '.join(repr(float(value)) for value in values)}>"


def color(values: Sequence[float]) -> str:
    """A colour in POV-Ray's language, whose components read back as the same float64."""
    return f"rgb {vector(values)}"


def comment(text: str) -> str:
    """A comment of one line; the text is the scene author's and may hold what ends a line."""
    return f"// {one_line(text)}\n"


def block(keyword: str, *lines: str) -> str:
    """POV-Ray's `keyword { ... }` with these lines indented; on one line if there is only one."""
    if len(lines) == 1 and "\n" not in lines[0]:
        return f"{keyword} {{ {lines[0]} }}"
    inner = "\n".join(lines).replace("\n", "\n  ")
    return f"{keyword} {{\n  {inner}\n}}"
