from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.processes.worker_results import read_arrays
from raytruth.comparisons.records.renderings import RendererError

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REN-1")


def test_arrays_are_read_whole(tmp_path: Path) -> None:
    np.savez(tmp_path / "result.npz", image=np.ones((2, 3)), note=np.array("x"))
    assert set(read_arrays(tmp_path / "result.npz", {"image": (2, 3)}, "It")) == {"image", "note"}


@pytest.mark.parametrize("shapes", [{"image": (3, 2)}, {"depth": ()}])
def test_a_missing_array_or_another_shape_is_named(shapes: dict[str, tuple[int, ...]], tmp_path: Path) -> None:
    np.savez(tmp_path / "result.npz", image=np.ones((2, 3)))
    with pytest.raises(RendererError, match=r"^It's result\.npz lacks (image|depth) of shape"):
        read_arrays(tmp_path / "result.npz", shapes, "It")


def test_what_is_no_archive_is_an_error_wherever_it_is_cut(tmp_path: Path) -> None:
    path = tmp_path / "result.npz"
    np.savez(path, image=np.arange(6.0))
    whole = path.read_bytes()
    for length in range(len(whole)):
        path.write_bytes(whole[:length])
        with pytest.raises(RendererError, match="cannot be read"):
            read_arrays(path, {}, "It")


def test_a_missing_file_one_array_and_pickled_objects_are_errors(tmp_path: Path) -> None:
    np.save(tmp_path / "one.npy", np.ones(3))
    np.savez(tmp_path / "objects.npz", image=np.array([{}], dtype=object))
    for name in ("missing.npz", "one.npy", "objects.npz"):
        with pytest.raises(RendererError, match="cannot be read"):
            read_arrays(tmp_path / name, {}, "It")
