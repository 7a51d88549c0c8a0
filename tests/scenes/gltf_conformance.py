"""What the glTF 2.0 specification demands of the parts that we write, as checks of a document.

Each check has the section it is from (Khronos, "glTF 2.0 Specification", version 2.0.1).
"""

from __future__ import annotations

from base64 import b64decode
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

TYPES = {5121: np.dtype("<u1"), 5123: np.dtype("<u2"), 5125: np.dtype("<u4"), 5126: np.dtype("<f4")}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
FLOAT, VERTICES, INDICES = 5126, 34962, 34963


def accessor_values(document: dict[str, Any], index: int) -> np.ndarray[Any, Any]:
    """The numbers of an accessor, shape (count, components)."""
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    _, _, text = document["buffers"][view["buffer"]]["uri"].partition(";base64,")
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    kind, width = TYPES[accessor["componentType"]], COMPONENTS[accessor["type"]]
    numbers = np.frombuffer(b64decode(text, validate=True), kind, accessor["count"] * width, start)
    return numbers.reshape(-1, width)


def violations(document: dict[str, Any]) -> list[str]:
    """What the document breaks; empty if it conforms."""
    checks = (_asset, _extensions, _buffers, _accessors, _meshes, _nodes, _cameras, _materials, _lights)
    return [violation for check in checks for violation in check(document)]


def _asset(document: dict[str, Any]) -> Iterator[str]:
    if document.get("asset", {}).get("version") != "2.0":
        yield "3.2: asset.version"


def _keys_of_extensions(value: Any) -> Iterator[str]:
    if isinstance(value, dict):
        yield from value.get("extensions", ())
        value = list(value.values())
    if isinstance(value, list):
        for member in value:
            yield from _keys_of_extensions(member)


def _extensions(document: dict[str, Any]) -> Iterator[str]:
    listed = document.get("extensionsUsed", [])
    if set(_keys_of_extensions(document)) != set(listed) or len(set(listed)) != len(listed):
        yield "3.12: extensionsUsed lists all extensions, each once"
    for key, value in document.items():
        if isinstance(value, list) and not value:
            yield f"JSON schema: {key} is not empty"


def _buffers(document: dict[str, Any]) -> Iterator[str]:
    for buffer in document["buffers"]:
        kind, _, text = buffer["uri"].partition(";base64,")
        if kind not in {"data:application/octet-stream", "data:application/gltf-buffer"}:
            yield "3.6.1: media type of the data"
        if len(b64decode(text, validate=True)) < buffer["byteLength"]:
            yield "3.6.1: byteLength of the buffer"
    for view in document["bufferViews"]:
        if view.get("byteOffset", 0) + view["byteLength"] > document["buffers"][view["buffer"]]["byteLength"]:
            yield "3.6.1: the view fits its buffer"


def _accessors(document: dict[str, Any]) -> Iterator[str]:
    for accessor in document["accessors"]:
        view = document["bufferViews"][accessor["bufferView"]]
        size = TYPES[accessor["componentType"]].itemsize
        offset = accessor.get("byteOffset", 0)
        if offset % size or (offset + view.get("byteOffset", 0)) % size:
            yield "3.6.2.4: offsets are multiples of the component's size"
        if view.get("target") == VERTICES and (offset % 4 or view.get("byteOffset", 0) % 4):
            yield "3.6.2.4: vertices start at multiples of 4"
        length = accessor["count"] * size * COMPONENTS[accessor["type"]]
        if accessor["count"] < 1 or offset + length > view["byteLength"]:
            yield "3.6.2.4: the accessor fits its view"


