"""Reads triangles from PLY files through the library plyfile."""

from __future__ import annotations

import io
import warnings

import numpy as np
from plyfile import PlyData, PlyParseError

from scenes.triangle_lists import MeshFileError, TriangleLists, check_coordinate, check_face_count, fan

# Two names are in use for the list of a face's vertices.
_INDEX_LISTS = ("vertex_indices", "vertex_index")


def read_ply(content: bytes) -> TriangleLists:
    """Vertices and faces, polygons split into fans. Raises MeshFileError."""
    _check_header(content)
    try:
        with warnings.catch_warnings():
            # NumPy warns about lists that end early, which plyfile then takes for empty.
            warnings.simplefilter("error", UserWarning)
            # From memory, so that a false list length cannot reserve more memory than the file has bytes.
            data = PlyData.read(io.BytesIO(content))
    except (PlyParseError, ValueError, TypeError, OverflowError, UserWarning) as error:
        raise MeshFileError(f"is no valid PLY file: {error}.") from error
    elements = {element.name: element for element in data.elements}
    vertex, face = elements.get("vertex"), elements.get("face")
    if vertex is None or not {"x", "y", "z"} <= set(vertex.data.dtype.names or ()):
        raise MeshFileError("expected an element 'vertex' with the properties x, y and z.")
    indices = next((name for name in _INDEX_LISTS if face is not None and name in (face.data.dtype.names or ())), None)
    if face is None or indices is None:
        raise MeshFileError("expected an element 'face' with a property list 'vertex_indices'.")
    try:
        columns = [np.asarray(vertex[axis], dtype=np.float64) for axis in "xyz"]
    except (TypeError, ValueError) as error:
        raise MeshFileError("expected x, y and z to be numbers, found lists.") from error
    vertices = tuple(
        (_coordinate(x, i), _coordinate(y, i), _coordinate(z, i))
        for i, (x, y, z) in enumerate(zip(*columns, strict=True))
    )
    faces = [
        triangle for i, polygon in enumerate(face[indices]) for triangle in fan(_polygon(polygon, len(vertices), i))
    ]
    if not faces:
        raise MeshFileError("has no faces: expected at least one.")
    check_face_count(len(faces))
    return vertices, tuple(faces)


def _check_header(content: bytes) -> None:
    """Refuses numbers of elements that the file cannot hold, before memory is reserved for them."""
    header = content.partition(b"end_header")[0]
    count, properties, total = 0, 0, 0
    for line in [*header.splitlines(), b"element end 0"]:
        words = line.split()
        if words[:1] == [b"property"]:
            properties += 1
        if words[:1] == [b"element"] and len(words) == 3:
            total += count * max(properties, 1)
            properties = 0
            try:
                count = int(words[2])
            except ValueError:
                count = 0  # plyfile names the line
    if total > len(content):
        raise MeshFileError(f"claims {total} values, more than fit into its {len(content)} bytes.")


def _coordinate(value: np.float64, index: int) -> float:
    return check_coordinate(float(value), f"vertex {index}")


def _polygon(polygon: object, vertex_count: int, index: int) -> tuple[int, ...]:
    corners = np.atleast_1d(np.asarray(polygon))
    if len(corners) < 3 or corners.dtype.kind not in "iu":
        raise MeshFileError(f"face {index}: expected a list of at least three whole numbers, found {len(corners)}.")
    for corner in corners:
        if not 0 <= corner < vertex_count:
            raise MeshFileError(f"face {index}: expected vertex numbers from 0 to {vertex_count - 1}, found {corner}.")
    return tuple(int(corner) for corner in corners)
