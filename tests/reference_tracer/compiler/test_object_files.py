"""Kept object files serve again; one that is damaged, or for another processor, is made anew."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.reference_tracer.compiler import compilation, object_files
from raytruth.reference_tracer.compiler.machine_code import processor
from tests.reference_tracer.compiler.programs import NUMBER, NUMBERS, compiled

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

pytestmark = pytest.mark.clause("ARI-12", "ARI-6")

TEXT = "def run(a, results):\n    results[0] = a * a"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path))
    return tmp_path / "kernels"


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The modules that LLVM has compiled."""
    modules: list[str] = []
    compile_module = compilation.object_code

    def noted(ir_text: str) -> bytes:
        modules.append(ir_text)
        return compile_module(ir_text)

    monkeypatch.setattr(compilation, "object_code", noted)
    return modules


def square(value: float, text: str = TEXT) -> float:
    results = np.zeros(1)
    compiled(text, NUMBER, NUMBERS)(value, results)
    return float(results[0])


def test_what_was_compiled_is_compiled_no_second_time(folder: Path, made: list[str]) -> None:
    assert square(3.0) == square(-3.0) == 9.0
    assert len(made) == len(list(folder.iterdir())) == 1


def test_another_text_is_another_file(folder: Path, made: list[str]) -> None:
    assert square(3.0) == 9.0
    assert square(3.0, TEXT.replace("*", "+")) == 6.0
    assert len(made) == len(list(folder.iterdir())) == 2


DAMAGES: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda _: b"",
    "cut off": lambda content: content[: len(content) // 2],
    "a digest alone": lambda content: content[:32],
    "one bit": lambda content: content[:-7] + bytes([content[-7] ^ 1]) + content[-6:],
    "something else": lambda _: b"something else, which is long enough to hold a digest of 32 bytes",
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_a_damaged_file_is_made_again(damage: Callable[[bytes], bytes], folder: Path, made: list[str]) -> None:
    square(3.0)
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    assert square(3.0) == 9.0
    assert len(made) == 2
    assert file.read_bytes() == whole


def test_another_processor_or_version_has_files_of_its_own(
    folder: Path, made: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    square(3.0)
    for place in range(len(processor())):
        other = [*processor()]
        other[place] += " of another kind"
        monkeypatch.setattr(compilation, "processor", lambda other=other: tuple(other))
        square(3.0)
    assert len(made) == len(list(folder.iterdir())) == 1 + len(processor())


SCRIPT = f"""
from tests.reference_tracer.compiler.test_object_files import square
for count in range(40):
    text = {TEXT!r} + f" + {{count}}.0"
    assert square(3.0, text) == 9.0 + count
"""


def test_two_processes_at_once_do_not_disturb_each_other(folder: Path) -> None:
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    runs = [subprocess.Popen([sys.executable, "-c", SCRIPT], env=environment) for _ in range(2)]
    assert [run.wait(timeout=120) for run in runs] == [0, 0]
    assert len(list(folder.iterdir())) == 40
    assert all(object_files._read(file) is not None for file in folder.iterdir())


def test_where_nothing_can_be_kept_code_runs_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(object_files, "keep", lambda _path, _write: None)
    assert square(3.0) == 9.0
