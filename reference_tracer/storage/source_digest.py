"""What tells whether our own code has changed since a result was kept.

What is kept from run to run names the rooms that it depends on: folders of our code, each without the folders in it, or
single files. A change elsewhere leaves it valid, and so does one of comments, docstrings or line breaks.
"""

from __future__ import annotations

import ast
import functools
import hashlib
import threading
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

ROOT = Path(__file__).parents[2]
"""The package `raytruth`, which holds all others."""
# Renderers are tried in threads. Python 3.11 counts the depth of a syntax tree for all threads together, and raises
# SystemError where two of them make one at a time.
_PARSING = threading.Lock()


@functools.cache
def source_digest(*rooms: str) -> str:
    """A digest of what the code in these rooms says.

    Rooms are paths from ROOT: of folders, as `scenes`, or of files, as `comparisons/renderers/protocol.py`.
    """
    return files_digest(path for room in rooms for path in files_of_room(room))


def files_of_room(room: str) -> list[Path]:
    """The Python files right in a folder, or the one file."""
    place = ROOT / room
    files = [place] if place.suffix == ".py" else sorted(place.glob("*.py"))
    assert files, f"{place} holds no code"
    return files


def files_digest(paths: Iterable[Path]) -> str:
    """A digest of what the code in these files says, in this order."""
    digest = hashlib.sha256()
    for path in paths:
        digest.update(_statements(path).encode())
    return digest.hexdigest()


@functools.cache
def _statements(path: Path) -> str:
    """The syntax tree in words, which knows nothing of comments, without docstrings."""
    with _PARSING:
        module = ast.parse(path.read_bytes())
    for node in ast.walk(module):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node, clean=False):
            node.body.pop(0)
    return ast.dump(module)
