"""Reading what a child process wrote: it may be missing, truncated, or of another shape."""

from __future__ import annotations

import zipfile
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.records.renderings import RendererError

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray


def read_arrays(path: Path, shapes: Mapping[str, tuple[int, ...]], program: str) -> dict[str, NDArray[Any]]:
    """All arrays of an .npz file, those of `shapes` among them; raises RendererError, which names the program."""
    try:
        # NumPy leaves a file open that it opened by itself and that is no archive.
        with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            arrays = dict(archive)
    except (OSError, ValueError, EOFError, TypeError, zipfile.BadZipFile) as error:
        raise RendererError(f"{program}'s {path.name} cannot be read: {error}") from error
    for name, shape in shapes.items():
        if name not in arrays or arrays[name].shape != shape:
            raise RendererError(f"{program}'s {path.name} lacks {name} of shape {shape}")
    return arrays
