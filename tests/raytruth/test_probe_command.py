from __future__ import annotations

import tomllib
from typing import TYPE_CHECKING

import pytest

from raytruth import probe_command
from raytruth.comparisons.matrix.probe import Found
from raytruth.comparisons.renderers.program.declaration import LeavingRays, Rays
from raytruth.comparisons.renderers.program.declaration_file import checked_declaration
from tests.comparisons.renderers.program.scripts import write_script
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = [pytest.mark.clause("REN-8"), pytest.mark.usefixtures("one_scene")]

COMMAND = 'name = "mine"\ncommand = ["./tracer", "{width}", "{height}", "{output}", "{scene}"]\nwrites = "pfm"\n'


@pytest.fixture
def one_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(probe_command, "quick_scenes", lambda: ("ambient-sphere",))


def file(folder: Path, code: str, more: str = "") -> Path:
    write_script(folder, code)
    path = folder / "mine.toml"
    path.write_text(COMMAND + more, encoding="utf-8")
    return path


def test_a_mistake_ends_with_status_1_and_names_the_pixel(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    status, out, _ = run(capsys, "renderers", "--probe", str(file(tmp_path, "write()")))
    assert status == 1
    assert out.startswith("No number of bits and none of the usual ray offsets explains")
    assert "ambient-sphere fails at column " in out


def test_what_holds_is_told_as_lines_of_the_file(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = probe_command.small(probe_command.open_scene("ambient-sphere"))
    grey = scene.model_copy(update={"objects": scene.objects[:1], "ambient_light": (0.0, 0.0, 0.0)})
    monkeypatch.setattr(probe_command, "open_scene", lambda _name: grey)
    path = file(tmp_path, "write(color=(0.0, 0.0, 0.0))", '[arithmetic]\nprecision = "float32"\n')
    status, out, _ = run(capsys, "renderers", "--probe", str(path))
    assert status == 0
    _, lines, rest = out.split("\n\n")
    assert tomllib.loads(lines) == {"arithmetic": {"precision": "float32", "slack_bits": 0}}
    assert rest.splitlines() == [
        "These are all bits of its numbers.",
        "Its rays need no offset and no least distance.",
    ]
    told = document(capsys, "renderers", "--probe", str(path))
    assert told == {"lines": lines.splitlines(), "verdicts": {"pass": 1}, "decided_by": None}


def test_a_declared_offset_that_decides_is_told_with_all_its_digits() -> None:
    rays = Rays(least_distance=1.0 / 3.0, shadow=LeavingRays(offset=1e-7, along="ray"))
    found = Found(rays, 20, None)
    declaration = checked_declaration({"name": "mine", "command": ["./mine", "{scene}", "{output}"]}, "mine.toml")
    told = tomllib.loads("\n".join(probe_command._lines(declaration, found)))
    assert told == {
        "arithmetic": {"bits": 20},
        "rays": {"least_distance": 1.0 / 3.0, "shadow": {"offset": 1e-7, "along": "ray"}},
    }


def test_a_program_that_cannot_be_probed_is_refused(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    crashing = file(tmp_path, "os.abort()")
    assert "ambient-sphere" in refusal(capsys, "renderers", "--probe", str(crashing))
    refusing = file(tmp_path, "write()", '[scenes]\nrefuses = ["ambient", "spheres"]\n')
    assert "refuses the whole quick suite" in refusal(capsys, "renderers", "--probe", str(refusing))
    random = COMMAND.replace('"{width}"', '"{seed}", "{width}"') + "[sampling]\nsamples = 4\n"
    refusing.write_text(random, encoding="utf-8")
    assert "expected no samples" in refusal(capsys, "renderers", "--probe", str(refusing))
