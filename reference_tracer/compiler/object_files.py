"""Object files kept on disk, so that a kernel is compiled once a machine.

A file's name is a digest of all that it depends on. It begins with a digest of its content, since LLVM would read
beyond the end of a file that is damaged: such a file counts as none, and is made again.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

from raytruth.reference_tracer.storage.cache import cache_folder, keep

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path


def kept_object(parts: Iterable[str], make: Callable[[], bytes]) -> bytes:
    """The object file that depends on these parts, from the cache or else made. Raises what `make` raises."""
    path = cache_folder() / "kernels" / f"{hashlib.sha256(chr(0).join(parts).encode()).hexdigest()[:32]}.o"
    found = _read(path)
    if found is None:
        found = make()
        content = hashlib.sha256(found).digest() + found
        keep(path, lambda file: file.write_bytes(content))
    return found


def _read(path: Path) -> bytes | None:
    """The object file; None if it is not there, or is not as it was written."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    size = hashlib.sha256().digest_size
    digest, found = content[:size], content[size:]
    return found if hashlib.sha256(found).digest() == digest else None
