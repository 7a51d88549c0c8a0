from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.classes.exports import given_name, submissions_in

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CLA-1")

# As Gradescope writes it: a list item of symbols for each submitter.
METADATA = """---
submission_11:
  :submitters:
  - :name: Ada Lovelace
    :sid: '1815'
    :email: ada@example.edu
  - :name: Charles Babbage
    :sid:
    :email: charles@example.edu
  :created_at: 2026-11-01 10:00:00 Z
  :history:
  - :name: nobody
submission_12:
  :submitters:
  - :name: "Grace Hopper"
    :sid: "1906"
    :email: grace@example.edu
"""


def made(folder: Path, *names: str) -> Path:
    """A folder with empty files of these names, and folders of those that end in a slash."""
    for name in names:
        path = folder / name
        (path if name.endswith("/") else path.parent).mkdir(parents=True, exist_ok=True)
        if not name.endswith("/"):
            path.touch()
    return folder


def facts(folder: Path) -> list[tuple[str, str, str, list[str]]]:
    return [(it.student, it.identifier, it.email, [p.name for p in it.paths]) for it in submissions_in(folder)]


def test_a_plain_folder_has_a_submission_for_each_folder_and_archive(tmp_path: Path) -> None:
    made(tmp_path, "ada/tracer.py", "ben.zip", "cleo.tar.gz", "dan.bundle", "notes.txt", ".hidden/a", "__MACOSX/a")
    assert [it[0] for it in facts(tmp_path)] == ["ada", "ben", "cleo", "dan"]


def test_gradescopes_export_has_names_and_numbers_of_all_submitters(tmp_path: Path) -> None:
    export = made(tmp_path / "assignment_1_export", "submission_11/a.py", "submission_12/a.py", "submission_13/a.py")
    (export / "submission_metadata.yml").write_text(METADATA)
    expected = [
        ("Ada Lovelace, Charles Babbage", "1815", "ada@example.edu, charles@example.edu", ["submission_11"]),
        ("Grace Hopper", "1906", "grace@example.edu", ["submission_12"]),
        ("submission_13", "submission_13", "", ["submission_13"]),
    ]
    assert facts(export) == expected
    assert facts(tmp_path) == expected  # as unpacked from its archive


def test_moodles_export_has_a_folder_or_files_for_each_student(tmp_path: Path) -> None:
    made(tmp_path / "a", "Ada Lovelace_101_assignsubmission_file_/t.py", "Ben_102_assignsubmission_file/t.py")
    assert facts(tmp_path / "a") == [
        ("Ada Lovelace", "101", "", ["Ada Lovelace_101_assignsubmission_file_"]),
        ("Ben", "102", "", ["Ben_102_assignsubmission_file"]),
    ]
    made(tmp_path / "b", "Ada_101_assignsubmission_file_my_t.zip", "Ada_101_assignsubmission_file_read.me")
    (ada,) = submissions_in(tmp_path / "b")
    assert (ada.student, ada.identifier) == ("Ada", "101")
    assert [given_name(ada, path) for path in ada.paths] == ["my_t.zip", "read.me"]


def test_canvas_names_files_after_students_late_or_not(tmp_path: Path) -> None:
    made(tmp_path, "lovelaceada_7_501_tracer.zip", "lovelaceada_7_502_my_notes.txt", "hopper_LATE_8_503_t.py")
    hopper, ada = submissions_in(tmp_path)
    assert (ada.student, ada.identifier, hopper.student, hopper.identifier) == ("lovelaceada", "7", "hopper", "8")
    assert [given_name(ada, path) for path in ada.paths] == ["tracer.zip", "my_notes.txt"]


def test_github_classrooms_clones_are_named_by_their_users(tmp_path: Path) -> None:
    folder = made(tmp_path / "tracer-submissions", "tracer-ada/.git/", "tracer-ben-x/.git/")
    assert [(it.student, it.identifier) for it in submissions_in(folder)] == [("ada", "ada"), ("ben-x", "ben-x")]


@pytest.mark.parametrize("text", ["", "submission_11:\n  :submitters:\n  - :name\n", "\x00" * 10, "- :name: x\n" * 99])
def test_metadata_that_is_none_leaves_the_folders_names(text: str, tmp_path: Path) -> None:
    made(tmp_path, "submission_11/a.py")
    (tmp_path / "submission_metadata.yml").write_text(text)
    assert [it.student for it in submissions_in(tmp_path)] == ["submission_11"]


def test_names_of_any_bytes_and_lengths_become_text_that_can_be_written(tmp_path: Path) -> None:
    (tmp_path / os.fsdecode(b"ada\xff")).mkdir()
    assert [it.student for it in submissions_in(tmp_path)] == ["ada\ufffd"]
    (tmp_path / "x" / "submission_1").mkdir(parents=True)
    name = "n" * 1_000_000
    metadata = f"submission_1:\n  :submitters:\n  - :name: {name}\n"
    (tmp_path / "x" / "submission_metadata.yml").write_text(metadata)
    (long,) = submissions_in(tmp_path / "x")
    assert len(long.student) == 400
