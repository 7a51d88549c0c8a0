"""Where what takes long to make is kept from run to run. All of it can be made again: it may be deleted at any time."""

from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from platformdirs import user_cache_path

from raytruth.reference_tracer.storage.whole_files import unfinished_file

if TYPE_CHECKING:
    from collections.abc import Iterator


def cache_folder() -> Path:
    """$RAYTRUTH_CACHE, or the user's cache folder; it need not be there yet."""
    return Path(os.environ.get("RAYTRUTH_CACHE") or user_cache_path("raytruth"))


@contextmanager
def kept_file(path: Path) -> Iterator[Path]:
    """An `unfinished_file` in the cache, whose folder is made where it is missing. Raises OSError."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with unfinished_file(path) as file:
        yield file
