from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.reference_tracer.storage.cache import cache_folder, kept_file

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("ARI-6")


def test_the_users_folder_unless_another_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path / "elsewhere"))
    assert cache_folder() == tmp_path / "elsewhere"
    for nowhere in ("", None):
        if nowhere is None:
            monkeypatch.delenv("RAYTRUTH_CACHE")
        else:
            monkeypatch.setenv("RAYTRUTH_CACHE", nowhere)
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
        assert cache_folder() == tmp_path / "raytruth"


def test_the_folder_of_a_kept_file_is_made(tmp_path: Path) -> None:
    path = tmp_path / "new" / "folder" / "file"
    with kept_file(path) as file:
        file.write_bytes(b"kept")
    assert path.read_bytes() == b"kept"
    assert list(path.parent.iterdir()) == [path]
