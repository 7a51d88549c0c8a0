"""Where what takes long to make is kept from run to run. All of it can be made again: it may be deleted at any time."""

from __future__ import annotations

import os
from pathlib import Path

from platformdirs import user_cache_path


def cache_folder() -> Path:
    """$RAYTRUTH_CACHE, or the user's cache folder; it need not be there yet."""
    return Path(os.environ.get("RAYTRUTH_CACHE") or user_cache_path("raytruth"))
