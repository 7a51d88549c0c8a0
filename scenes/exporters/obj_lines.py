"""Vertices and faces as Wavefront OBJ states them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.triangle_lists import Faces, Vertices


def vertex_lines(vertices: Vertices) -> Iterator[str]:
    """A line for each vertex, whose numbers read back as the same float64."""
    for vertex in vertices:
        yield f"v {' '.join(map(repr, vertex))}\n"


def face_lines(faces: Faces, first: int) -> Iterator[str]:
    """A line for each face; `first` is the number in the file, from 1, of the vertex that the faces call 0."""
    for face in faces:
        yield f"f {' '.join(str(index + first) for index in face)}\n"
