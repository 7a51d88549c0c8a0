from __future__ import annotations

import io
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.raytruth.running import run

pytestmark = pytest.mark.clause("CMD-1", "CMD-4", "ORA-3")

PAGE = (Path(__file__).parents[2] / "docs" / "oracle.md").read_text(encoding="utf-8")
GOOD = b'{"ask": "reflect", "direction": [1, -2, 0.5], "normal": [0, 1, 0]}\n'


@pytest.fixture
def given_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    """A good line, a bad one and a good one on standard input."""
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(GOOD + b"{\n" + GOOD)))


@pytest.mark.usefixtures("given_lines")
def test_lines_are_answered_and_a_bad_one_makes_the_status_2(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, "oracle")
    answers = [json.loads(line) for line in out.splitlines()]
    assert status == 2
    assert ["error" in answer for answer in answers] == [False, True, False]
    assert answers[0]["truth"]["direction"][1]["middle"] == 2.0
    assert err == ""


def test_all_good_lines_are_status_0_and_the_schema_is_printed(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(GOOD)))
    assert run(capsys, "oracle")[0] == 0
    status, out, _ = run(capsys, "oracle", "--schema")
    assert status == 0
    assert json.loads(out)["title"] == "raytruth oracle"


@pytest.mark.clause("CMD-4")
def test_the_example_of_the_help_is_one_that_works(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    _, out, _ = run(capsys, "oracle", "--help")
    assert "raytruth oracle" in out
    (question,) = re.findall(r"echo '(.*)' \| raytruth oracle", PAGE)
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(question.encode())))
    status, out, _ = run(capsys, "oracle")
    assert status == 0
    assert "0.08918671280221278" in out


def test_the_unit_test_in_python_of_the_page_passes() -> None:
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    subprocess.run([sys.executable, "-c", code], check=True)
    wrong = code.replace("mine = [1.0, 2.0", "mine = [1.0, 2.0001")
    assert subprocess.run([sys.executable, "-c", wrong], check=False, capture_output=True).returncode == 1


@pytest.mark.skipif(shutil.which("g++") is None, reason="g++ is not installed")
def test_the_unit_test_in_cpp_of_the_page_passes(tmp_path: Path) -> None:
    (code,) = re.findall(r"```cpp\n(.*?)```", PAGE, flags=re.DOTALL)
    (script,) = re.findall(r"python3 -c '(.*?)' <", PAGE, flags=re.DOTALL)
    (tmp_path / "reflect.cpp").write_text(code, encoding="utf-8")
    subprocess.run(["g++", "-o", tmp_path / "reflect", tmp_path / "reflect.cpp"], check=True)
    command = [sys.executable, "-m", "raytruth", "oracle"]
    answers = subprocess.run(command, input=GOOD, check=True, capture_output=True).stdout
    bounds = subprocess.run([sys.executable, "-c", script], input=answers, check=True, capture_output=True).stdout
    subprocess.run([tmp_path / "reflect"], input=bounds, check=True)
