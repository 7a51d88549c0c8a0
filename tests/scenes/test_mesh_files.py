from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from raytruth.scenes import mesh_files
from raytruth.scenes.mesh_files import with_triangles
from raytruth.scenes.shapes import Mesh
from raytruth.scenes.triangle_lists import MeshFileError
from tests.scenes.scene_files import TETRAHEDRON, changed, problems

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SCN-2", "SCN-3")


def mesh(name: str) -> Mesh:
    return Mesh(shape="mesh", file=name, material="red")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "outside.obj").write_text(TETRAHEDRON, encoding="utf-8")
    (inside / "tetrahedron.obj").write_text(TETRAHEDRON, encoding="utf-8")
    return inside


def test_a_file_inside_the_folder_is_read_also_from_a_folder_below(folder: Path) -> None:
    (folder / "below").mkdir()
    (folder / "below" / "again.OBJ").symlink_to(folder / "tetrahedron.obj")
    assert (
        with_triangles(mesh("below/again.OBJ"), folder).faces == with_triangles(mesh("tetrahedron.obj"), folder).faces
    )


@pytest.mark.parametrize("name", ["../outside.obj", "link.obj", "{absolute}", "below/../../outside.obj"])
def test_a_file_outside_the_folder_is_refused(folder: Path, name: str) -> None:
    (folder / "link.obj").symlink_to("../outside.obj")
    absolute = str(folder.parent / "outside.obj")
    with pytest.raises(MeshFileError, match="expected a file inside the scene's folder"):
        with_triangles(mesh(name.format(absolute=absolute)), folder)


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("missing.obj", "expected a mesh file beside the scene, found no file 'missing.obj'."),
        ("folder.obj", "expected a mesh file beside the scene, found no file 'folder.obj'."),
        ("pipe.obj", "expected a mesh file beside the scene, found no file 'pipe.obj'."),
        ("mesh.stl", "expected a file that ends in .obj or .ply, found 'mesh.stl'."),
        ("nul\0.obj", "expected a readable mesh file"),
        ("n" * 5000 + ".obj", "expected a readable mesh file"),
        ("circle.obj", "expected a readable mesh file"),
        ("broken.obj", "'broken.obj' line 2: expected a face with at least three vertices, found 1."),
        ("broken.ply", "'broken.ply' is no PLY file"),
    ],
)
def test_each_file_that_cannot_be_used_gets_its_sentence(folder: Path, name: str, sentence: str) -> None:
    (folder / "folder.obj").mkdir()
    (folder / "circle.obj").symlink_to("circle.obj")
    os.mkfifo(folder / "pipe.obj")
    (folder / "mesh.stl").write_text("solid", encoding="utf-8")
    (folder / "broken.obj").write_text("v 0 0 0\nf 1\n", encoding="utf-8")
    (folder / "broken.ply").write_text("v 0 0 0\n", encoding="utf-8")
    with pytest.raises(MeshFileError) as caught:
        with_triangles(mesh(name), folder)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_over_the_size_limit_is_refused(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mesh_files, "LARGEST_MESH_FILE", len(TETRAHEDRON))
    with_triangles(mesh("tetrahedron.obj"), folder)
    monkeypatch.setattr(mesh_files, "LARGEST_MESH_FILE", len(TETRAHEDRON) - 1)
    with pytest.raises(MeshFileError, match="bounds the memory"):
        with_triangles(mesh("tetrahedron.obj"), folder)


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        ({}, "objects[2]: expected either a file, or both vertices and faces."),
        ({"vertices": [[0, 0, 0]]}, "objects[2]: expected either a file, or both vertices and faces."),
        (
            {"file": "tetrahedron.obj", "faces": [[0, 1, 2]]},
            "objects[2].file: expected either a file or vertices and faces, found both; remove one.",
        ),
        (
            {"file": "../tetrahedron.obj"},
            "objects[2].file: expected a file inside the scene's folder, found '../tetrahedron.obj'; move it there.",
        ),
    ],
)
def test_a_scene_tells_what_is_wrong_with_its_mesh(tmp_path: Path, parts: dict[str, object], sentence: str) -> None:
    scene = changed(("objects", 2), {"shape": "mesh", "material": "glass", **parts})
    assert problems(tmp_path, scene) == [sentence]
