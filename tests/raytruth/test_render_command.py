from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO
import pytest

from raytruth import render_command
from raytruth.comparisons.records.image_files import read_image
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import open_scene
from tests.raytruth.running import document, refusal, run
from tests.reference_tracer.small_scenes import lamp, small_scene, square

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-2", "CMD-4")

SMALL = ("--arithmetic", "float", "--size", "8x6")


@pytest.mark.clause("OUT-1")
def test_an_exr_holds_the_tracers_image_at_the_size_asked_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "image.exr"
    told = document(capsys, "render", "two-lights", "-o", str(path), *SMALL, "--samples", "2")
    assert (told["scene"], told["file"], told["width"], told["height"]) == ("two-lights", str(path), 8, 6)
    assert (told["arithmetic"], told["samples"]) == ("float", 2)
    scene = open_scene("two-lights")
    small = scene.resized(8, 6)
    np.testing.assert_array_equal(read_image(path), render(small, FLOAT, samples=2).astype(np.float32))


@pytest.mark.parametrize("arithmetic", ["float64", "float32"])
def test_compiled_arithmetics_write_an_image(
    arithmetic: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "image.exr"
    # A scene with few features, which compiles soonest.
    assert run(capsys, "render", "ambient-sphere", "-o", str(path), "--arithmetic", arithmetic, "--size", "9x5")[0] == 0
    assert read_image(path).shape == (5, 9, 3)


@pytest.mark.clause("OUT-3")
def test_a_png_is_8_bit_srgb(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "image.PNG"
    status, out, err = run(capsys, "render", "checkerboard-floor", "-o", str(path), *SMALL)
    assert status == 0
    assert str(path) in out
    assert "8x6" in err  # what takes long is announced
    scene = open_scene("checkerboard-floor")
    small = scene.resized(8, 6)
    linear = np.clip(render(small, FLOAT).astype(np.float32).astype(np.float64), 0, 1)
    # IEC 61966-2-1: the transfer function of sRGB.
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    source = OpenImageIO.ImageInput.open(str(path))
    assert source.spec().format == OpenImageIO.UINT8
    pixels = np.asarray(source.read_image("uint8"), dtype=np.int64)[..., :3]
    source.close()
    assert (pixels == np.round(255 * encoded)).all()


@pytest.mark.clause("OUT-2")
def test_nothing_is_left_beside_the_image(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("a.exr", "a.png"):
        assert run(capsys, "render", "single-sphere", "-o", str(tmp_path / name), *SMALL)[0] == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.exr", "a.png"]


@pytest.mark.clause("OUT-2")
def test_an_image_that_fails_leaves_the_old_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(_image: object) -> bytes:
        raise OSError(28, "No space left on device", "image.png")

    path = tmp_path / "image.png"
    path.write_text("old")
    monkeypatch.setattr(render_command, "tone_picture", fail)
    assert "No space left" in refusal(capsys, "render", "single-sphere", "-o", str(path), *SMALL)
    assert path.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["image.png"]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["-o", "image.jpg"], "ends in .exr or .png"),
        (["-o", "image"], "ends in .exr or .png"),
        (["-o", "no/such/image.png"], "there is no folder no/such"),
        (["-o", "image.png", "--size", "0x5"], "--size: expected WIDTHxHEIGHT"),
        (["-o", "image.png", "--size", "5"], "--size: expected WIDTHxHEIGHT"),
        (["-o", "image.png", "--size", "5x99999"], "from 1 to 8192"),
        (["-o", "image.png", "--size", "٣x٣"], "--size: expected WIDTHxHEIGHT"),
        (["-o", "image.png", "--samples", "0"], "Must be >= 1"),
        (["-o", "image.png", "--samples", "65"], "Must be <= 64"),
        (["-o", "image.png", "--samples", "many"], "into int"),
        (["-o", "image.png", "--arithmetic", "float16"], "Choose from"),
    ],
)
def test_bad_options_are_one_sentence(
    arguments: list[str],
    expected: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert expected in refusal(capsys, "render", "single-sphere", *arguments)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_in_the_images_place_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "image.png").mkdir()
    assert "is a folder" in refusal(capsys, "render", "single-sphere", "-o", str(tmp_path / "image.png"))


@pytest.mark.clause("ILL-9", "ARI-1")
def test_a_light_at_a_seen_point_is_black_there_in_interpreted_floats_as_in_compiled_ones(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = small_scene(
        width=3, height=3, objects=[square("white", 0.0)], lights=[lamp((0.0, 0.0, 0.0), 1.0, "inverse_square")]
    )
    (tmp_path / "scene.json").write_text(scene.model_dump_json(exclude={"name"}, exclude_none=True))
    images = []
    for arithmetic in ("float", "float64"):
        out = tmp_path / f"{arithmetic}.exr"
        assert run(capsys, "render", str(tmp_path / "scene.json"), "-o", str(out), "--arithmetic", arithmetic)[0] == 0
        images.append(read_image(out))
    assert images[0][1, 1].tolist() == [0.0, 0.0, 0.0]
    np.testing.assert_array_equal(*images)


def test_an_unknown_scene_is_refused_before_any_work(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = run(capsys, "render", "singel-sphere", "-o", str(tmp_path / "image.png"))
    assert status == 2
    assert "did you mean 'single-sphere'" in err
    assert "Rendering" not in err
