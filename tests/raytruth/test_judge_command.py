from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import OpenImageIO
import pytest

import raytruth
from raytruth import judge_command
from raytruth.comparisons.records.image_files import write_image
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("VER-15", "CMD-1", "CMD-2", "CMD-3")

WIDTH, HEIGHT = 16, 12


@pytest.fixture
def image(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> NDArray[np.float32]:
    """The right picture of a scene; both are files in the working directory, too."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(judge_command, "with_metrics", lambda _out, cells: cells)
    stated = raytruth.load_scene("sphere-over-floor").model_dump(mode="json", exclude={"name"}, exclude_defaults=True)
    stated["camera"] |= {"width": WIDTH, "height": HEIGHT}
    (tmp_path / "scene.json").write_text(json.dumps(stated))
    pixels: NDArray[np.float32] = raytruth.render(raytruth.load_scene("scene.json"), "float").astype(np.float32)
    write_image(tmp_path / "right.exr", pixels)
    return pixels


def judged(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str]:
    status, out, _ = run(capsys, "judge", *arguments, "--scene", "scene.json")
    return status, out


def save_codes(path: Path, codes: NDArray[np.uint8]) -> None:
    buffer = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(WIDTH, HEIGHT, 3, "uint8"))
    buffer.set_pixels(OpenImageIO.ROI.All, codes)
    assert buffer.write(str(path))


def test_a_right_picture_passes_and_one_with_a_wrong_pixel_fails_with_that_pixel(
    image: NDArray[np.float32], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert judged(capsys, "right.exr") == (0, "pass         right.exr: all 192 pixels lie in their feasible sets\n")
    image[3, 5] += np.float32(0.001)
    write_image(tmp_path / "wrong.exr", image)
    status, out = judged(capsys, "right.exr", "wrong.exr")
    assert status == 1
    passed, failed, worst = out.splitlines()
    assert passed.startswith("pass         right.exr")
    assert failed == "fail         wrong.exr: 1 of 192 pixels lie outside their feasible sets"
    assert "worst at column 5, row 3: " in worst


def test_what_is_printed_as_json_is_the_cell_or_a_list_of_cells(
    image: NDArray[np.float32], capsys: pytest.CaptureFixture[str]
) -> None:
    del image
    cell = document(capsys, "judge", "right.exr", "--scene", "scene.json")
    assert (cell["scene"], cell["renderer"], cell["verdict"]) == ("scene", "right", "pass")
    assert (cell["images"], cell["judgement"]["failing"]) == (None, 0)
    two: Any = document(capsys, "judge", "right.exr", "right.exr", "--scene", "scene.json")
    assert [it["renderer"] for it in two["cells"]] == ["right", "right-2"]


def test_with_a_folder_there_are_results_and_a_report(
    image: NDArray[np.float32], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    del image
    status, out = judged(capsys, "right.exr", "--bits", "30", "--out", "told")
    assert status == 0
    assert out.splitlines()[-1] == "Report: told/report.html"
    (cell,) = json.loads((tmp_path / "told" / "results.json").read_text())["cells"]
    assert cell["command"] == "raytruth judge right.exr --scene scene.json --bits 30"
    assert (tmp_path / "told" / cell["images"]["render"]).is_file()


def test_a_picture_of_codes_is_held_to_its_codes_and_its_curve(
    image: NDArray[np.float32], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    codes = np.floor(np.clip(image, 0, 1) * 255 + 0.5).astype(np.uint8)
    save_codes(tmp_path / "linear.png", codes)
    assert judged(capsys, "linear.png")[0] == 0
    assert judged(capsys, "linear.png", "--srgb")[0] == 1
    codes[3, 5] += 2
    save_codes(tmp_path / "wrong.png", codes)
    assert "1 of 192 pixels" in judged(capsys, "wrong.png")[1]


def test_a_declaration_says_how_the_picture_came_about(
    image: NDArray[np.float32], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_image(tmp_path / "upside-down.exr", np.ascontiguousarray(image[::-1]))
    text = 'name = "mine"\ncommand = ["none", "{scene}", "{output}", "{seed}"]\nconventions.flip_y = true\n'
    (tmp_path / "mine.toml").write_text(text)
    assert judged(capsys, "upside-down.exr")[0] == 1
    assert judged(capsys, "upside-down.exr", "--renderer-file", "mine.toml")[0] == 0
    both = refusal(capsys, "judge", "right.exr", "--scene", "scene.json", "--renderer-file", "mine.toml", "--bits", "9")
    assert "neither --bits nor --srgb" in both
    (tmp_path / "noisy.toml").write_text(text + "sampling.samples = 4\n")
    told = refusal(capsys, "judge", "right.exr", "--scene", "scene.json", "--renderer-file", "noisy.toml")
    assert told == "raytruth: noisy.toml: sampling: one picture of random samples cannot be judged; use raytruth run."


@pytest.mark.clause("VER-10")
def test_a_picture_of_another_size_or_with_a_hole_is_an_error(
    image: NDArray[np.float32], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_image(tmp_path / "small.exr", np.ascontiguousarray(image[1:]))
    image[0, 0] = np.nan
    write_image(tmp_path / "hole.exr", image)
    status, out = judged(capsys, "small.exr", "hole.exr")
    assert status == 1
    assert [line.split()[:2] for line in out.splitlines()] == [["error", "small.exr:"], ["error", "hole.exr:"]]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ((), "judge: expected a picture at least, found none."),
        (("none.exr",), "none.exr: expected a picture, found no file of this name."),
        (("scene.json",), "scene.json: its name does not end in .exr, .pfm, .hdr, .ppm, .png."),
        (("garbage.png",), "garbage.png: its garbage.png is no picture that can be read"),
        (("right.exr", "--bits", "99"), "--bits: expected a number from 8 to 53, found 99."),
        (("right.exr", "--out", "right.exr"), "--out: expected a folder, but right.exr is a file."),
    ],
)
def test_bad_input_is_one_sentence(
    arguments: tuple[str, ...],
    expected: str,
    image: NDArray[np.float32],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    del image
    (tmp_path / "garbage.png").write_bytes(b"garbage")
    assert refusal(capsys, "judge", *arguments, "--scene", "scene.json").startswith(f"raytruth: {expected}")
