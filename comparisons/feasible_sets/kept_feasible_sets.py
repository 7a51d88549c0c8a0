"""Feasible sets, kept from run to run: they depend on a scene and an error model, not on what a renderer gave.

So whoever changes a renderer and runs the matrix again waits for the renderer only.
"""

from __future__ import annotations

import hashlib
import zipfile
import zlib
from dataclasses import fields
from typing import TYPE_CHECKING

import flint
import numpy as np

from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet, feasible_set
from raytruth.reference_tracer.certified_image import TRUTH_ROOMS, certified_image
from raytruth.reference_tracer.storage.cache import cache_folder, keep
from raytruth.reference_tracer.storage.source_digest import source_digest

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.scenes.scene import Scene

FEASIBLE_SET_ROOMS = (
    *TRUTH_ROOMS,
    "comparisons/error_models",
    "comparisons/error_models/rasterisers",
    "comparisons/feasible_sets",
    "comparisons/measures/visibility.py",
    "comparisons/records/srgb.py",  # of the output model, and of what is visible
    "scenes/exporters/triangle_soup.py",  # of rasterisers
)
"""What a feasible set depends on: the tracer that is evaluated, and what an error model does to it."""

DAMAGED = (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error)
"""What reading a file of the cache may raise."""


def kept_feasible_set(scene: Scene, error_model: ErrorModel, *, with_colors: bool = True) -> FeasibleSet:
    """The `feasible_set` from the cache, or made now if the scene, the error model or our code has changed since.

    There is one place in the cache for each scene's name and error model, so that it does not grow with each change.
    """
    key = feasible_set_key(scene)
    path = _file(scene, error_model, with_colors)
    kept = _read(path, key)
    if kept is None:
        truth = certified_image(scene, error_model.camera_rays) if with_colors else None
        kept = feasible_set(scene, error_model, truth=truth, with_colors=with_colors)
        _write(path, key, kept)
    return kept


def has_feasible_set(scene: Scene, error_model: ErrorModel, *, with_colors: bool = True) -> bool:
    """Whether `kept_feasible_set` finds it in the cache, as far as can be told without reading all of it."""
    try:
        with _file(scene, error_model, with_colors).open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            return str(arrays["key"]) == feasible_set_key(scene)
    except DAMAGED:
        return False


def feasible_set_key(scene: Scene) -> str:
    """A digest of all that the feasible sets of a scene depend on but the error model, which is in the file's name."""
    code = source_digest(*FEASIBLE_SET_ROOMS)
    return _digest(scene.model_dump_json(), code, flint.__version__, flint.__FLINT_VERSION__, np.__version__)


def _file(scene: Scene, error_model: ErrorModel, with_colors: bool) -> Path:
    return cache_folder() / "feasible" / f"{_digest(scene.name, repr(error_model), str(with_colors))}.npz"


def _digest(*parts: str) -> str:
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


def _write(path: Path, key: str, feasible: FeasibleSet) -> None:
    """Most places for outcomes are unused, which compresses well."""
    arrays = {field.name: getattr(feasible, field.name) for field in fields(FeasibleSet)}
    keep(path, lambda file: np.savez_compressed(file, allow_pickle=False, key=np.array(key), **arrays))


def _read(path: Path, key: str) -> FeasibleSet | None:
    """None if there is none of this key, or if its file is damaged."""
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            if str(arrays["key"]) != key:
                return None
            return FeasibleSet(**{field.name: arrays[field.name] for field in fields(FeasibleSet)})
    except DAMAGED:
        return None
