"""The arrays that a child process leaves: when they are read, they may be missing, truncated, or of another shape."""

from __future__ import annotations

import zipfile
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.records.renderings import RendererError
from raytruth.reference_tracer.storage.whole_files import unfinished_file

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray


def write_arrays(path: Path, arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write an .npz file, so that a process that is killed leaves none rather than half of one."""
    with unfinished_file(path) as file:
        np.savez(file, allow_pickle=False, **arrays)


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
