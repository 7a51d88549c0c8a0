from __future__ import annotations

import os
from contextlib import ExitStack
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.processes.removal import remove
from raytruth.comparisons.sandboxes import user_ids
from raytruth.comparisons.sandboxes.folder_entries import entries_below
from raytruth.comparisons.sandboxes.sandbox import SandboxError, is_root
from raytruth.comparisons.sandboxes.user_ids import FIRST, LAST, give, reserved_user

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SBX-2")


def test_two_programs_at_once_have_two_users_and_an_id_is_free_again_afterwards(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with reserved_user() as first, reserved_user() as second:
        assert FIRST <= first <= LAST
        assert first != second
        monkeypatch.setattr(user_ids, "FIRST", first)
        monkeypatch.setattr(user_ids, "LAST", first)
        with pytest.raises(SandboxError, match="are in use"), reserved_user():
            pass
    with reserved_user() as again:
        assert again == first


def test_many_at_once_all_differ() -> None:
    with ExitStack() as stack:
        users = [stack.enter_context(reserved_user()) for _ in range(20)]
    assert len(set(users)) == 20


def test_a_folder_is_given_with_all_in_it_but_for_what_others_may_own(tmp_path: Path) -> None:
    """An ordinary user can give it to nobody but themselves, which does as little harm."""
    user = FIRST if is_root() else os.getuid()
    folder = tmp_path / "given"
    (folder / "deep").mkdir(parents=True)
    outside, secret = tmp_path / "outside", tmp_path / "secret"
    outside.write_text("mine")
    secret.write_text("mine")
    (folder / "deep" / "scene.json").write_text("{}")
    (folder / "hard").hardlink_to(outside)
    (folder / "soft").symlink_to(secret)
    give(folder, user)
    assert {path.lstat().st_uid for path in (folder, folder / "deep", folder / "deep" / "scene.json")} == {user}
    assert {path.stat().st_uid for path in (outside, secret)} == {os.getuid()}
    assert folder.stat().st_mode & 0o777 == 0o700


@pytest.mark.clause("SBX-4")
def test_folders_of_any_depth_are_looked_through_without_recursion(tmp_path: Path) -> None:
    depth = 1500
    folder = os.open(tmp_path, os.O_RDONLY)
    for _ in range(depth):
        os.mkdir("d", dir_fd=folder)
        inner = os.open("d", os.O_RDONLY, dir_fd=folder)
        os.close(folder)
        folder = inner
    os.close(folder)
    deepest = max(level for level, _ in entries_below(tmp_path))
    remove(tmp_path / "d")  # pytest cannot
    assert deepest == depth
