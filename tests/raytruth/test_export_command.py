from __future__ import annotations

import os
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import pytest

from raytruth.scenes.exporters.formats import FORMATS
from raytruth.scenes.library import open_scene
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-2", "CMD-4", "REN-2")


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["glass-sphere", "--to", "povrey", "--out", "x"], "Choose from"),
        (["phong-sphere", "--to", "mitsuba", "--out", "x"], "because a point light of Mitsuba"),
        (["glass-sphere", "--to", "mitsuba", "--out", "no/such/folder"], "there is no folder no/such"),
        (["glass-sphere", "--to", "mitsuba", "--out", "/proc/folder"], "/proc/folder cannot be written"),
        (["glass-sphere", "--to", "obj", "--out", "x"], "cannot be written as OBJ, because OBJ has no spheres"),
        (["glass-slab", "--to", "gltf", "--out", "x"], "cannot be written as glTF, because glTF leaves to each viewer"),
        (["phong-sphere", "--to", "pbrt", "--out", "x"], "cannot be written for pbrt, because a point light of pbrt"),
    ],
)
def test_what_cannot_be_exported_is_one_sentence_and_leaves_nothing(
    arguments: list[str],
    expected: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert expected in refusal(capsys, "scenes", "export", *arguments)
    assert list(tmp_path.iterdir()) == []


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
    refused = refusal(capsys, "scenes", "export", "camera-in-tea", "--to", "povray", "--out", str(tmp_path / "no"))
    assert "cannot be written for POV-Ray, because a dielectric's outside is not the object around it" in refused


def test_export_leaves_other_files_of_the_folder_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    assert run(capsys, "scenes", "export", "plane-mirror", "--to", "mitsuba", "-o", str(tmp_path))[0] == 0
    assert (tmp_path / "mine.txt").read_text() == "mine"


def test_export_to_a_file_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").touch()
    arguments = ("scenes", "export", "plane-mirror", "--to", "mitsuba", "--out", str(tmp_path / "file"))
    assert "is a file" in refusal(capsys, *arguments)


@pytest.mark.parametrize("name", FORMATS)
def test_each_format_is_written_to_a_folder_named_after_both_and_tells_what_it_changes(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    scene = open_scene("cornell-box")
    notes = FORMATS[name].notes(scene)
    status, out, err = run(capsys, "scenes", "export", "cornell-box", "--to", name)
    assert status == 0
    assert out.startswith(f"Wrote cornell-box-{name}{os.sep}")
    assert err.splitlines() == [f"cornell-box: {note}." for note in notes]
    assert [path.name for path in tmp_path.iterdir()] == [f"cornell-box-{name}"]
    again = document(capsys, "scenes", "export", "cornell-box", "--to", name)
    assert again["notes"] == notes
    assert sorted(again["files"]) == sorted(str(path.relative_to(tmp_path)) for path in tmp_path.glob("*/*"))


def test_an_exported_json_scene_is_valid(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    exported = document(capsys, "scenes", "export", "trefoil-knot", "--to", "json", "--out", str(tmp_path))
    assert exported["file"] == str(tmp_path / "trefoil-knot.json")
    assert run(capsys, "scenes", "validate", exported["file"])[0] == 0


def test_a_failure_while_writing_leaves_nothing_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail_after_a_file(_: object, folder: Path) -> Path:
        (folder / "scene.obj").write_text("half")
        raise OSError(28, "No space left on device")

    broken = FORMATS["obj"].__class__("as OBJ", FORMATS["obj"].refuses, FORMATS["obj"].notes, fail_after_a_file)
    monkeypatch.setitem(FORMATS, "obj", broken)
    out = tmp_path / "out"
    said = refusal(capsys, "scenes", "export", "cornell-box", "--to", "obj", "--out", str(out))
    assert "cannot be written (No space left on device)" in said
    assert list(tmp_path.iterdir()) == []
