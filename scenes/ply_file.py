"""A strict reader of polygons in PLY files, text and binary (Turk, "The PLY Polygon File Format", 1994).

A file is a header, then the rows of each element in turn; a row has the element's properties, of which each is a number
or a list that begins with its length. Elements and properties other than ours are read past. The grammar is in
docs/scene-format.md, "PLY".
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.mesh_text import shown
from raytruth.scenes.ply_header import INTEGER_CODES, read_header
from raytruth.scenes.ply_rows import rows_of
from raytruth.scenes.triangle_lists import (
    MeshFileError,
    TriangleLists,
    check_coordinate,
    check_face_count,
    check_polygon,
    fan,
)

if TYPE_CHECKING:
    from raytruth.scenes.ply_header import Element

_AXES = (b"x", b"y", b"z")

# Two names are in use for the list of a face's vertices.
_INDEX_LISTS = {b"vertex_indices", b"vertex_index"}

_INTEGERS = frozenset(INTEGER_CODES.values())


def read_ply(content: bytes) -> TriangleLists:
    """Vertices and triangles of a PLY file; polygons become fans. Raises MeshFileError, which names line or row."""
    header = read_header(content)
    vertex, corners = _our_properties({element.name: element for element in header.elements})
    vertices: list[tuple[float, float, float]] = []
    faces: list[tuple[int, int, int]] = []
    for element, place, row in rows_of(header, {b"vertex": frozenset(_AXES), b"face": frozenset([corners])}):
        try:
            if element is vertex:
                x, y, z = (check_coordinate(row[axis][0]) for axis in _AXES)
                vertices.append((x, y, z))
            else:
                check_face_count(len(faces) + len(row[corners]) - 2)
                faces += fan(_polygon(row[corners], vertex.count))
        except MeshFileError as error:
            raise MeshFileError(f"{place}: {error}") from error
    if not faces:
        raise MeshFileError("has no faces: expected at least one.")
    return tuple(vertices), tuple(faces)


def _our_properties(elements: dict[bytes, Element]) -> tuple[Element, bytes]:
    """The vertices, and the name of the faces' list of vertices."""
    vertex, face, strips = (elements.get(name) for name in (b"vertex", b"face", b"tristrips"))
    if strips is not None and strips.count:
        raise MeshFileError("has triangle strips (element 'tristrips'), which are not read; save it with faces.")
    if vertex is None or not vertex.names(lists=False).issuperset(_AXES):
        raise MeshFileError("expected an element 'vertex' with the properties x, y and z, which are numbers.")
    lists = _INDEX_LISTS & face.names(lists=True) if face is not None else set()
    if face is None or len(lists) != 1:
        raise MeshFileError(
            "expected an element 'face' with one list that is 'vertex_indices' or 'vertex_index', "
            f"found {'no element face' if face is None else 'both' if lists else 'neither'}."
        )
    [corners] = lists
    if any(property_.name == corners and property_.code not in _INTEGERS for property_ in face.properties):
        raise MeshFileError(f"expected whole numbers as the type of {shown(corners)}, found float or double.")
    return vertex, corners


def _polygon(corners: tuple[float, ...], vertex_count: int) -> tuple[int, ...]:
    for corner in corners:
        if not 0 <= corner < vertex_count:
            raise MeshFileError(
                f"expected one of the file's {vertex_count} vertices, counted from 0, found number {corner}."
            )
    polygon = tuple(map(int, corners))
    check_polygon(polygon)
    return polygon
