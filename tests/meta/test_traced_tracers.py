"""What `raytruth trace` says of an example tracer with a line wrong, and of programs that print no rays."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.meta.example_tracers import TRACERS, needs
from tests.raytruth.running import run

pytestmark = pytest.mark.clause("GRD-9", "CMD-4")

PIXELS = (("glass-sphere", "10,7"), ("bubble-in-glass", "9,8"), ("concave-mirror", "10,7"), ("two-lights", "9,9"))
WORDS = ("{scene}", "{output}.pfm")


def traced(capsys: pytest.CaptureFixture[str], scene: str, pixel: str, *command: str) -> tuple[int, str]:
    status, out, err = run(capsys, "trace", scene, "--quick", "--pixel", pixel, "--", *command, *WORDS)
    assert err == ""
    return status, out


MISTAKES = {
    "glass.index / outer if enters": (
        "outer / glass.index if enters",
        "Ray 'T'",
        "goes into another direction",
        "REFR",
    ),
    "2 * dot(ray.direction, normal)": ("dot(ray.direction, normal)", "Ray 'R'", "goes into another direction", "REFL"),
    "column + 0.5": ("column", "Ray ''", "goes into another direction", "CAM"),
    "(1 - fresnel)": ("(1 - fresnel / 2)", "all of its rays are right", "adds up to another colour", "REFR"),
    "return -b - root  # SPH-1": ("return -b + root", "Ray ''", "is of another length", "SPH"),
}


@needs("python")
def test_the_rays_of_the_example_in_python_are_right_until_a_line_is_wrong(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = Path(shutil.copytree(TRACERS / "python", tmp_path / "python"))
    source = folder / "tracer.py"
    right = source.read_text(encoding="utf-8")
    command = ("python3", "-B", str(source))
    for scene, pixel in PIXELS:
        status, out = traced(capsys, scene, pixel, *command)
        assert status == 0, out
    for line, (wrong, *told) in MISTAKES.items():
        assert line in right
        source.write_text(right.replace(line, wrong), encoding="utf-8")
        status, out = traced(capsys, "glass-sphere", "10,7", *command)
        assert status == 1
        assert all(words in out for words in told), (line, out)


@needs("python")
def test_a_program_that_crashes_or_prints_no_rays_is_told_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = tmp_path / "program.py"
    options = ("trace", "glass-sphere", "--quick", "--pixel", "10,7", "--", "python3", str(program), *WORDS)
    program.write_text("raise SystemExit('no such ray')")
    status, out, _ = run(capsys, *options)
    assert (status, "no such ray" in out) == (1, True)
    program.write_text("print('nothing')")
    status, out, err = run(capsys, *options)
    assert (status, out, "expected a line of JSON for each ray" in err) == (2, "", True)
    status, out, err = run(capsys, "trace", "glass-sphere", "--quick", "--pixel", "900,7", "--", "python3", "x")
    assert (status, "--pixel: expected 0,0 (top left) to" in err) == (2, True)
