from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.reference_tracer.storage.whole_files import unfinished_file, write_whole

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("ARI-6")


def test_a_file_gets_its_name_when_it_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "file.txt"
    for content in (b"one", b"two"):
        before = path.read_bytes() if path.exists() else None
        with unfinished_file(path) as file:
            file.write_bytes(content)
            assert (path.read_bytes() if path.exists() else None) == before
        assert path.read_bytes() == content
    assert list(path.parent.iterdir()) == [path]


def test_the_unfinished_file_has_the_ending_that_libraries_ask_for(tmp_path: Path) -> None:
    path = tmp_path / "arrays.npz"
    with unfinished_file(path) as file:
        np.savez(file, allow_pickle=False, one=np.ones(3))
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("content", ["η = 3/2\n", b"\x00\xff"])
def test_texts_and_bytes_are_written_as_they_are(tmp_path: Path, content: str | bytes) -> None:
    write_whole(tmp_path / "file", content)
    assert (tmp_path / "file").read_bytes() == (content.encode() if isinstance(content, str) else content)


def test_others_may_read_what_is_written_as_far_as_the_user_lets_them(tmp_path: Path) -> None:
    before = os.umask(0o022)
    try:
        write_whole(tmp_path / "file", "for all")
    finally:
        os.umask(before)
    assert (tmp_path / "file").stat().st_mode & 0o777 == 0o644


def break_off(path: Path, error: type[BaseException]) -> None:
    with unfinished_file(path) as file:
        file.write_bytes(b"half")
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
