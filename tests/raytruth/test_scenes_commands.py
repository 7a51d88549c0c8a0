from __future__ import annotations

import json
from typing import TYPE_CHECKING

import jsonschema
import pytest

from raytruth.scenes.library import library_names, open_scene
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-2", "CMD-3", "CMD-4")


def test_list_has_a_line_for_each_scene(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, "scenes", "list")
    assert (status, err) == (0, "")
    assert [line.split("\t")[0] for line in out.splitlines()] == list(library_names())


def test_list_as_json_tells_size_convention_and_features(capsys: pytest.CaptureFixture[str]) -> None:
    scenes = {scene["name"]: scene for scene in document(capsys, "scenes", "list")["scenes"]}
    assert set(scenes) == set(library_names())
    whitted = scenes["whitted-1980"]
    assert (whitted["convention"], whitted["width"], whitted["height"]) == ("whitted", 160, 120)
    assert {"MIRRORS", "DIELECTRICS", "PHONG"} <= set(whitted["features"])
    assert all(scene["purpose"] for scene in scenes.values())


def test_show_as_json_gives_a_scene_that_loads_as_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shown = document(capsys, "scenes", "show", "whitted-1980")
    assert shown["light_paths"] == f"ES{{0,{shown['max_depth']}}}(DL|e)"
    path = tmp_path / "whitted-1980.json"
    path.write_text(json.dumps(shown["scene"]))
    assert open_scene(str(path)) == open_scene("whitted-1980")


def test_show_prints_purpose_requirements_and_text(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "scenes", "show", "single-sphere")
    assert status == 0
    assert "point_lights" in out
    assert "light paths: E" in out
    assert json.loads(out[out.index("{\n") :])["convention"] == "radiometric"


def test_show_schema_is_a_schema_that_the_scenes_obey(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "scenes", "show", "--schema")
    assert status == 0
    jsonschema.validate(document(capsys, "scenes", "show", "two-lights")["scene"], json.loads(out))


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["show"], "expected a scene"),
        (["show", "single-sphere", "--schema"], "leave the scene out"),
        (["show", "glass-spere"], "did you mean 'glass-sphere'"),
        (["show", "nowhere.json"], "no file of this name"),
    ],
)
def test_what_cannot_be_done_is_one_sentence(
    arguments: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert expected in refusal(capsys, "scenes", *arguments)


def test_validate_tells_all_problems_of_all_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first, second = tmp_path / "first.json", tmp_path / "second.json"
    first.write_text('{"convention": "radiometric", "camera": 3}')
    second.write_text("not json")
    status, out, err = run(capsys, "scenes", "validate", "single-sphere", str(first), str(second))
    assert status == 2
    assert out == "single-sphere: valid\n"
    assert err.count(f"{first}: ") >= 3  # purpose, camera, materials and objects
    assert err.count(f"{second}: ") == 1


def test_validate_as_json_has_an_entry_for_each_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    broken = tmp_path / "broken.json"
    broken.write_text("[]")
    status, out, err = run(capsys, "scenes", "validate", "single-sphere", str(broken), "--json")
    assert (status, err) == (2, "")
    good, bad = json.loads(out)["files"]
    assert (good["file"], good["valid"], good["problems"]) == ("single-sphere", True, [])
    assert (bad["file"], bad["valid"]) == (str(broken), False)
    assert bad["problems"]


def test_coverage_as_json_counts_what_scenes_say_and_finds_no_hole(capsys: pytest.CaptureFixture[str]) -> None:
    found = document(capsys, "scenes", "coverage")
    says = {each["saying"]: each for each in found["sayings"]}
    assert says["camera.up"]["library"] >= 2
    assert says["materials.*.diffuse.reflectance.checkerboard.plane is xy"]["library"] >= 1
    assert found["pairs_only_in_family"] > 0
    assert (found["holes"], found["pair_holes"]) == ([], [])


def test_coverage_in_words_ends_with_what_is_missing(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert run(capsys, "scenes", "coverage")[1].splitlines()[-1] == "No hole."
    monkeypatch.setattr("raytruth.scenes.pair_coverage.library_names", lambda: ["single-sphere"])
    status, out, _ = run(capsys, "scenes", "coverage")
    assert status == 1
    assert "hole: no scene of the library says that camera.up\n" in out
