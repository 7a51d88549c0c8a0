"""Runs commands, in this process or in one of their own."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import TYPE_CHECKING, Any

from raytruth.command_line import main

if TYPE_CHECKING:
    from pathlib import Path

    import pytest


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Exit status, standard output and standard error of a command."""
    status = main(arguments)
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def document(capsys: pytest.CaptureFixture[str], *arguments: str) -> Any:
    """The one JSON document that a command prints."""
    status, out, _ = run(capsys, *arguments, "--json")
    assert status == 0
    return json.loads(out)


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """The sentence with which a command refuses; it prints nothing else, but may have said what it was doing."""
    status, out, err = run(capsys, *arguments)
    assert status == 2
    assert out == ""
    *_, last = [line for line in err.splitlines() if not line.endswith("…")]
    assert "Traceback" not in err
    return last


def run_apart(folder: Path, *arguments: str, **options: Any) -> subprocess.CompletedProcess[str]:
    """`python -m raytruth` in a working directory."""
    command = [sys.executable, "-m", "raytruth", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=60, **options)