def _meshes(document: dict[str, Any]) -> Iterator[str]:
    for primitive in (part for mesh in document["meshes"] for part in mesh["primitives"]):
        index = primitive["attributes"]["POSITION"]
        accessor = document["accessors"][index]
        positions = accessor_values(document, index)
        if (accessor["type"], accessor["componentType"]) != ("VEC3", FLOAT):
            yield "3.7.2.1: positions are three floats"
        if not np.isfinite(positions).all():
            yield "3.6.2.2: no NaN and no infinity"
        bounds = [positions.min(axis=0).tolist(), positions.max(axis=0).tolist()]
        if [accessor.get("min"), accessor.get("max")] != bounds:
            yield "3.6.2.5: min and max are those of the stored positions"
        corners = accessor_values(document, primitive["indices"])
        if corners.dtype.kind != "u" or len(corners) % 3 or corners.max() >= len(positions):
            yield "3.7.2.1: indices of triangles"
        targets = [
            document["bufferViews"][document["accessors"][i]["bufferView"]].get("target")
            for i in (index, primitive["indices"])
        ]
        if targets != [VERTICES, INDICES]:
            yield "3.6.1: a view holds vertices or indices"
        if not 0 <= primitive["material"] < len(document["materials"]):
            yield "3.3: the material exists"


def _nodes(document: dict[str, Any]) -> Iterator[str]:
    for node in document["nodes"]:
        if "matrix" in node:
            matrix = np.array(node["matrix"]).reshape(4, 4).T
            if not np.allclose(matrix[:3, :3] @ matrix[:3, :3].T, np.eye(3), atol=1e-12):
                yield "3.5.2: a matrix that is a rotation and a translation"
            if np.linalg.det(matrix[:3, :3]) < 0 or matrix[3].tolist() != [0, 0, 0, 1]:
                yield "3.5.2: a matrix that is a rotation and a translation"
        for key, things in (("mesh", "meshes"), ("camera", "cameras")):
            if key in node and not 0 <= node[key] < len(document[things]):
                yield f"3.3: the {key} of the node exists"
    for scene in document["scenes"]:
        if sorted(scene["nodes"]) != list(range(len(document["nodes"]))):
            yield "3.5.1: each node is in the scene, once"


def _cameras(document: dict[str, Any]) -> Iterator[str]:
    for camera in document["cameras"]:
        lens = camera[camera["type"]]
        if camera["type"] == "perspective" and not (
            lens["yfov"] > 0 and lens["aspectRatio"] > 0 and 0 < lens["znear"] < lens.get("zfar", np.inf)
        ):
            yield "3.10.3.2: a perspective camera"
        if camera["type"] == "orthographic" and not (
            lens["xmag"] > 0 and lens["ymag"] > 0 and 0 <= lens["znear"] < lens["zfar"]
        ):
            yield "3.10.3.3: an orthographic camera"


def _materials(document: dict[str, Any]) -> Iterator[str]:
    for material in document["materials"]:
        base = material["pbrMetallicRoughness"]
        extensions = material.get("extensions", {})
        fractions = [
            *base["baseColorFactor"],
            base["metallicFactor"],
            base["roughnessFactor"],
            *material.get("emissiveFactor", ()),
            extensions.get("KHR_materials_specular", {}).get("specularFactor", 1.0),
        ]
        if len(base["baseColorFactor"]) != 4 or not all(0 <= fraction <= 1 for fraction in fractions):
            yield "3.9: factors from 0 to 1"
        index = extensions.get("KHR_materials_ior", {}).get("ior", 1.5)
        if index != 0 and index < 1:
            yield "KHR_materials_ior: 0, or 1 or more"
        if extensions.get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0) < 0:
            yield "KHR_materials_emissive_strength: 0 or more"


def _lights(document: dict[str, Any]) -> Iterator[str]:
    lights = document.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    used = [
        node["extensions"]["KHR_lights_punctual"]["light"]
        for node in document["nodes"]
        if "KHR_lights_punctual" in node.get("extensions", {})
    ]
    if sorted(used) != list(range(len(lights))):
        yield "KHR_lights_punctual: each light is at a node"
    for light in lights:
        color = light.get("color", [1, 1, 1])
        if light["type"] not in {"point", "directional"} or light.get("intensity", 1) < 0 or not min(color) >= 0:
            yield "KHR_lights_punctual: a light"
        if max(color) > 1:
            yield "KHR_lights_punctual, JSON schema: a colour up to 1"
