from __future__ import annotations

import os
import signal
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest

from raytruth import command_line
from raytruth.command_line import COMMANDS, main
from tests.raytruth.running import refusal, run, run_apart

pytestmark = pytest.mark.clause("CMD-2", "CMD-4")


def test_help_names_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, "--help")
    assert (status, err) == (0, "")
    for name in COMMANDS:
        assert f" {name} " in out


@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_every_command_has_help_with_an_example(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, command, "--help")
    assert status == 0
    assert f"Usage: raytruth {command}" in out
    assert "Example" in out or command == "scenes"  # whose subcommands have theirs


@pytest.mark.parametrize("command", ["list", "show", "validate", "export"])
def test_every_scenes_command_has_help_with_an_example(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert "Example" in run(capsys, "scenes", command, "--help")[1]


def test_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "--version") == (0, f"{version('raytruth')}\n", "")


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["rendr"], "Did you mean"),
        (["scenes", "shwo"], "Did you mean"),
        (["scenes", "list", "--jsn"], "--json"),
        (["explain", "single-sphere", "--pixel"], "--pixel requires an argument"),
        (["render", "single-sphere"], "--out requires an argument"),
        (["render"], "SCENE requires an argument"),
        (["scenes", "validate"], "FILES requires an argument"),
        (["scenes", "show", "single-sphere", "two-lights"], "two-lights"),
    ],
)
def test_bad_usage_is_one_sentence(arguments: list[str], expected: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, *arguments)
    assert status == 2
    assert out == ""
    assert len(err.splitlines()) == 1
    assert expected in err
    assert "raytruth --help" in err


def test_an_interrupt_ends_with_130_and_no_traceback(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted() -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(command_line, "make_app", interrupted)
    assert run(capsys, "scenes", "list") == (128 + signal.SIGINT, "", "raytruth: interrupted.\n")


def test_a_file_that_cannot_be_written_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full() -> None:
        raise OSError(28, "No space left on device", "image.png")

    monkeypatch.setattr(command_line, "make_app", full)
    assert refusal(capsys, "scenes", "list") == "raytruth: image.png: No space left on device."


def test_a_reader_that_goes_away_is_no_error(tmp_path: Path) -> None:
    read_end, write_end = os.pipe()
    os.close(read_end)
    command = [sys.executable, "-m", "raytruth", "scenes", "list"]
    with os.fdopen(write_end, "w") as pipe:
        done = subprocess.run(command, cwd=tmp_path, stdout=pipe, stderr=subprocess.PIPE, check=False, timeout=60)
    assert done.returncode == 128 + signal.SIGPIPE
    assert done.stderr == b""


def test_output_that_cannot_be_written_is_one_sentence(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "raytruth", "scenes", "list"]
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(command, cwd=tmp_path, stdout=full, stderr=subprocess.PIPE, check=False, timeout=60)
    assert (done.returncode, done.stderr.count(b"\n")) == (2, 1)
    assert b"cannot be written" in done.stderr


def test_the_program_runs_with_folders_of_our_packages_names_in_the_working_directory(tmp_path: Path) -> None:
    for name in ("scenes", "comparisons"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("raise RuntimeError('this is not ours')")
    done = run_apart(tmp_path, "scenes", "show", "single-sphere")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("single-sphere: ")


def test_a_terminal_that_cannot_show_greek_gets_question_marks(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = run_apart(tmp_path, "explain", "glass-sphere", "--pixel", "32,32", env=environment)
    assert (done.returncode, done.stderr) == (0, "")
    assert "index ratio ? =" in done.stdout


@pytest.mark.clause("CMD-1")
def test_the_installed_program_gives_the_exit_status(tmp_path: Path) -> None:
    done = run_apart(tmp_path, "explain", "single-sphere", "--pixel", "9999,0")
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1


def test_main_takes_its_arguments_from_the_command_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["raytruth", "--version"])
    assert main() == 0
    assert capsys.readouterr().out == f"{version('raytruth')}\n"
