"""What tells whether our own code has changed since a result was kept."""

from __future__ import annotations

import functools
import hashlib
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

ROOT = Path(__file__).parents[2]
"""The package `raytruth`, which holds all others."""


@functools.cache
def source_digest(*packages: str, without: tuple[str, ...] = ()) -> str:
    """Of all Python files of these folders of ours, but for those in the folders `without`; all by paths from ROOT."""
    left_out = [ROOT / folder for folder in without]
    paths = [path for package in packages for path in sorted((ROOT / package).rglob("*.py"))]
    return files_digest(path for path in paths if not any(path.is_relative_to(folder) for folder in left_out))


def files_digest(paths: Iterable[Path]) -> str:
    """Of what these files hold, in this order."""
    digest = hashlib.sha256()
    for path in paths:
        digest.update(path.read_bytes())
    return digest.hexdigest()
