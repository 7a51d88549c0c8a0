"""Writes a scene as a scene file of our own, with the meshes of its mesh files in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.exporters.json_text import json_text
from raytruth.scenes.exporters.obj_lines import face_lines, vertex_lines
from raytruth.scenes.loading import LARGEST_SCENE_FILE, MOST_MESH_FILES
from raytruth.scenes.mesh_files import LARGEST_MESH_FILE
from raytruth.scenes.shapes import Mesh

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene


def refuses(scene: Scene) -> str | None:
    """Why the scene cannot be written, in one clause that follows 'because'; None if it can."""
    if _files(scene) is None:
        return "its text would be longer than raytruth reads, or need too many mesh files"
    return None


def notes(scene: Scene) -> list[str]:
    """What is written otherwise than the scene states it, each in one clause."""
    if len(_files(scene) or ()) > 1:
        return ["the meshes are files beside it, since a scene file that held them would be too long"]
    return []


def export_json(scene: Scene, folder: Path) -> Path:
    """Write `scene` to `folder` and return the path of the scene file, which has the scene's name.

    Meshes are in it, or in OBJ files beside it where it would be longer than may be read. It loads as the same scene
    but for the names of mesh files. Raises ValueError where `refuses(scene)`, OSError if it cannot be written.
    """
    files = _files(scene)
    if files is None:
        raise ValueError(f"scene {scene.name!r} cannot be written as JSON, because {refuses(scene)}")
    for name, text in files.items():
        (folder / name).write_text(text, encoding="ascii", newline="\n")
    return folder / _scene_file(scene)


def _scene_file(scene: Scene) -> str:
    return f"{scene.name or 'scene'}.json"


def _files(scene: Scene) -> dict[str, str] | None:
    """The text of each file by its name, with as few files as can be; None if none of them could be read again."""
    embedded = {_scene_file(scene): _text(scene, {})}
    meshes = {index: shape for index, shape in enumerate(scene.objects) if isinstance(shape, Mesh)}
    names = {index: f"mesh-{index}.obj" for index in meshes}
    if _can_be_read(scene, embedded) or len(meshes) > MOST_MESH_FILES:
        return embedded if _can_be_read(scene, embedded) else None
    beside = {name: _mesh_text(meshes[index]) for index, name in names.items()}
    beside[_scene_file(scene)] = _text(scene, names)
    return beside if _can_be_read(scene, beside) else None


def _can_be_read(scene: Scene, files: dict[str, str]) -> bool:
    """Whether loading takes files of these lengths; all of them are ASCII."""
    scene_file = _scene_file(scene)
    meshes = (len(text) for name, text in files.items() if name != scene_file)
    return len(files[scene_file]) <= LARGEST_SCENE_FILE and max(meshes, default=0) <= LARGEST_MESH_FILE


def _text(scene: Scene, mesh_files: dict[int, str]) -> str:
    """The scene file, with these files in place of the triangles of these objects."""
    objects = [
        shape.model_copy(
            update={"vertices": (), "faces": (), "file": mesh_files[index]} if index in mesh_files else {"file": None}
        )
        if isinstance(shape, Mesh)
        else shape
        for index, shape in enumerate(scene.objects)
    ]
    stated = scene.model_copy(update={"objects": tuple(objects)})
    return json_text(stated.model_dump(mode="json", exclude_defaults=True, exclude={"name"}))


def _mesh_text(mesh: Mesh) -> str:
    return "".join([*vertex_lines(mesh.vertices), *face_lines(mesh.faces, 1)])
