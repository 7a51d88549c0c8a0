"""Text of a scene's author in comments, where it must not end the comment."""

from __future__ import annotations


def one_line(text: str) -> str:
    """The text on one line: what cannot be printed, such as the end of a line, becomes a space."""
    return "".join(c if c.isprintable() else " " for c in text)
