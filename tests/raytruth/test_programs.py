"""A user's programs on the command line."""

from __future__ import annotations

import json
import os
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import pytest

from raytruth import run_command
from raytruth.comparisons.matrix import run as matrix_run
from raytruth.comparisons.renderers.program.declaration import Declaration
from tests.comparisons.matrix.scene_files import scene_file
from tests.comparisons.renderers.program.scripts import HEIGHT, WIDTH, write_script
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REN-8", "CMD-2")

COMMAND = "mine=./tracer {width} {height} {output}.pfm {scene}"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working directory, with a scene and a program in it that is wrong; all is rendered in this process."""
    monkeypatch.setattr(matrix_run, "ProcessPoolExecutor", lambda jobs, *_: ThreadPoolExecutor(jobs))
    monkeypatch.setattr(run_command, "with_metrics", lambda _out, cells: cells)
    monkeypatch.chdir(tmp_path)
    scene_file(tmp_path, width=WIDTH, height=HEIGHT)
    write_script(tmp_path, "write()")
    return tmp_path


def cells(folder: Path) -> list[tuple[str, str]]:
    read = json.loads((folder / "results" / "results.json").read_text())
    return [(cell["renderer"], cell["verdict"]) for cell in read["cells"]]


def test_a_command_is_a_renderer_and_alone_if_no_other_is_named(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status, _, _ = run(capsys, "run", "small.json", "--renderer-command", COMMAND)
    assert (status, cells(folder)) == (1, [("mine", "fail")])
    status, _, _ = run(capsys, "run", "small.json", "--renderer-command", COMMAND, "--renderer", "raytruth")
    assert (status, cells(folder)) == (1, [("mine", "fail"), ("raytruth", "pass")])


def test_a_file_is_a_renderer_beside_commands_and_its_cell_can_be_repeated(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "below").mkdir()
    write_script(folder / "below", "write()")
    text = 'name = "filed"\ncommand = ["./tracer", "{width}", "{height}", "{output}", "{scene}"]\nwrites = "pfm"\n'
    (folder / "below" / "my file.toml").write_text(text)
    options = ("--renderer-command", COMMAND, "--renderer-file", "below/my file.toml")
    status, _, _ = run(capsys, "run", "small.json", *options)
    assert (status, cells(folder)) == (1, [("filed", "fail"), ("mine", "fail")])
    (filed, mine) = json.loads((folder / "results" / "results.json").read_text())["cells"]
    assert filed["command"] == "raytruth run small.json --renderer-file 'below/my file.toml' --fresh"
    assert mine["command"] == f"raytruth run small.json --renderer-command '{COMMAND}' --fresh"


@pytest.mark.clause("REN-10")
def test_a_finished_cell_is_taken_over_until_the_program_is_built_anew(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def rendered_anew() -> bool:
        run(capsys, "run", "small.json", "--renderer-command", COMMAND)
        (log,) = folder.glob("results/cells/*/*/log.txt")
        is_new = log.stat().st_mtime_ns != 0
        os.utime(log, ns=(0, 0))
        return is_new

    assert rendered_anew()
    assert not rendered_anew()
    write_script(folder, "write()  # built anew")
    assert rendered_anew()
    assert not rendered_anew()


@pytest.mark.clause("VER-13")
def test_a_waiver_may_be_about_a_program(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    waiver = {"renderer": "mine", "version": "*", "scene": "small", "integrator": "whitted"}
    waiver |= {"most_failing_pixels": WIDTH * HEIGHT, "reason": "a test", "link": "https://example.org/"}  # type: ignore[dict-item]
    (folder / "waivers.json").write_text(json.dumps([waiver]))
    arguments = ("run", "small.json", "--renderer-command", COMMAND, "--waivers", "waivers.json")
    assert run(capsys, *arguments)[0] == 0
    assert "there is none called 'mine'" in refusal(capsys, "run", "small.json", *arguments[-2:])


@pytest.mark.parametrize(
    ("option", "expected"),
    [
        ("./tracer {scene} {output}", "expected NAME=COMMAND as in 'mine=./tracer {scene} {output}'"),
        ("mine='./tracer", "expected words as a shell takes them"),
        ("mine=./tracer {scene} {output}.bmp", "writes: expected 'exr', 'pfm', 'hdr', 'ppm' or 'png', found 'bmp'."),
        ("mine=./none {scene} {output}", "command[0]: expected a program, found none at"),
        ("povray=./tracer {scene} {output}", "the name 'povray' is one of raytruth's own; choose another."),
    ],
)
def test_a_wrong_command_is_one_sentence(
    option: str, expected: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    told = refusal(capsys, "run", "small.json", "--renderer-command", option)
    assert told.startswith("raytruth: --renderer-command")
    assert expected in told
    assert not (folder / "results").exists()


def test_mistakes_of_all_programs_are_told_at_once(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "wrong.toml").write_text('name = "a"\ncommand = ["./tracer", "{scene}", "{output}"]\nx = 1\ny = 2\n')
    options = ("--renderer-command", COMMAND, "--renderer-command", COMMAND, "--renderer-file", "wrong.toml")
    _, _, err = run(capsys, "run", "small.json", *options)
    twice, first, second = err.splitlines()
    assert twice.endswith(": the name 'mine' is given twice.")
    assert first.startswith("wrong.toml: x: expected no key 'x' here; known are ")
    assert second.startswith("wrong.toml: y: expected no key 'y' here; known are ")


@pytest.mark.clause("REN-5")
def test_a_program_whose_version_command_fails_is_unavailable_and_fails_the_run(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "mine.toml").write_text(
        'name = "mine"\ncommand = ["./tracer", "{scene}", "{output}"]\nversion = ["false"]\n'
    )
    status, _, err = run(capsys, "run", "small.json", "--renderer-file", "mine.toml")
    assert (status, cells(folder)) == (1, [("mine", "unavailable")])
    assert "its version command must succeed" in err


def test_init_writes_a_file_that_loads_and_never_over_another(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "renderers", "--init", "tracer")[0] == 0
    (told,) = document(capsys, "renderers", "--renderer-file", "tracer.toml")["renderers"]
    assert (told["name"], told["available"]) == ("tracer", True)
    before = (folder / "tracer.toml").read_text()
    assert "tracer.toml is there already" in refusal(capsys, "renderers", "--init", "tracer")
    assert (folder / "tracer.toml").read_text() == before


@pytest.mark.parametrize("name", ["", "My", "../x", 'a"b', "a\nb", "povray", "x" * 41])
def test_init_refuses_what_is_no_name_for_a_program(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert "--init: " in refusal(capsys, "renderers", f"--init={name}")
    assert sorted(path.name for path in folder.iterdir()) == ["small.json", "tracer"]


def test_the_schema_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert set(document(capsys, "renderers", "--schema")["properties"]) == set(Declaration.model_fields)
