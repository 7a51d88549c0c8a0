"""A strict reader of the part of Wavefront OBJ that describes polygons (Wavefront, "Advanced Visualizer", appendix B1).

Statements that make no surface are read past, those that would make another one are refused; nothing is executed. The
grammar is in docs/scene-format.md, "OBJ".
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from raytruth.scenes.mesh_text import lines_of, number, shown, without_byte_order_mark
from raytruth.scenes.triangle_lists import (
    LARGEST_FACE_COUNT,
    MeshFileError,
    TriangleLists,
    check_coordinate,
    check_face_count,
    check_polygon,
    fan,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

# Normals, texture coordinates, names, materials, weights of bones and how things are shown change nothing: a scene
# states its own material. Points and curves have no area; what belongs to free-form geometry makes no surface without
# `surf`.
_READ_PAST = frozenset(
    b"vn vt vp "
    b"g s o mg usemtl mtllib usemap maplib bevel c_interp d_interp lod shadow_obj trace_obj vw "
    b"p l curv curv2 cdc cstype deg bmat step parm trim hole scrv sp end con ctech stech res".split()
)

_SURFACE = "makes a surface that is no polygon, which is not read; save it as a mesh of polygons."
_REFUSED = {
    b"surf": _SURFACE,
    b"bsp": _SURFACE,
    b"bzp": _SURFACE,
    b"cdp": _SURFACE,
    b"fo": "is an outline of a face as files before OBJ 2.11 state it; save it with faces that start with f.",
    b"call": "would read another file; put what that holds into this one.",
    b"csh": "would run a command, which no file makes raytruth do; remove the line.",
}

# Old libraries of C write numbers that are not finite as 1.#INF and -1.#IND, which is no number before a comment.
_COMMENT = re.compile(rb"(?<![0-9]\.)#")

# v, v/vt, v//vn or v/vt/vn, of which either slot may be empty; no file within the size limit needs ten digits.
_CORNER = re.compile(rb"([-+]?[0-9]{1,10})(?:/(?:[-+]?[0-9]{1,10})?){0,2}")

# One more than the largest face has with its f; what is left over stays one word of a statement that is too long.
_MOST_WORDS = 1 + LARGEST_FACE_COUNT + 2

# x y z alone, with a weight, with a colour, with a colour and its opacity.
_VERTEX_LENGTHS = (3, 4, 6, 7)
_LENGTH_WITH_WEIGHT = 4


@dataclass
class _Mesh:
    """What has been read so far."""

    vertices: list[tuple[float, float, float]] = field(default_factory=list)
    faces: list[tuple[int, int, int]] = field(default_factory=list)
    weights: dict[int, tuple[int, bytes]] = field(default_factory=dict)
    """The line and the weight of each vertex whose weight is not 1."""
    farthest: tuple[int, int] = (-1, 0)
    """The largest index of a face, and the line that states it; its vertex may come later."""


def read_obj(content: bytes) -> TriangleLists:
    """Vertices and triangles of an OBJ file; polygons become fans. Raises MeshFileError, which names the line."""
    mesh = _Mesh()
    for line, words in _statements(without_byte_order_mark(content)):
        try:
            _read(words, line, mesh)
        except MeshFileError as error:
            raise MeshFileError(f"line {line}: {error}") from error
    _check_references(mesh)
    return tuple(mesh.vertices), tuple(mesh.faces)


def _statements(content: bytes) -> Iterator[tuple[int, list[bytes]]]:
    """(number of the first line, words) of each statement; a backslash at the end of a line joins the next one."""
    parts: list[bytes] = []
    for line, text in enumerate(lines_of(content), start=1):
        if not (text or parts):
            continue
        comment = _COMMENT.search(text) if b"#" in text else None
        # A comment ends with its line: that its last character is a backslash, as of a path, means nothing.
        stated = text[: comment.start()] if comment else text
        if parts and parts[-1][-1:].strip() and stated[:1].strip():
            raise MeshFileError(f"line {line}: expected a blank before what continues line {line - 1}; add one.")
        # A backslash after a byte that is not ASCII is the second half of a Japanese or Chinese character.
        continued = not comment and text.endswith(b"\\") and text[-2:-1] < b"\x80"
        parts.append(text[:-1] if continued else stated)
        if continued:
            continue
        words = b" ".join(parts).split(None, _MOST_WORDS)
        first_line = line + 1 - len(parts)
        parts = []
        if words:
            yield first_line, words
    if parts:
        raise MeshFileError(f"ends within a statement: expected a line after the backslash that ends line {line}.")


def _read(words: list[bytes], line: int, mesh: _Mesh) -> None:
    keyword, *values = words
    if keyword in _READ_PAST:
        return
    if keyword == b"v":
        weight = _add_vertex(values, mesh)
        if weight is not None:
            mesh.weights[len(mesh.vertices) - 1] = (line, weight)
    elif keyword == b"f":
        check_face_count(len(mesh.faces) + len(values) - 2)
        corners = tuple(_corner(word, len(mesh.vertices)) for word in values)
        check_polygon(corners)
        mesh.farthest = max(mesh.farthest, (max(corners), line))
        mesh.faces += fan(corners)
    elif keyword in _REFUSED:
        raise MeshFileError(f"{shown(keyword)} {_REFUSED[keyword]}")
    else:
        raise MeshFileError(f"expected a statement of OBJ such as v or f, found {shown(keyword)}.")


def _add_vertex(words: list[bytes], mesh: _Mesh) -> bytes | None:
    """Its weight where that is not 1."""
    if len(words) not in _VERTEX_LENGTHS:
        raise MeshFileError(
            "expected 'v x y z', which a weight or a colour may follow, so 3, 4, 6 or 7 numbers, "
            f"found {shown(b'v', *words)}."
        )
    # A colour is read past, since some programs write nan where they have none.
    x, y, z = (check_coordinate(number(word)) for word in words[:3])
    mesh.vertices.append((x, y, z))
    return words[3] if len(words) == _LENGTH_WITH_WEIGHT and number(words[3]) != 1 else None


def _corner(word: bytes, vertex_count: int) -> int:
    """The index of a vertex from 0, not checked to be there."""
    match = _CORNER.fullmatch(word)
    if match is None:
        raise MeshFileError(f"expected a vertex number such as 3, 3/1, 3//2 or 3/1/2, found {shown(word)}.")
    stated = int(match[1])
    if stated == 0:
        raise MeshFileError("expected vertex numbers that count from 1, found number 0.")
    # -1 is the latest vertex.
    index = stated - 1 if stated > 0 else vertex_count + stated
    if index < 0:
        raise MeshFileError(f"expected one of the {vertex_count} vertices above this line, found number {stated}.")
    return index


def _check_references(mesh: _Mesh) -> None:
    """What only the whole file tells about the vertices of its faces."""
    if not mesh.faces:
        raise MeshFileError("has no faces: expected at least one line that starts with f.")
    index, line = mesh.farthest
    if index >= len(mesh.vertices):
        raise MeshFileError(
            f"line {line}: expected one of the file's {len(mesh.vertices)} vertices, found number {index + 1}."
        )
    if mesh.weights:
        used = {corner for face in mesh.faces for corner in face}
        for vertex, (line_of_vertex, weight) in mesh.weights.items():
            if vertex in used:
                raise MeshFileError(
                    f"line {line_of_vertex}: expected the weight 1, or none, of a face's vertex, "
                    f"found {shown(weight)}, which some programs divide by and others leave out."
                )
