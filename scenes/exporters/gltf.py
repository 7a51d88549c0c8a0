"""Writes a scene as a glTF 2.0 file that holds all its data.

Radiant intensity in W/sr is written as luminous intensity in cd, irradiance as lx and radiance as cd/m²: one common
factor, which the exposure of a viewer undoes. (By the definition of the candela it is 683 lm/W at 540 THz; SI
brochure, 9th edition, 2.3.1. For three channels of a colour there is no such number.)
"""

from __future__ import annotations

import math
from base64 import b64encode
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.scenes.exporters.gltf_limits import notes, refuses
from raytruth.scenes.exporters.gltf_materials import color_and_strength, gltf_material
from raytruth.scenes.exporters.json_text import json_text
from raytruth.scenes.exporters.triangle_soup import triangle_lists, triangles_of_scene
from raytruth.scenes.lights import PointLight
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.scenes.lights import Light
    from raytruth.scenes.scene import Scene

SCENE_FILE = "scene.gltf"
# Numbers of glTF's specification for kinds of data ("Accessor Data Types") and for what a buffer view is used as.
UNSIGNED_INT, FLOAT = 5125, 5126
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
# A perspective camera of glTF needs a near plane. Where a triangle reaches behind the camera no distance is right: this
# fraction of the farthest is small beside all that a picture shows.
NEAREST = 1e-9


def export_gltf(scene: Scene, folder: Path) -> Path:
    """Write `scene` to `folder` and return the path of the file.

    Raises ValueError where `refuses(scene)`, OSError if it cannot be written.
    """
    reason = refuses(scene)
    if reason:
        raise ValueError(f"scene {scene.name!r} cannot be written as glTF, because {reason}")
    names = list(dict.fromkeys(shape.material for shape in scene.objects))
    document: dict[str, Any] = {
        "asset": {
            "version": "2.0",
            "generator": "raytruth",
            "extras": {"name": scene.name, "purpose": scene.purpose, "notes": notes(scene)},
        },
        "scene": 0,
        "materials": [gltf_material(name, scene.materials[name]) for name in names],
        "cameras": [_camera(scene)],
        **_geometry(scene, names),
    }
    nodes: list[dict[str, Any]] = [{"mesh": index} for index in range(len(scene.objects))]
    nodes += [{"name": "camera", "camera": 0, "matrix": _camera_matrix(scene)}]
    if scene.lights:
        document["extensions"] = {"KHR_lights_punctual": {"lights": [_light(light) for light in scene.lights]}}
        nodes += [_light_node(index, light) for index, light in enumerate(scene.lights)]
    document |= {"nodes": nodes, "scenes": [{"nodes": list(range(len(nodes)))}]}
    used = {key for part in (document, *document["materials"]) for key in part.get("extensions", ())}
    path = folder / SCENE_FILE
    path.write_text(json_text({**document, "extensionsUsed": sorted(used)}), encoding="ascii", newline="\n")
    return path


def _geometry(scene: Scene, materials: list[str]) -> dict[str, Any]:
    """Meshes without normals: viewers "MUST calculate flat normals" for these ("Meshes", "Overview")."""
    data = bytearray()
    views, meshes = [], []
    accessors: list[dict[str, Any]] = []
    for index, shape in enumerate(scene.objects):
        assert not isinstance(shape, Sphere)  # such scenes are refused
        vertices, faces = triangle_lists(shape)
        positions = np.array(vertices, dtype="<f4")
        corners = np.array(faces, dtype="<u4").ravel()
        # Both kinds of numbers take 4 bytes, so that all offsets are multiples of 4, as they must be.
        for array, target in ((positions, ARRAY_BUFFER), (corners, ELEMENT_ARRAY_BUFFER)):
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes, "target": target})
            data += array.tobytes()
        bounds = {"min": positions.min(axis=0).tolist(), "max": positions.max(axis=0).tolist()}
        vertex_data = {"componentType": FLOAT, "type": "VEC3", "count": len(positions), **bounds}
        accessors.append({"bufferView": 2 * index, **vertex_data})
        corner_data = {"componentType": UNSIGNED_INT, "type": "SCALAR", "count": len(corners)}
        accessors.append({"bufferView": 2 * index + 1, **corner_data})
        primitive = {"attributes": {"POSITION": 2 * index}, "indices": 2 * index + 1}
        meshes.append({"primitives": [primitive | {"material": materials.index(shape.material)}]})
    uri = f"data:application/octet-stream;base64,{b64encode(data).decode('ascii')}"
    buffers = [{"byteLength": len(data), "uri": uri}]
    return {"meshes": meshes, "accessors": accessors, "bufferViews": views, "buffers": buffers}


def _camera(scene: Scene) -> dict[str, Any]:
    camera = scene.camera
    position = np.array(camera.position)
    forward = _unit(np.array(camera.look_at) - position)
    depths = (triangles_of_scene(scene).reshape(-1, 3) - position) @ forward
    aspect_ratio = camera.width / camera.height
    # Twice the way to the farthest corner, and half of that to the nearest, so that no rounding of a viewer cuts one
    # off. 1 if all are behind the camera. A far plane need not be stated, but VTK 9.7 takes none for one at 0.
    near, far = float(depths.min()) / 2, 2 * float(depths.max())
    far = far if far > 0 else 1.0
    if camera.projection == "perspective":
        lens = {"aspectRatio": aspect_ratio, "yfov": math.radians(camera.vertical_field_of_view)}
        planes = {"znear": near if near > 0 else NEAREST * far, "zfar": far}
        return {"type": "perspective", "perspective": lens | planes}
    half_height = camera.view_height / 2
    window = {"xmag": half_height * aspect_ratio, "ymag": half_height}
    return {"type": "orthographic", "orthographic": window | {"znear": 0.0, "zfar": far}}


def _camera_matrix(scene: Scene) -> list[float]:
    camera = scene.camera
    forward = np.array(camera.look_at) - np.array(camera.position)
    return _looking(forward, np.array(camera.up), np.array(camera.position))


def _looking(forward: NDArray[np.float64], up: NDArray[np.float64], position: NDArray[np.float64]) -> list[float]:
    """A node's matrix, by columns, that turns −z to `forward` and y upwards: cameras and lights look along −z."""
    matrix = np.eye(4)
    back = -_unit(forward)
    right = _unit(np.cross(up, back))
    matrix[:3] = np.column_stack([right, np.cross(back, right), back, position])
    return [float(number) for number in matrix.T.ravel()]


def _unit(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    scaled: NDArray[np.float64] = vector / np.abs(vector).max()
    return scaled / np.linalg.norm(scaled)


def _light(light: Light) -> dict[str, Any]:
    color, strength = color_and_strength(light.intensity if isinstance(light, PointLight) else light.irradiance)
    kind = "point" if isinstance(light, PointLight) else "directional"
    return {"type": kind, "color": color, "intensity": strength}


def _light_node(index: int, light: Light) -> dict[str, Any]:
    node: dict[str, Any] = {"extensions": {"KHR_lights_punctual": {"light": index}}}
    if isinstance(light, PointLight):
        return node | {"translation": list(light.position)}
    direction = np.array(light.direction)
    # Any direction upwards will do that is not along the light: the axis that it is farthest from.
    upwards = np.eye(3)[np.abs(direction).argmin()]
    return node | {"matrix": _looking(direction, upwards, np.zeros(3))}
