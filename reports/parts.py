"""The parts of a report beside its text, pictures and arrays: in files of a folder, or kept for one single page.

A part is named by its content, so that the truth of a scene is there once however many cells show it.
"""

from __future__ import annotations

import base64
import hashlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

FOLDER = "report"
"""What the folder of a report is called, beside its page."""

DIGITS = 24
"""Of the digest in a part's name: 96 bits, by which even a billion parts differ but for a chance of 1e-11."""


@dataclass
class Parts:
    """Where pictures and arrays go."""

    folder: Path | None = None
    """None: they are kept, for a page that holds everything itself."""
    kept: dict[str, bytes] = field(default_factory=dict)

    def add_picture(self, png: bytes) -> str:
        """Store a PNG and return its name, a path in the folder."""
        name = f"pictures/{_digest(png)}.png"
        self._store(name, png)
        return name

    def add_arrays(self, payload: str) -> str:
        """Store arrays in JSON that may stand in a script, and return their name, a path in the folder.

        In the folder they are a script, which a page that was opened from a file may load, too; it may load no data.
        """
        name = f"arrays/{_digest(payload.encode())}.js"
        script = payload if self.folder is None else f'raytruthArrays("{name}", {payload});\n'
        self._store(name, script.encode("ascii"))
        return name

    def _store(self, name: str, content: bytes) -> None:
        if self.folder is None:
            self.kept[name] = content
            return
        path = self.folder / name
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)

    def data_uri(self, name: str) -> str:
        """A kept picture as an address that holds its own content."""
        return "data:image/png;base64," + base64.b64encode(self.kept[name]).decode("ascii")


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:DIGITS]
