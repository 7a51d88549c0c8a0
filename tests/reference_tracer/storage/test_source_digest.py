from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.reference_tracer.storage import source_digest as module
from raytruth.reference_tracer.storage.source_digest import files_digest, source_digest

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("ARI-6", "RES-3")

CODE = '''"""What it is about."""

ANSWER = 42  # found by thinking


def answer():
    """It is known."""
    return ANSWER, "the answer"
'''


def digest_of(folder: Path, text: str) -> str:
    path = folder / f"{abs(hash(text))}.py"
    path.write_text(text, encoding="utf-8")
    return files_digest([path])


def test_a_digest_is_the_same_again_and_another_for_other_rooms() -> None:
    assert source_digest("scenes") == source_digest.__wrapped__("scenes")
    assert len({source_digest("scenes"), source_digest("scenes", "reference_tracer"), source_digest("reports")}) == 3


def test_a_room_is_a_folder_without_those_in_it_or_one_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "ROOT", tmp_path)
    (tmp_path / "room" / "inner").mkdir(parents=True)
    for name in ("room/one.py", "room/inner/two.py", "room/three.txt"):
        (tmp_path / name).write_text("", encoding="utf-8")
    assert module.files_of_room("room") == [tmp_path / "room/one.py"]
    assert module.files_of_room("room/inner/two.py") == [tmp_path / "room/inner/two.py"]


@pytest.mark.parametrize("room", ["no such room", "scenes/library"])
def test_a_room_without_code_is_a_mistake(room: str) -> None:
    with pytest.raises(AssertionError, match="holds no code"):
        source_digest(room)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("  # found by thinking", ""),
        ("found by", "found without"),
        ("What it is about.", "What it was about."),
        ('    """It is known."""\n', ""),
        ("42  #", "42\n#"),
        ("return ANSWER,", "return (ANSWER),"),
    ],
)
def test_comments_docstrings_and_layout_do_not_count(old: str, new: str, tmp_path: Path) -> None:
    assert CODE.replace(old, new) != CODE
    assert digest_of(tmp_path, CODE.replace(old, new)) == digest_of(tmp_path, CODE)


@pytest.mark.parametrize(
    ("old", "new"), [("42", "43"), ("42", "42.0"), ("the answer", "an answer"), ("ANSWER,", "-ANSWER,")]
)
def test_numbers_sentences_and_operations_count(old: str, new: str, tmp_path: Path) -> None:
    assert digest_of(tmp_path, CODE.replace(old, new)) != digest_of(tmp_path, CODE)


def test_a_function_that_is_nothing_but_a_docstring_has_a_digest(tmp_path: Path) -> None:
    empty = 'def f():\n    """Nothing."""\n'
    assert digest_of(tmp_path, empty) != digest_of(tmp_path, f"{empty}    g()\n")
