"""glTF files as trimesh reads them, and held against the specification."""

from __future__ import annotations

import copy
import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import trimesh

from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.exporters.gltf import export_gltf
from raytruth.scenes.exporters.gltf_limits import notes, refuses
from raytruth.scenes.exporters.triangle_soup import triangles_of_scene
from raytruth.scenes.library import library_names, open_scene
from tests.scenes.exporter_scenes import BOARD, FLOOR, GLASS, LAMP, MIRROR, POINT, RED, SUN, build
from tests.scenes.gltf_conformance import violations

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-2")

GLTF_SCENES = [name for name in library_names() if refuses(open_scene(name)) is None]
CAMERA: dict[str, Any] = {
    "position": (0.3, 1.2, 5.1),
    "look_at": (-0.2, 0.1, 0.4),
    "up": (0.2, 1.0, 0.1),
    "width": 12,
    "height": 7,
}
ORTHOGRAPHIC = CAMERA | {"projection": "orthographic", "view_height": 2.3}
PERSPECTIVE = CAMERA | {"projection": "perspective", "vertical_field_of_view": 41.0, "width": 5, "height": 9}


def document_of(scene: Scene, folder: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(export_gltf(scene, folder).read_text(encoding="ascii"))
    assert violations(found) == []
    return found


def nodes_with(document: dict[str, Any], key: str) -> list[dict[str, Any]]:
    return [node for node in document["nodes"] if key in node or key in node.get("extensions", {})]


def rays_of(document: dict[str, Any], width: int, height: int) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Origins and directions through the centres of pixels, as chapter 3.10 defines cameras: they look along −z."""
    (node,) = nodes_with(document, "camera")
    matrix = np.array(node["matrix"]).reshape(4, 4).T
    camera = document["cameras"][node["camera"]]
    lens = camera[camera["type"]]
    x, y = np.meshgrid((np.arange(width) + 0.5) * 2 / width - 1, 1 - (np.arange(height) + 0.5) * 2 / height)
    if camera["type"] == "perspective":
        slope = math.tan(lens["yfov"] / 2)
        directions = np.stack([x * slope * lens["aspectRatio"], y * slope, -np.ones_like(x)], axis=-1)
        origins = np.zeros_like(directions)
    else:
        origins = np.stack([x * lens["xmag"], y * lens["ymag"], np.zeros_like(x)], axis=-1)
        directions = np.broadcast_to([0.0, 0.0, -1.0], origins.shape)
    directions = directions @ matrix[:3, :3].T
    return origins @ matrix[:3, :3].T + matrix[:3, 3], directions / np.linalg.norm(directions, axis=-1, keepdims=True)


def assert_same_camera(document: dict[str, Any], scene: Scene) -> None:
    for found, expected in zip(
        rays_of(document, scene.camera.width, scene.camera.height), primary_rays(scene), strict=True
    ):
        # A dozen roundings of coordinates of this size.
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14 * max(1.0, np.abs(expected).max()))


def assert_same_lights(document: dict[str, Any], scene: Scene) -> None:
    nodes = nodes_with(document, "KHR_lights_punctual")
    for node, light in zip(nodes, scene.lights, strict=True):
        number = node["extensions"]["KHR_lights_punctual"]["light"]
        found = document["extensions"]["KHR_lights_punctual"]["lights"][number]
        stated = light.intensity if light.kind == "point" else light.irradiance
        # The quotient and the product are rounded once each.
        np.testing.assert_allclose(np.array(found["color"]) * found["intensity"], stated, rtol=2.0**-52, atol=0)
        assert found["type"] == light.kind
        if light.kind == "point":
            assert tuple(node["translation"]) == light.position
        else:
            down = -np.array(node["matrix"]).reshape(4, 4).T[:3, 2]
            expected = np.array(light.direction) / np.linalg.norm(light.direction)
            np.testing.assert_allclose(down, expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("name", GLTF_SCENES)
def test_a_reader_finds_the_same_triangles_camera_and_lights(name: str, tmp_path: Path) -> None:
    scene = open_scene(name)
    document = document_of(scene, tmp_path)
    loaded = trimesh.load_scene(tmp_path / "scene.gltf", process=False)
    triangles = np.concatenate([mesh.triangles for mesh in loaded.geometry.values()])
    np.testing.assert_array_equal(triangles, triangles_of_scene(scene).astype(np.float32))
    assert loaded.metadata["gltf_extensions"] == document["extensions"]
    assert math.radians(loaded.camera.fov[1]) == pytest.approx(document["cameras"][0]["perspective"]["yfov"])
    assert_same_camera(document, scene)
    assert_same_lights(document, scene)
    for node, shape in zip(nodes_with(document, "mesh"), scene.objects, strict=True):
        (primitive,) = document["meshes"][node["mesh"]]["primitives"]
        material = document["materials"][primitive["material"]]
        diffuse = scene.materials[shape.material].diffuse
        assert material["name"] == shape.material
        assert diffuse is not None
        assert tuple(material["pbrMetallicRoughness"]["baseColorFactor"]) == (*diffuse.reflectance, 1.0)


@pytest.mark.parametrize("camera", [PERSPECTIVE, ORTHOGRAPHIC])
def test_both_cameras_send_our_rays_and_cut_nothing_off(camera: dict[str, Any], tmp_path: Path) -> None:
    scene = build(camera=camera, objects=[FLOOR], lights=[POINT, SUN | {"direction": (0.3, -2.0, 0.7)}])
    document = document_of(scene, tmp_path)
    assert_same_camera(document, scene)
    assert_same_lights(document, scene)
    (node,) = nodes_with(document, "camera")
    to_camera = np.linalg.inv(np.array(node["matrix"]).reshape(4, 4).T)
    depths = -(triangles_of_scene(scene).reshape(-1, 3) @ to_camera[:3, :3].T + to_camera[:3, 3])[:, 2]
    lens = document["cameras"][0][camera["projection"]]
    in_front = depths[depths > 0]
    assert lens["znear"] < in_front.min()
    assert in_front.max() < lens["zfar"]


def test_behind_the_camera_planes_are_still_valid(tmp_path: Path) -> None:
    for camera in (PERSPECTIVE, ORTHOGRAPHIC):
        turned = camera | {"look_at": (0.3, 1.2, 9.0)}
        document_of(build(camera=turned, objects=[FLOOR]), tmp_path)


def test_diffuse_surfaces_have_no_specular_layer_and_mirrors_nothing_else(tmp_path: Path) -> None:
    grey = {"mirror": {"reflectance": (0.7, 0.7, 0.7)}}
    materials = {"m": RED | LAMP, "mirror": grey, "dark": {"emission": {"radiance": (0.0, 0.0, 0.0)}}}
    objects = [FLOOR | {"material": name} for name in materials]
    lit, mirror, dark = document_of(build(materials=materials, objects=objects), tmp_path)["materials"]
    assert lit["extensions"]["KHR_materials_specular"] == {"specularFactor": 0.0}
    strength = lit["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"]
    assert [factor * strength for factor in lit["emissiveFactor"]] == pytest.approx([2.0, 3.0, 4.0])
    # KHR_materials_specular weights the layer with factor · Fresnel, and at an index of 0 Fresnel's term is 1.
    assert mirror["extensions"] == {
        "KHR_materials_specular": {"specularFactor": 0.7},
        "KHR_materials_ior": {"ior": 0.0},
    }
    assert mirror["pbrMetallicRoughness"]["baseColorFactor"] == [0.0, 0.0, 0.0, 1.0]
    assert mirror["pbrMetallicRoughness"]["roughnessFactor"] == 0.0
    assert dark["emissiveFactor"] == [0.0, 0.0, 0.0]
    assert all(material["doubleSided"] for material in (lit, mirror, dark))


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"objects": []}, "spheres"),
        ({"materials": {"m": {"diffuse": {"reflectance": BOARD}}}}, "checkerboard"),
        ({"materials": {"m": {"emission": {"radiance": BOARD}}}}, "checkerboard"),
        ({"materials": {"m": GLASS}}, "glass"),
        ({"materials": {"m": RED | {"mirror": {"reflectance": (0.5, 0.5, 0.5)}}}}, "weakens"),
        ({"materials": {"m": {"mirror": {"reflectance": (0.5, 0.5, 0.4)}}}}, "grazing"),
        ({"materials": {"m": {"mirror": {"reflectance": (1.5, 1.5, 1.5)}}}}, "at most 1"),
        ({"materials": {"m": {"diffuse": {"reflectance": (0.5, 1.5, 0.5)}}}}, "at most 1"),
        ({"convention": "whitted"}, "π"),
        ({"lights": [POINT | {"falloff": "none"}]}, "falls off"),
        (
            {"materials": {"m": {"specular": {"reflectance": (1.0, 1.0, 1.0), "exponent": 9.0, "model": "blinn"}}}},
            "specular",
        ),
        (
            {"ambient_light": (1.0, 1.0, 1.0), "materials": {"m": {"ambient": {"reflectance": (1.0, 1.0, 1.0)}}}},
            "ambient",
        ),
        (
            {
                "camera": PERSPECTIVE | {"inside": "tea"},
                "materials": {"m": RED, "tea": {"dielectric": GLASS["dielectric"] | {"absorption": (0.1, 0.2, 0.3)}}},
            },
            "absorbs",
        ),
    ],
)
def test_what_gltf_cannot_say_is_refused(changes: dict[str, Any], word: str, tmp_path: Path) -> None:
    scene = build() if changes == {"objects": []} else build(**({"objects": [FLOOR]} | changes))
    assert word in (refuses(scene) or "")
    with pytest.raises(ValueError, match="because"):
        export_gltf(scene, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_what_is_rounded_or_left_out_is_told() -> None:
    exact = build(objects=[FLOOR], materials={"m": MIRROR | {"mirror": {"reflectance": (1.0, 1.0, 1.0)}}})
    assert len(notes(exact)) == 1
    rounded = build(objects=[FLOOR | {"vertices": ((0.1, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))}])
    assert "1 of 9 coordinates are rounded to float32, by at most 1.5e-09" in notes(rounded)
    assert any("background" in note for note in notes(build(objects=[FLOOR], background={"color": (0.0, 0.0, 1.0)})))
    assert any("lumen" in note for note in notes(build(objects=[FLOOR], lights=[SUN])))


BREAKS: dict[str, Callable[[dict[str, Any]], object]] = {
    "3.2": lambda d: d["asset"].update(version="1.0"),
    "3.12": lambda d: d["extensionsUsed"].pop(),
    "JSON schema: animations": lambda d: d.update(animations=[]),
    "3.6.1: media": lambda d: d["buffers"][0].update(uri=d["buffers"][0]["uri"].replace("octet-stream", "json")),
    "3.6.1: byteLength": lambda d: d["buffers"][0].update(byteLength=10_000),
    "3.6.1: the view fits": lambda d: d["bufferViews"][1].update(byteLength=1_000),
    "3.6.1: a view holds": lambda d: d["bufferViews"][1].update(target=34962),
    "3.6.2.4: offsets": lambda d: d["bufferViews"][1].update(byteOffset=35),
    "3.6.2.4: vertices": lambda d: d["bufferViews"][0].update(byteOffset=2),
    "3.6.2.4: the accessor": lambda d: d["accessors"][0].update(count=2) or d["bufferViews"][0].update(byteLength=20),
    "3.6.2.5": lambda d: d["accessors"][0]["max"].__setitem__(0, 4.5),
    "3.7.2.1: positions": lambda d: d["accessors"][0].update(type="VEC2"),
    "3.7.2.1: indices": lambda d: d["accessors"][1].update(count=2),
    "3.3: the material": lambda d: d["meshes"][0]["primitives"][0].update(material=7),
    "3.3: the camera": lambda d: d["nodes"][1].update(camera=3),
    "3.5.2": lambda d: d["nodes"][1]["matrix"].__setitem__(0, 2.0),
    "3.5.1": lambda d: d["scenes"][0]["nodes"].pop(),
    "3.10.3.2": lambda d: d["cameras"][0]["perspective"].update(znear=0),
    "3.9": lambda d: d["materials"][0]["pbrMetallicRoughness"].update(roughnessFactor=1.5),
    "KHR_materials_ior": lambda d: d["materials"][0]["extensions"].update(KHR_materials_ior={"ior": 0.5}),
    "KHR_lights_punctual: each": lambda d: d["nodes"].pop(),
    "KHR_lights_punctual, JSON": lambda d: d["extensions"]["KHR_lights_punctual"]["lights"][0].update(color=[2, 0, 0]),
}


@pytest.mark.parametrize("violation", BREAKS)
def test_a_document_that_breaks_the_specification_is_found(violation: str, tmp_path: Path) -> None:
    document = document_of(build(objects=[FLOOR], lights=[POINT]), tmp_path)
    broken = copy.deepcopy(document)
    BREAKS[violation](broken)
    assert any(found.startswith(violation) for found in violations(broken))
