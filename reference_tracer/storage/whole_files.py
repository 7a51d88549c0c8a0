"""Files that appear whole or not at all, whatever happens while they are written."""

from __future__ import annotations

import secrets
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@contextmanager
def unfinished_file(path: Path) -> Iterator[Path]:
    """A file under another name in the same folder, which gets its own name when the block ends well.

    Other processes may write the same file: the last one stays. What is broken off leaves an earlier file as it is.
    Raises OSError.
    """
    unfinished = path.with_name(f".{secrets.token_hex(8)}{path.suffix}")
    try:
        yield unfinished
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a text, in UTF-8, or bytes to a file that appears whole or not at all. Raises OSError."""
    with unfinished_file(path) as file:
        file.write_bytes(content.encode() if isinstance(content, str) else content)
