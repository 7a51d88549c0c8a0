"""Where what takes long to make is kept from run to run. All of it can be made again: it may be deleted at any time."""

from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import IO, TYPE_CHECKING

from platformdirs import user_cache_path

if TYPE_CHECKING:
    from collections.abc import Iterator


def cache_folder() -> Path:
    """$RAYTRUTH_CACHE, or the user's cache folder; it need not be there yet."""
    return Path(os.environ.get("RAYTRUTH_CACHE") or user_cache_path("raytruth"))


@contextmanager
def written_whole(path: Path) -> Iterator[IO[bytes]]:
    """A file to write to, which gets its name only when it is whole; its folder is made where it is missing.

    Other processes may write the same file: the last one stays.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}-", delete=False) as file:
        unfinished = Path(file.name)
        try:
            yield file
            file.flush()
            unfinished.replace(path)
        finally:
            unfinished.unlink(missing_ok=True)
