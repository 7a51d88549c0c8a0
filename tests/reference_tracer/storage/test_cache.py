from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.reference_tracer.storage.cache import cache_folder, written_whole

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


def test_a_file_gets_its_name_when_it_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "new" / "file"
    for content in (b"one", b"two"):
        before = path.read_bytes() if path.exists() else None
        with written_whole(path) as file:
            file.write(content[:1])
            file.flush()
            assert (path.read_bytes() if path.exists() else None) == before
            file.write(content[1:])
        assert path.read_bytes() == content
    assert list(path.parent.iterdir()) == [path]


def break_off(path: Path, error: type[BaseException]) -> None:
    with written_whole(path) as file:
        file.write(b"half")
        raise error


@pytest.mark.parametrize("error", [OSError, KeyboardInterrupt])
def test_what_is_broken_off_leaves_the_earlier_file_and_nothing_else(
    tmp_path: Path, error: type[BaseException]
) -> None:
    path = tmp_path / "file"
    path.write_bytes(b"earlier")
    with pytest.raises(error):
        break_off(path, error)
    assert path.read_bytes() == b"earlier"
    assert list(tmp_path.iterdir()) == [path]
