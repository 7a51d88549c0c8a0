"""What tells whether our own code has changed since a result was kept."""

from __future__ import annotations

import functools
import hashlib
from pathlib import Path


@functools.cache
def source_digest(*packages: str) -> str:
    """Of all Python files of these packages of ours, by their names."""
    digest = hashlib.sha256()
    for package in packages:
        for path in sorted((Path(__file__).parents[1] / package).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()
