"""A strict reader of the part of Wavefront OBJ that describes triangles."""

from __future__ import annotations

import re

from raytruth.scenes.triangle_lists import MeshFileError, TriangleLists, check_coordinate, check_face_count, fan
from raytruth.scenes.wording import quoted

# Normals, texture coordinates, smoothing, names and materials change nothing: a scene states its own material.
_IGNORED = {"vn", "vt", "s", "g", "o", "usemtl", "mtllib"}

_DECIMAL = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
# v, v/vt, v//vn, v/vt/vn; nine digits hold more vertices than any file within the size limit.
_CORNER = re.compile(r"(-?\d{1,9})(/-?\d{1,9}|/-?\d{0,9}/-?\d{1,9})?", re.ASCII)


def read_obj(content: bytes) -> TriangleLists:
    """Vertices and faces, polygons split into fans. Raises MeshFileError, which names the line."""
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise MeshFileError(f"is no OBJ text: byte {error.start} is not UTF-8.") from error
    vertices: list[tuple[float, float, float]] = []
    faces: list[tuple[int, int, int]] = []
    # Not splitlines(): it also breaks at characters that end no line in other programs.
    for number, line in enumerate(text.split("\n"), start=1):
        words = line.partition("#")[0].split()
        if not words or words[0] in _IGNORED:
            continue
        where = f"line {number}"
        if words[0] == "v":
            vertices.append(_vertex(words[1:], where))
        elif words[0] == "f":
            faces += fan(_polygon(words[1:], len(vertices), where))
            check_face_count(len(faces))
        else:
            raise MeshFileError(f"{where}: expected a line that starts with v or f, found {quoted(words[0])}.")
    if not faces:
        raise MeshFileError("has no faces: expected at least one line that starts with f.")
    return tuple(vertices), tuple(faces)


def _vertex(words: list[str], where: str) -> tuple[float, float, float]:
    if len(words) != 3 or not all(map(_DECIMAL.fullmatch, words)):
        raise MeshFileError(f"{where}: expected 'v x y z' with three numbers, found {quoted(' '.join(['v', *words]))}.")
    x, y, z = (check_coordinate(float(word), where) for word in words)
    return x, y, z


def _polygon(words: list[str], vertex_count: int, where: str) -> tuple[int, ...]:
    if len(words) < 3:
        raise MeshFileError(f"{where}: expected a face with at least three vertices, found {len(words)}.")
    return tuple(_corner(word, vertex_count, where) for word in words)


def _corner(word: str, vertex_count: int, where: str) -> int:
    match = _CORNER.fullmatch(word)
    if match is None:
        raise MeshFileError(f"{where}: expected a vertex number such as 3, 3/1 or 3/1/2, found {quoted(word)}.")
    index = int(match[1])
    # OBJ counts from 1, and backwards from the latest vertex with -1.
    from_zero = index - 1 if index > 0 else vertex_count + index
    if index == 0 or not 0 <= from_zero < vertex_count:
        raise MeshFileError(
            f"{where}: expected one of the {vertex_count} vertices stated above this line, found number {index}."
        )
    return from_zero
