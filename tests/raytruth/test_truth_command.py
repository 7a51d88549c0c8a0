from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from raytruth import truth_command
from raytruth.api import images
from raytruth.comparisons.records.image_files import ImageError
from raytruth.reference_tracer import certification
from raytruth.scenes.library import library_names
from tests.raytruth.running import document, refusal, run
from tests.reference_tracer.small_scenes import small_scene, sphere

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-2", "CMD-4")

SMALL = ("--size", "8x6", "--jobs", "1")


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path / "cache"))


def test_a_scene_is_certified_and_both_files_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "made" / "truth"
    told = document(capsys, "truth", "single-sphere", "--out", str(out), *SMALL)
    first = ["scene", "pixels", "undecided", "largest_radius", "largest_precision_bits", "seconds"]
    assert list(told)[:6] == first
    assert (told["scene"], told["pixels"], told["undecided"]) == ("single-sphere", 48, 0)
    assert 0 < told["largest_radius"] <= 2.0**-52
    assert told["largest_absolute_radius"] == pytest.approx(told["largest_radius"] * told["largest_value"])
    assert told["largest_precision_bits"] == 106
    assert sorted(path.name for path in out.iterdir()) == ["single-sphere.exr", "single-sphere.json"]
    written = json.loads((out / "single-sphere.json").read_text())
    assert written == {**told, "undecided_pixels": []}


def test_several_scenes_are_told_line_by_line_or_in_a_list(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ("truth", "single-sphere", "two-lights", "--out", str(tmp_path), *SMALL)
    status, out, err = run(capsys, *arguments)
    assert status == 0
    assert [line.split()[0] for line in out.splitlines()] == ["single-sphere", "two-lights"]
    assert "48 pixels, 0 undecided" in out
    assert err.count("Certifying") == 2
    assert [told["scene"] for told in document(capsys, *arguments)["scenes"]] == ["single-sphere", "two-lights"]


def test_the_library_is_the_default(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def certify(scene: Any, *_: object, **__: object) -> dict[str, Any]:
        return {"scene": scene.name}

    monkeypatch.setattr(truth_command, "_certify", certify)
    told = document(capsys, "truth", "--out", str(tmp_path))
    assert [scene["scene"] for scene in told["scenes"]] == list(library_names())


def test_an_undecided_pixel_is_explained_with_its_ray_and_its_outcomes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for limit in ("MOST_WORK", "MOST_WORK_OF_A_WAY"):  # as if the tie were too hard for exact values
        monkeypatch.setattr(certification, limit, 0)
    scene = small_scene(
        projection="perspective",
        extent=60.0,
        camera={"position": (0.0, 1.0, 2.0)},
        materials={"a": {"emission": {"radiance": (1.0, 0.5, 0.25)}}},
        objects=[sphere("a", (1.0, 0.0, 0.0))],
    )
    path = tmp_path / "touching.json"
    path.write_text(scene.model_dump_json(exclude_none=True, exclude={"name"}))
    told = document(capsys, "truth", str(path), "--out", str(tmp_path / "out"))
    assert (told["undecided"], told["largest_precision_bits"], told["largest_radius"]) == (1, 4096, 0.0)
    (pixel,) = json.loads((tmp_path / "out" / "touching.json").read_text())["undecided_pixels"]
    assert pixel["pixel"] == [0, 0]
    assert [float.fromhex(part) for part in pixel["origin"]] == [0.0, 1.0, 2.0]
    assert float.fromhex(pixel["direction"][1]) == pytest.approx(-(0.2**0.5))
    assert {tuple(outcome["middle"]) for outcome in pixel["outcomes"]} == {(1.0, 0.5, 0.25), (0.0, 0.0, 0.0)}
    assert "touches a sphere exactly" in pixel["explanation"]


def test_fresh_uses_nothing_that_was_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = []
    original = images.truth

    def recorded(*arguments: Any, fresh: bool, **options: Any) -> Any:
        asked.append(fresh)
        return original(*arguments, fresh=fresh, **options)

    monkeypatch.setattr(images, "truth", recorded)
    for more in ((), ("--fresh",)):
        assert run(capsys, "truth", "ambient-sphere", "--out", str(tmp_path), *SMALL, *more)[0] == 0
    assert asked == [False, True]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["single-sphere", "--jobs", "0"], "--jobs: expected 1 or more, found 0"),
        (["single-sphere", "--size", "5"], "--size: expected WIDTHxHEIGHT"),
        (["singel-sphere"], "did you mean 'single-sphere'"),
        (["single-sphere", "single-sphere"], "two scenes called 'single-sphere'"),
        (["single-sphere", "--out", "taken"], "taken is a file"),
    ],
)
def test_bad_usage_is_one_sentence_and_leaves_nothing(
    arguments: list[str],
    expected: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").touch()
    assert expected in refusal(capsys, "truth", *arguments)
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


def test_a_file_that_cannot_be_written_is_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(*_: object) -> None:
        raise ImageError("no space is left")

    monkeypatch.setattr(truth_command, "write_certified_image", fail)
    out = tmp_path / "out"
    assert "no space is left." in refusal(capsys, "truth", "single-sphere", "--out", str(out), *SMALL)
    assert list(out.iterdir()) == []
