"""What renderers told of their versions, kept as long as nothing has changed that a trial of them depends on.

A trial starts the renderer in a process of its own, which takes up to seconds. The kept answer is enough to show again
what is finished; before anything is rendered, the renderer is tried anew.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.comparisons.matrix.cell_key import adapter_digest
from raytruth.reference_tracer.certified_image import TRUTH_ROOMS
from raytruth.reference_tracer.storage.cache import cache_folder, keep
from raytruth.reference_tracer.storage.source_digest import source_digest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.renderers.protocol import Renderer

TRIAL_ROOMS = (
    *TRUTH_ROOMS,
    "comparisons/error_models",
    "comparisons/error_models/rasterisers",
    "comparisons/processes",
    "comparisons/records",
    "comparisons/renderers/protocol.py",
    "comparisons/sandboxes",
    "scenes/exporters/triangle_soup.py",
)
"""What a trial depends on beside the adapter: what adapters share, and the tracer, which is a renderer, too."""

# Debian writes these whenever it installs or removes a library; elsewhere at least the first of them is there.
SYSTEM_FILES = ("/etc/ld.so.cache", "/var/lib/dpkg/status")
# Variables of the dynamic loader, of Dr.Jit (where LLVM is), and of Mesa (which driver draws).
STEERING = ("LD_", "DRJIT_", "LIBGL_", "MESA_", "GALLIUM_", "EGL_", "__EGL_")


def kept_version(renderer: Renderer) -> str | None:
    """What `renderer.version()` gave here under the same circumstances; None where it was not asked."""
    try:
        circumstances, version = _file(renderer).read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError):
        return None
    return version if circumstances == _circumstances(renderer) else None


def tried_version(renderer: Renderer) -> str | None:
    """What `renderer.version()` gives now, which is kept.

    That a renderer is missing is not kept: a trial may have failed by chance.
    """
    version = renderer.version()
    if version is None:
        _file(renderer).unlink(missing_ok=True)
    else:
        text = f"{_circumstances(renderer)}\n{version}\n"
        keep(_file(renderer), lambda file: file.write_text(text, encoding="utf-8"))
    return version


def _file(renderer: Renderer) -> Path:
    return cache_folder() / "versions" / f"{renderer.name}.txt"


def _circumstances(renderer: Renderer) -> str:
    """A digest of what a trial depends on, as far as that can be told without one."""
    code = source_digest(*TRIAL_ROOMS)
    steering = sorted(item for item in os.environ.items() if item[0].startswith(STEERING))
    # A renderer that is a program has the program's name.
    files = map(Path, filter(None, (sys.executable, shutil.which(renderer.name), *SYSTEM_FILES)))
    parts = (code, adapter_digest(renderer), steering, *map(_stamp, files), *_installed_packages())
    return hashlib.sha256("\n".join(map(str, parts)).encode()).hexdigest()


def _installed_packages() -> Iterator[tuple[str, int, int] | None]:
    """Each with its version in its name, and with when it was installed."""
    for folder in filter(Path.is_dir, map(Path, sys.path)):
        yield from map(_stamp, sorted(folder.glob("*.dist-info")))


def _stamp(path: Path) -> tuple[str, int, int] | None:
    """What changes when the file or folder is written anew; None where there is none."""
    try:
        status = path.stat()
    except OSError:
        return None
    return str(path), status.st_size, status.st_mtime_ns
