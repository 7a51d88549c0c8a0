"""Mesh files beside a scene: found only inside the scene's folder, and read with limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.obj_file import read_obj
from raytruth.scenes.ply_file import read_ply
from raytruth.scenes.triangle_lists import MeshFileError, TriangleLists
from raytruth.scenes.wording import quoted

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.scenes.shapes import Mesh

# Enough for the largest number of faces (triangle_lists.py) in OBJ, whose lines take about 80 bytes a face in all.
LARGEST_MESH_FILE = 64 * 2**20

_READERS: dict[str, Callable[[bytes], TriangleLists]] = {".obj": read_obj, ".ply": read_ply}


def with_triangles(mesh: Mesh, folder: Path) -> Mesh:
    """The mesh with its vertices and faces: its own, or those of its file, which must lie in `folder`.

    Raises MeshFileError, whose message is one sentence, for a mesh with both or neither, and for a file that is
    missing, outside, too large or broken.
    """
    inline = bool(mesh.vertices or mesh.faces)
    if mesh.file is None:
        if not (mesh.vertices and mesh.faces):
            raise MeshFileError("expected either a file, or both vertices and faces.")
        return mesh
    if inline:
        raise MeshFileError("expected either a file or vertices and faces, found both; remove one.")
    vertices, faces = _read(mesh.file, folder)
    return mesh.model_copy(update={"vertices": vertices, "faces": faces})


def _read(name: str, folder: Path) -> TriangleLists:
    try:
        path = (folder / name).resolve()
        if not path.is_relative_to(folder.resolve()):
            raise MeshFileError(f"expected a file inside the scene's folder, found {quoted(name)}; move it there.")
        if not path.is_file():
            raise MeshFileError(f"expected a mesh file beside the scene, found no file {quoted(name)}.")
        reader = _READERS.get(path.suffix.lower())
        if reader is None:
            raise MeshFileError(f"expected a file that ends in .obj or .ply, found {quoted(name)}.")
        with path.open("rb") as file:
            content = file.read(LARGEST_MESH_FILE + 1)
    except (OSError, ValueError, RuntimeError) as error:
        # ValueError: a NUL character in the name; RuntimeError: symbolic links that run in a circle.
        raise MeshFileError(f"expected a readable mesh file, but {quoted(name)} cannot be read: {error}.") from error
    if len(content) > LARGEST_MESH_FILE:
        raise MeshFileError(
            f"expected a mesh file of at most {LARGEST_MESH_FILE // 2**20} MiB, which bounds the memory it can take; "
            f"{quoted(name)} is larger."
        )
    try:
        return reader(content)
    except MeshFileError as error:
        raise MeshFileError(f"{quoted(name)} {error}") from error
