"""OBJ and MTL files as trimesh reads them, and the geometry as our own reader does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import trimesh

from raytruth.scenes.exporters.obj import export_obj, notes, refuses
from raytruth.scenes.exporters.triangle_soup import material_of_each_triangle, triangles_of_scene
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.obj_file import read_obj
from tests.scenes.exporter_scenes import BOARD, FLOOR, GLASS, LAMP, MIRROR, POINT, RED, build

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-2")

BLINN = {"specular": {"reflectance": (0.5, 0.4, 0.3), "exponent": 20.5, "model": "blinn"}}
PHONG = {"specular": BLINN["specular"] | {"model": "phong"}}
AMBIENT = {"ambient": {"reflectance": (0.01, 0.02, 1 / 3)}}
SAME_MIRROR = {"mirror": {"reflectance": (0.5, 0.4, 0.3)}}
OBJ_SCENES = [name for name in library_names() if refuses(open_scene(name)) is None]


def read(path: Path) -> list[Any]:
    """The meshes of the file, in an order of trimesh's own."""
    # Both options keep the order and the number of the vertices.
    loaded = trimesh.load_scene(path, process=False, maintain_order=True, split_object=True, group_material=False)
    return list(loaded.geometry.values())


def material_of(path: Path) -> dict[str, Any]:
    (mesh,) = read(path)
    kwargs: dict[str, Any] = mesh.visual.material.kwargs
    return kwargs


@pytest.mark.parametrize("name", OBJ_SCENES)
def test_a_reader_finds_the_same_triangles_and_colours(name: str, tmp_path: Path) -> None:
    scene = open_scene(name)
    path = export_obj(scene, tmp_path)
    found = [
        (*triangle.ravel().tolist(), *mesh.visual.material.kwargs["kd"])
        for mesh in read(path)
        for triangle in mesh.triangles
    ]
    colors = [scene.materials[name].diffuse for name in material_of_each_triangle(scene)]
    corners = triangles_of_scene(scene).reshape(-1, 9).tolist()
    assert sorted(found) == sorted((*c, *d.reflectance) for c, d in zip(corners, colors, strict=True) if d)
    vertices, faces = read_obj(path.read_bytes())
    np.testing.assert_array_equal(np.array(vertices)[np.array(faces)], triangles_of_scene(scene))


@pytest.mark.parametrize(
    ("terms", "model"),
    [(RED, 1), (LAMP, 1), (RED | BLINN | AMBIENT, 2), (BLINN | SAME_MIRROR | LAMP, 3)],
)
def test_each_term_is_a_line_of_the_material(terms: dict[str, Any], model: int, tmp_path: Path) -> None:
    found = material_of(export_obj(build(materials={"m": terms}, objects=[FLOOR]), tmp_path))
    black = (0.0, 0.0, 0.0)
    assert tuple(found["ka"]) == terms.get("ambient", {}).get("reflectance", black)
    assert tuple(found["kd"]) == terms.get("diffuse", {}).get("reflectance", black)
    assert tuple(found.get("ks", black)) == terms.get("specular", {}).get("reflectance", black)
    assert tuple(map(float, found.get("ke", black))) == terms.get("emission", {}).get("radiance", black)
    assert ("ns" in found) == ("specular" in terms)
    assert int(found["illum"][0]) == model


def test_numbers_read_back_as_the_same_float64(tmp_path: Path) -> None:
    corners = ((1 / 3, -1e12, 5e-324), (0.1, 2.0**-40, -0.0), (1e-7, 123456789.12345679, 3.0))
    path = export_obj(build(objects=[FLOOR | {"vertices": corners}]), tmp_path)
    assert read_obj(path.read_bytes()) == (corners, ((0, 1, 2),))


@pytest.mark.parametrize(
    ("materials", "word"),
    [
        ({"diffuse": {"reflectance": BOARD}}, "checkerboard"),
        ({"emission": {"radiance": BOARD}}, "checkerboard"),
        (GLASS, "glass"),
        (RED | PHONG, "Phong"),
        (MIRROR, "highlights"),
        (BLINN | MIRROR, "highlights"),
    ],
)
def test_what_mtl_cannot_say_is_refused(materials: dict[str, Any], word: str, tmp_path: Path) -> None:
    scene = build(materials={"m": materials}, objects=[FLOOR])
    assert word in (refuses(scene) or "")
    with pytest.raises(ValueError, match="because"):
        export_obj(scene, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_spheres_are_refused_and_materials_that_nothing_has_are_not() -> None:
    assert "spheres" in (refuses(build()) or "")
    assert refuses(build(materials={"m": RED, "unused": GLASS}, objects=[FLOOR])) is None


def test_what_is_left_out_is_told_in_the_file_too(tmp_path: Path) -> None:
    def told(scene: Scene) -> set[str]:
        lines = export_obj(scene, tmp_path).read_text(encoding="utf-8").splitlines()
        assert set(lines) >= {f"# {note}" for note in notes(scene)}
        return {note.split(" is ")[0].split(" are ")[0] for note in notes(scene)}

    assert told(build(objects=[FLOOR])) == {"the camera"}
    shining = {"lights": [POINT], "ambient_light": (0.0, 1.0, 0.0), "background": {"color": (0.0, 0.0, 1.0)}}
    everything = {"the camera", "the lights", "the ambient light", "the background"}
    assert told(build(objects=[FLOOR], convention="whitted", **shining)) == everything


def test_a_text_of_the_author_stays_in_its_comment(tmp_path: Path) -> None:
    scene = build(
        purpose="A test.\nv 0 0 0\\", materials={"f 1 1 1\r\\": RED}, objects=[FLOOR | {"material": "f 1 1 1\r\\"}]
    )
    path = export_obj(scene, tmp_path)
    assert len(read_obj(path.read_bytes())[0]) == 3
    for line in (path.read_text() + path.with_suffix(".mtl").read_text()).splitlines():
        assert not line.endswith("\\")
        assert line.startswith(("#", "mtllib ", "o ", "v ", "f 1 2 3", "usemtl ", "newmtl ", "K", "illum "))
