from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from raytruth.comparisons.renderers.program.command import (
    MOST_LOOKED_AT,
    counted_files,
    filled_command,
    missing_program,
    named_files,
)

pytestmark = pytest.mark.clause("REN-8")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """With a program, a file of data, and a folder that holds a file."""
    folder = tmp_path / "a b"
    (folder / "lib").mkdir(parents=True)
    for name in ("tracer", "data", "lib/part"):
        (folder / name).write_text(name)
    (folder / "tracer").chmod(0o755)
    return folder


def test_words_that_name_files_get_absolute_paths_and_no_others(folder: Path) -> None:
    command = ["./tracer", "data", "./lib", "lib", "none", "-x", "", "{scene}", "--out={output}", "{width}x{width}"]
    values = {"scene": "/s {output}.json", "output": "/o.exr", "width": 7}
    assert filled_command(command, folder, {}, values) == [
        *(str(folder / "tracer"), str(folder / "data"), str(folder / "lib")),
        *("lib", "none", "-x", "", "/s {output}.json", "--out=/o.exr", "7x7"),
    ]


def test_a_program_without_a_slash_is_looked_for_on_the_path(folder: Path) -> None:
    assert filled_command(["sh", "tracer"], folder, {}, {})[0] == shutil.which("sh")
    path = {"PATH": str(folder)}
    assert filled_command(["tracer"], folder, path, {})[0] == str(folder / "tracer")
    assert missing_program(["tracer"], folder, path) is None


def test_a_program_that_is_not_there_is_told_with_what_to_do(folder: Path) -> None:
    assert missing_program(["./tracer"], folder, {}) is None
    assert missing_program([], folder, {}) is None
    for word, expected in {
        "tracer": "did you mean './tracer'?",
        "no-such-program": "install it, or give its path.",
        "./none": f"found none at {folder / 'none'}; build it first.",
        "./data": "may not be executed; chmod +x it.",
    }.items():
        assert str(missing_program([word], folder, {})).endswith(expected)


@pytest.mark.clause("REN-10")
def test_the_files_of_a_command_are_those_that_its_words_name_also_in_folders(folder: Path) -> None:
    command = ["./tracer", "data", "./lib", "lib", "none", "", "{scene}"]
    assert named_files(command, folder, {}) == [folder / "tracer", folder / "data", folder / "lib" / "part"]
    assert named_files(["./none", "data"], folder, {}) == [folder / "data"]


@pytest.fixture
def package(folder: Path) -> Path:
    """The folder with a script that imports others, and with what it does not."""
    (folder / ".venv").mkdir()
    for name in ("tracer.py", "scene.py", "lib/shapes.py", "lib/noise.glsl", ".venv/other.py", "notes.md"):
        (folder / name).write_text(name)
    return folder


@pytest.mark.clause("REN-10")
def test_a_script_counts_with_all_of_its_kind_beside_it_and_below(package: Path) -> None:
    of_script = counted_files(["sh", "tracer.py", "{scene}"], package, {}, None)
    beside = [package / name for name in ("tracer.py", "lib/shapes.py", "scene.py")]
    assert of_script == [Path(str(shutil.which("sh"))), *beside]
    assert counted_files(["./tracer", "{scene}"], package, {}, None) == [package / "tracer"]


@pytest.mark.clause("REN-10")
def test_patterns_say_what_else_counts_in_place_of_that(package: Path) -> None:
    counted = counted_files(["./tracer"], package, {}, ["lib/*.glsl", "**/s*.py"])
    assert counted == [package / name for name in ("tracer", "lib/noise.glsl", "lib/shapes.py", "scene.py")]
    assert counted_files(["sh", "tracer.py"], package, {}, [])[1:] == [package / "tracer.py"]


@pytest.mark.clause("REN-10")
def test_nobody_looks_through_a_whole_disk(package: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert MOST_LOOKED_AT > 1000
    monkeypatch.setattr("raytruth.comparisons.renderers.program.command.MOST_LOOKED_AT", 5)
    assert counted_files(["sh", "tracer.py"], package, {}, None)[1:] == [package / "tracer.py"]
