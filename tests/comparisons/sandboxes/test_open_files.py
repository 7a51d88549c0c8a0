from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.sandboxes import open_files
from raytruth.comparisons.sandboxes.open_files import is_open_to_others, opened
from raytruth.comparisons.sandboxes.sandbox import SandboxError

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SBX-3")


@pytest.fixture
def closed(tmp_path: Path) -> Path:
    folder = tmp_path / "anna's own"
    (folder / "deep").mkdir(parents=True)
    (folder / "tracer").write_text("#!/bin/sh\n")
    (folder / "tracer").chmod(0o700)
    (folder / "deep" / "data").write_text("1")
    (folder / "deep" / "data").chmod(0o600)
    (tmp_path / "secret").write_text("the grader's")
    (folder / "link").symlink_to(tmp_path / "secret")
    folder.chmod(0o700)
    return folder


def test_an_ordinary_user_shows_the_files_themselves(closed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(open_files, "is_root", lambda: False)
    with opened([closed]) as names:
        assert names == ((closed, closed),)


def test_root_shows_a_copy_of_what_is_closed_to_others_which_goes_afterwards(
    closed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(open_files, "is_root", lambda: True)
    assert not is_open_to_others(closed)
    with opened([closed / "tracer", closed / "deep", closed / "link"]) as names:
        copies = dict(names)
        assert all(is_open_to_others(copies[path]) for path in (closed / "tracer", closed / "deep"))
        assert (copies[closed / "tracer"]).stat().st_mode & 0o777 == 0o755
        assert (copies[closed / "deep"] / "data").read_text() == "1"
        assert copies[closed / "deep"].parent == copies[closed / "tracer"].parent
        assert not copies[closed / "tracer"].is_relative_to(closed)
    assert not any(path.exists() for path in copies.values())
    assert (closed / "tracer").stat().st_mode & 0o777 == 0o700


def test_a_copy_of_a_folder_holds_no_file_that_a_link_leads_to(closed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(open_files, "is_root", lambda: True)
    with opened([closed]) as ((_, copy),):
        assert (copy / "link").is_symlink()


def test_what_is_too_large_to_be_copied_is_refused_in_a_sentence(closed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(open_files, "is_root", lambda: True)
    monkeypatch.setattr(open_files, "_MOST_FILES", 2)
    with pytest.raises(SandboxError, match=r"let others read it \(chmod"), opened([closed]):
        pass
