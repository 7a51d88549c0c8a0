"""A valid scene to spoil, and what loading says to it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from raytruth.scenes.loading import SceneError, load_scene
from raytruth.scenes.scene import Scene
from raytruth.scenes.triangle_lists import MeshFileError

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.scenes.triangle_lists import TriangleLists


def valid_scene() -> dict[str, Any]:
    """A scene with every kind of part, which loads without problems when it has the file `tetrahedron.obj`."""
    return {
        "purpose": "Something to spoil.",
        "convention": "whitted",
        "max_depth": 3,
        "camera": {
            "projection": "perspective",
            "vertical_field_of_view": 40,
            "position": [0.0, 1.0, 5.0],
            "look_at": [0.0, 0.0, 0.0],
            "up": [0.0, 1.0, 0.0],
            "width": 8,
            "height": 6,
        },
        "background": {"bottom": [0.1, 0.2, 0.3], "top": [0.3, 0.2, 0.1]},
        "ambient_light": [0.1, 0.1, 0.1],
        "lights": [
            {"kind": "point", "position": [1, 2, 3], "intensity": [4, 5, 6], "falloff": "inverse_square"},
            {"kind": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1]},
        ],
        "materials": {
            "red": {
                "ambient": {"reflectance": [0.1, 0.0, 0.0]},
                "diffuse": {"reflectance": [0.9, 0.1, 0.1]},
                "specular": {"reflectance": [0.5, 0.5, 0.5], "exponent": 20, "model": "phong"},
            },
            "board": {"diffuse": {"reflectance": {"checkerboard": {"even": [0, 0, 0], "odd": [1, 1, 1]}}}},
            "glass": {"dielectric": {"index_of_refraction": 1.5}},
            "bubble": {"dielectric": {"index_of_refraction": 1.0, "outside": "glass"}},
        },
        "objects": [
            {"shape": "sphere", "center": [0, 0, 0], "radius": 1, "material": "red"},
            {"shape": "triangle", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "material": "board"},
            {
                "shape": "mesh",
                "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                "faces": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
                "material": "glass",
            },
            {"shape": "mesh", "file": "tetrahedron.obj", "material": "bubble"},
        ],
    }


TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def changed(place: tuple[str | int, ...], value: object) -> dict[str, Any]:
    """The valid scene with one value set; a key that is not there yet is added."""
    scene = valid_scene()
    part: Any = scene
    for step in place[:-1]:
        part = part[step]
    part[place[-1]] = value
    return scene


def write_scene(folder: Path, scene: object) -> Path:
    """Writes the scene and its mesh file; text is written as it is."""
    (folder / "tetrahedron.obj").write_text(TETRAHEDRON, encoding="utf-8")
    path = folder / "spoilt.json"
    path.write_text(scene if isinstance(scene, str) else json.dumps(scene), encoding="utf-8")
    return path


def loaded(path: Path) -> Scene | SceneError:
    """The scene, or the error that tells why there is none; anything else that is raised passes through."""
    try:
        return load_scene(path)
    except SceneError as error:
        return error


def problems(folder: Path, scene: object) -> list[str]:
    """What loading says, without the file's name in front of each sentence; empty if the scene loads."""
    path = write_scene(folder, scene)
    result = loaded(path)
    if isinstance(result, Scene):
        return []
    assert all(problem.startswith(f"{path}: ") for problem in result.problems)
    return [problem.removeprefix(f"{path}: ") for problem in result.problems]


def is_triangles_or_a_sentence(reader: Callable[[bytes], TriangleLists], content: bytes) -> bool:
    """Whether a mesh reader answers with indices that fit its vertices, or refuses in one line."""
    try:
        vertices, faces = reader(content)
    except MeshFileError as error:
        return "\n" not in str(error)
    return all(0 <= index < len(vertices) for face in faces for index in face)
