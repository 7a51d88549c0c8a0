from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raytruth.scenes import loading, wording
from raytruth.scenes.library import LIBRARY_FOLDER
from raytruth.scenes.loading import SceneError, load_scene
from raytruth.scenes.scene import Scene
from raytruth.scenes.shapes import Mesh
from tests.scenes.scene_files import TETRAHEDRON, changed, loaded, problems, valid_scene, write_scene

pytestmark = pytest.mark.clause("SCN-1", "SCN-2")

JSON_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8) | st.sampled_from(["red", "sphere"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=6,
)


def places(value: Any, here: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    found = [here]
    if isinstance(value, dict):
        found += [place for key, inner in value.items() for place in places(inner, (*here, key))]
    if isinstance(value, list):
        found += [place for index, inner in enumerate(value) for place in places(inner, (*here, index))]
    return found


PLACES = places(valid_scene())[1:]


def value_at(place: tuple[str | int, ...]) -> Any:
    part: Any = valid_scene()
    for step in place:
        part = part[step]
    return part


def test_a_valid_scene_loads_and_is_named_after_its_file(tmp_path: Path) -> None:
    scene = load_scene(write_scene(tmp_path, valid_scene()))
    assert scene.name == "spoilt"
    assert len(scene.objects) == 4


def test_a_mesh_file_fills_the_mesh_and_its_name_is_kept(tmp_path: Path) -> None:
    scene = load_scene(write_scene(tmp_path, valid_scene()))
    inline, from_file = scene.objects[2], scene.objects[3]
    assert isinstance(inline, Mesh)
    assert isinstance(from_file, Mesh)
    assert (from_file.vertices, from_file.faces) == (inline.vertices, inline.faces)
    assert from_file.file == "tetrahedron.obj"


@settings(deadline=None)  # the machine may be busy
@given(st.lists(st.tuples(st.sampled_from(PLACES), JSON_VALUES), min_size=1, max_size=3))
def test_any_change_gives_a_scene_or_a_scene_error(changes: list[tuple[tuple[str | int, ...], Any]]) -> None:
    scene: Any = valid_scene()
    for place, value in changes:
        part = scene
        try:
            for step in place[:-1]:
                part = part[step]
            part[place[-1]] = value
        except (TypeError, KeyError, IndexError):
            continue  # an earlier change removed this place
    with tempfile.TemporaryDirectory() as folder:
        result = loaded(write_scene(Path(folder), scene))
    if isinstance(result, SceneError):
        assert result.problems
        assert all("\n" not in problem and problem[-1] in ".?" for problem in result.problems)


@settings(deadline=None)  # the machine may be busy
@given(st.binary(max_size=60), st.integers(0, len(json.dumps(valid_scene()))))
def test_any_bytes_in_a_scene_file_give_a_scene_or_a_scene_error(noise: bytes, position: int) -> None:
    text = json.dumps(valid_scene()).encode()
    with tempfile.TemporaryDirectory() as folder:
        path = write_scene(Path(folder), "")
        path.write_bytes(text[:position] + noise + text[position + len(noise) :])
        result = loaded(path)
    assert isinstance(result, Scene) or result.problems


def test_all_problems_are_told_at_once_those_of_parts_those_of_the_whole_and_those_of_mesh_files(
    tmp_path: Path,
) -> None:
    scene = valid_scene()
    scene["objects"][0]["radius"] = -1
    scene["objects"][1]["material"] = "bord"
    scene["objects"][3]["file"] = "missing.obj"
    scene["camera"]["look_at"] = scene["camera"]["position"]
    scene["colour"] = "red"
    assert problems(tmp_path, scene) == [
        "objects[0].radius: expected a number above 0, found -1.",
        "colour: expected no key 'colour' here; known are 'ambient_light', 'background', 'camera', 'convention', "
        "'lights', 'materials', 'max_depth', 'objects', 'purpose'.",
        "objects[3].file: expected a mesh file beside the scene, found no file 'missing.obj'.",
        "camera.look_at: expected a point other than the camera's position, since both give the view direction.",
        "objects[1].material: expected the name of one of the scene's materials, found 'bord'; did you mean 'board'?",
    ]


def test_the_text_of_a_scene_error_has_a_problem_on_each_line() -> None:
    assert str(SceneError(["first.", "second."])) == "first.\nsecond."


def test_a_broken_material_is_not_unknown_as_well(tmp_path: Path) -> None:
    found = problems(tmp_path, changed(("materials", "red", "diffuse", "reflectance"), [1, 1, -0.5]))
    assert found == ["materials.red.diffuse.reflectance[2]: expected a number of at least 0, found -0.5."]


@pytest.mark.clause("NUM-1")
@pytest.mark.parametrize("literal", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_that_are_not_finite_are_refused_at_their_place(tmp_path: Path, literal: str) -> None:
    text = json.dumps(changed(("objects", 0, "center", 1), 12345)).replace("12345", literal)
    [problem] = problems(tmp_path, text)
    assert problem.startswith("objects[0].center[1]: expected a finite number, found ")


def test_a_whole_number_of_very_many_digits_is_refused_at_its_place(tmp_path: Path) -> None:
    text = json.dumps(changed(("max_depth",), 12345)).replace("12345", "9" * 5000)
    assert problems(tmp_path, text) == ["max_depth: expected a whole number, found inf."]


def test_a_repeated_key_is_refused_at_its_place(tmp_path: Path) -> None:
    text = json.dumps(valid_scene()).replace('"radius": 1', '"radius": 1, "radius": 2')
    assert problems(tmp_path, text) == ["objects[0].radius: expected each key once, found it again; remove one."]


def test_a_name_in_the_file_is_refused_since_the_file_is_the_name(tmp_path: Path) -> None:
    [problem] = problems(tmp_path, changed(("name",), "red"))
    assert problem == "name: expected no name, since a scene is named after its file; remove it."


HALF = "which holds half of one (a lone surrogate); replace it."


@pytest.mark.parametrize("place", [place for place in PLACES if isinstance(value_at(place), str)])
def test_a_lone_surrogate_in_any_text_is_refused_at_its_place_in_one_sentence(
    tmp_path: Path, place: tuple[str | int, ...]
) -> None:
    text = json.dumps(changed(place, "glass \ud800"))
    where = wording.place(place)
    found = [problem for problem in problems(tmp_path, text) if problem.startswith(f"{where}: ")]
    assert found == [f'{where}: expected a text of Unicode characters, found "glass \\ud800", {HALF}']


def test_a_lone_surrogate_in_a_key_is_refused_and_told_without_it(tmp_path: Path) -> None:
    scene = changed(("materials", "\udc80"), {"mirror": {"reflectance": [1, 1, 1]}})
    scene["camera"]["x\ud800"] = 1
    found = problems(tmp_path, json.dumps(scene))
    assert f'materials."\\udc80": expected a text of Unicode characters, found "\\udc80", {HALF}' in found
    assert f'camera."x\\ud800": expected a text of Unicode characters, found "x\\ud800", {HALF}' in found
    assert all(problem.isascii() for problem in found)


def test_a_pair_of_surrogates_is_a_character(tmp_path: Path) -> None:
    text = json.dumps(valid_scene()).replace("bubble", "\\ud83e\\udee7")
    scene = loaded(write_scene(tmp_path, text))
    assert isinstance(scene, Scene)
    assert scene.objects[3].material == "\U0001fae7"


def test_a_file_name_that_is_no_utf_8_is_refused(tmp_path: Path) -> None:
    path = write_scene(tmp_path, valid_scene())
    latin = path.rename(tmp_path / os.fsdecode(b"\xe9.json"))
    with pytest.raises(SceneError, match=r"expected a file name in UTF-8, since it names the scene; rename it\.$"):
        load_scene(latin)


def test_a_mistake_in_the_json_is_told_with_line_and_column(tmp_path: Path) -> None:
    [problem] = problems(tmp_path, '{"purpose": "x",\n  "camera": }')
    assert problem.startswith("line 2, column 13: expected valid JSON")


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000])
def test_deep_nesting_is_refused(tmp_path: Path, text: str) -> None:
    [problem] = problems(tmp_path, text)
    assert "nested too deeply" in problem


@pytest.mark.parametrize("text", ["7", "null", "[]", '"scene"'])
def test_json_that_is_no_object_is_refused(tmp_path: Path, text: str) -> None:
    [problem] = problems(tmp_path, text)
    assert problem.startswith("the whole file: expected an object in braces, found ")


def test_text_that_is_not_utf_8_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "latin.json"
    path.write_bytes('{"purpose": "Würfel"}'.encode("latin-1"))
    with pytest.raises(SceneError, match="expected text in UTF-8, found byte 14 that is not"):
        load_scene(path)


def test_a_folder_and_a_missing_file_are_refused(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="found a folder or a device"):
        load_scene(tmp_path)
    with pytest.raises(SceneError, match="found no file of this name"):
        load_scene(tmp_path / "missing.json")


@pytest.mark.parametrize("name", ["nul\0.json", "n" * 5000 + ".json"])
def test_a_name_that_no_file_can_have_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(SceneError, match="expected a readable scene file"):
        load_scene(tmp_path / name)


def test_links_that_run_in_a_circle_are_refused(tmp_path: Path) -> None:
    (tmp_path / "circle.json").symlink_to("circle.json")
    with pytest.raises(SceneError):
        load_scene(tmp_path / "circle.json")


def test_a_file_over_the_size_limit_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write_scene(tmp_path, valid_scene())
    size = path.stat().st_size
    monkeypatch.setattr(loading, "LARGEST_SCENE_FILE", size)
    load_scene(path)
    monkeypatch.setattr(loading, "LARGEST_SCENE_FILE", size - 1)
    with pytest.raises(SceneError, match="bounds the memory"):
        load_scene(path)


def test_a_flood_of_problems_is_cut_and_counted(tmp_path: Path) -> None:
    scene = changed(("objects", 2, "faces"), [[0, 0, 0]] * 250)
    found = problems(tmp_path, scene)
    assert len(found) == loading.MOST_PROBLEMS_TOLD + 1
    assert found[-1] == "150 more problems like these were found."


def test_a_mesh_file_is_looked_for_beside_the_scene_wherever_the_program_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_scene(tmp_path, valid_scene())
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "tetrahedron.obj").write_text(TETRAHEDRON.replace("v 1 0 0", "v 9 0 0"), encoding="utf-8")
    monkeypatch.chdir(elsewhere)
    mesh = load_scene(path).objects[3]
    assert isinstance(mesh, Mesh)
    assert mesh.vertices[1] == (1.0, 0.0, 0.0)


def test_too_many_mesh_files_are_refused_before_any_is_read(tmp_path: Path) -> None:
    mesh = {"shape": "mesh", "file": "missing.obj", "material": "red"}
    found = problems(tmp_path, changed(("objects",), [mesh] * (loading.MOST_MESH_FILES + 1)))
    assert found == ["objects: expected at most 100 mesh files, found more; join some."]


def test_too_many_triangles_in_all_meshes_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(loading, "LARGEST_FACE_COUNT", 8)
    assert problems(tmp_path, valid_scene()) == []
    monkeypatch.setattr(loading, "LARGEST_FACE_COUNT", 7)
    assert problems(tmp_path, valid_scene()) == ["objects: expected at most 7 triangles in all meshes, found more."]


def test_a_file_whose_name_is_only_dots_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "...json"
    path.write_text((LIBRARY_FOLDER / "single-sphere.json").read_text())
    with pytest.raises(SceneError, match="something before"):
        load_scene(path)
