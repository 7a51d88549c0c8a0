from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from raytruth.reference_tracer.storage import cache
from raytruth.reference_tracer.storage.cache import cache_folder, keep, named_cache_folder

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("ARI-6")


@pytest.fixture(autouse=True)
def nothing_told_yet() -> None:
    cache._usable.cache_clear()
    cache._told.cache_clear()


def test_the_users_folder_unless_another_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path / "elsewhere"))
    assert cache_folder() == named_cache_folder() == tmp_path / "elsewhere"
    for nowhere in ("", None):
        if nowhere is None:
            monkeypatch.delenv("RAYTRUTH_CACHE")
        else:
            monkeypatch.setenv("RAYTRUTH_CACHE", nowhere)
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
        assert cache_folder() == tmp_path / "raytruth"
        assert list(cache_folder().iterdir()) == []


def test_the_folder_of_a_kept_file_is_made(tmp_path: Path) -> None:
    path = tmp_path / "new" / "folder" / "file"
    keep(path, lambda file: file.write_bytes(b"kept"))
    assert path.read_bytes() == b"kept"
    assert list(path.parent.iterdir()) == [path]


def test_a_folder_that_cannot_be_written_is_replaced_for_this_process_and_those_it_starts(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path / "file" / "\x1b[31m"))
    substitute = cache_folder()
    assert (substitute.parent, substitute.is_dir()) == (tmp_path, True)
    assert os.environ["RAYTRUTH_CACHE"] == str(substitute)
    assert cache_folder() == substitute
    err = capsys.readouterr().err
    assert (err.count("\n"), "nothing is kept for the next run" in err, "\x1b" in err) == (1, True, False)


def test_what_cannot_be_kept_is_told_once_and_leaves_what_was_kept_before(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "folder" / "file"
    keep(path, lambda file: file.write_bytes(b"before"))

    def full(file: Path) -> None:
        file.write_bytes(b"half of it")
        raise OSError(28, "No space left on device")

    for _ in range(2):
        keep(path, full)
    assert path.read_bytes() == b"before"
    assert list(path.parent.iterdir()) == [path]
    assert capsys.readouterr().err.count("No space left on device") == 1
    (tmp_path / "taken").touch()
    keep(tmp_path / "taken" / "file", full)
    assert "File exists" in capsys.readouterr().err
