from __future__ import annotations

import json
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import jsonschema
import pytest

from scenes.library import library_names, open_scene
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path


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
        (["export", "glass-sphere", "--to", "povrey", "--out", "x"], "Choose from"),
        (["export", "phong-sphere", "--to", "mitsuba", "--out", "x"], "because a point light of Mitsuba"),
        (["export", "glass-sphere", "--to", "mitsuba", "--out", "no/such/folder"], "there is no folder no/such"),
        (["export", "glass-sphere", "--to", "mitsuba", "--out", "/proc/folder"], "/proc/folder cannot be written"),
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


def test_export_writes_a_mitsuba_scene_and_its_meshes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "out"
    exported = document(capsys, "scenes", "export", "glass-sphere", "--to", "mitsuba", "--out", str(folder))
    assert exported["scene"] == "glass-sphere"
    assert exported["file"] == str(folder / "scene.xml")
    assert sorted(exported["files"]) == sorted(map(str, folder.iterdir()))
    depth = ElementTree.parse(folder / "scene.xml").find("integrator/integer[@name='max_depth']")
    assert depth is not None
    assert depth.get("value") == str(open_scene("glass-sphere").max_depth + 2)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_export_writes_a_povray_scene_and_tells_how_to_render_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "out" / "scene.pov"
    status, out, _ = run(capsys, "scenes", "export", "whitted-1980", "--to", "povray", "--out", str(file.parent))
    assert status == 0
    assert f"povray {file} +W160 +H120" in out
    assert "#version 3.7;" in file.read_text(encoding="utf-8")
    refused = refusal(capsys, "scenes", "export", "bubble-in-glass", "--to", "povray", "--out", str(tmp_path / "no"))
    assert "cannot be written for POV-Ray, because POV-Ray 3.7 finds no Fresnel" in refused


def test_export_leaves_other_files_of_the_folder_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    assert run(capsys, "scenes", "export", "plane-mirror", "--to", "mitsuba", "-o", str(tmp_path))[0] == 0
    assert (tmp_path / "mine.txt").read_text() == "mine"


def test_export_to_a_file_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").touch()
    arguments = ("scenes", "export", "plane-mirror", "--to", "mitsuba", "--out", str(tmp_path / "file"))
    assert "is a file" in refusal(capsys, *arguments)
