"""A strict reader of triangles in PLY files, text and binary (Turk, "The PLY Polygon File Format", 1994).

A file is a header, then the rows of each element in turn; a row has the element's properties, of which each is a number
or a list that begins with its length. Elements and properties other than ours are read past.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.scenes.triangle_lists import (
    LARGEST_FACE_COUNT,
    MeshFileError,
    TriangleLists,
    check_coordinate,
    check_face_count,
    fan,
)
from raytruth.scenes.wording import quoted

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# The format's own names, and those with the size in bits, which are as common, for the codes of `struct`.
_TYPE_CODES = dict(zip(("char", "uchar", "short", "ushort", "int", "uint", "float", "double"), "bBhHiIfd", strict=True))
_TYPE_CODES |= zip(
    ("int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"), "bBhHiIfd", strict=True
)

_BYTE_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}

# Two names are in use for the list of a face's vertices.
_INDEX_LISTS = ("vertex_indices", "vertex_index")

# As many vertices as the largest mesh has corners.
_MOST_ROWS = 3 * LARGEST_FACE_COUNT

# A face with more corners is no face; it bounds what one false length can reserve.
_LONGEST_LIST = 2**16

Row = dict[str, list[float]]
"""The values of a row by property: a number is a list of one."""


@dataclass(frozen=True)
class _Property:
    name: str
    code: str
    length_code: str | None
    """The type of a list's length; None for a number."""


@dataclass(frozen=True)
class _Element:
    name: str
    count: int
    properties: list[_Property]

    def names(self, *, lists: bool) -> set[str]:
        return {property_.name for property_ in self.properties if (property_.length_code is not None) == lists}


def read_ply(content: bytes) -> TriangleLists:
    """Vertices and faces, polygons split into fans. Raises MeshFileError."""
    encoding, elements, body = _header(content)
    _check_size(elements, len(content))
    vertex, face, corners = _our_elements(elements)
    next_row = _text_rows(body) if encoding == "ascii" else _binary_rows(body, _BYTE_ORDERS[encoding])
    vertices: list[tuple[float, float, float]] = []
    faces: list[tuple[int, int, int]] = []
    for element in elements:
        for index in range(element.count):
            row = next_row(element, index)
            if element is vertex:
                vertices.append(_vertex(row, index))
            elif element is face:
                faces += fan(_polygon(row[corners], vertex.count, index))
                check_face_count(len(faces))
    if not faces:
        raise MeshFileError("has no faces: expected at least one.")
    return tuple(vertices), tuple(faces)


def _our_elements(elements: list[_Element]) -> tuple[_Element, _Element, str]:
    """The vertices, the faces, and the name of the faces' list of vertices."""
    vertex = next((element for element in elements if element.name == "vertex"), None)
    if vertex is None or not {"x", "y", "z"} <= vertex.names(lists=False):
        raise MeshFileError("expected an element 'vertex' with the properties x, y and z, which are numbers.")
    face = next((element for element in elements if element.name == "face"), None)
    corners = next((name for name in _INDEX_LISTS if face and name in face.names(lists=True)), None)
    if face is None or corners is None:
        raise MeshFileError("expected an element 'face' with a property list 'vertex_indices'.")
    return vertex, face, corners


def _header(content: bytes) -> tuple[str, list[_Element], bytes]:
    """The encoding, the elements, and what follows the header."""
    head, end, rest = content.partition(b"end_header")
    # A file of another system may end its lines with a carriage return as well; nothing else may follow.
    body = rest.removeprefix(b"\r")
    if not content.startswith(b"ply") or not end or not body.startswith(b"\n"):
        raise MeshFileError("is no valid PLY file: expected a header from a line 'ply' to a line 'end_header'.")
    encoding: str | None = None
    elements: list[_Element] = []
    for number, line in enumerate(head.decode("utf-8", "replace").splitlines()[1:], start=2):
        match line.split():
            case [] | ["comment" | "obj_info", *_]:
                pass
            case ["format", ("ascii" | "binary_little_endian" | "binary_big_endian") as stated, "1.0"]:
                encoding = stated
            case ["element", name, count] if count.isascii() and count.isdigit() and len(count) <= 18:
                elements.append(_Element(name, int(count), []))
            case ["property", type_, name] if elements and type_ in _TYPE_CODES:
                elements[-1].properties.append(_Property(name, _TYPE_CODES[type_], None))
            case ["property", "list", length, type_, name] if elements and {length, type_} <= _TYPE_CODES.keys():
                elements[-1].properties.append(_Property(name, _TYPE_CODES[type_], _TYPE_CODES[length]))
            case _:
                raise MeshFileError(
                    f"is no valid PLY file: line {number}: expected a format, element or property, "
                    f"found {quoted(line)}."
                )
    if encoding is None:
        raise MeshFileError("is no valid PLY file: expected a line such as 'format ascii 1.0' in its header.")
    return encoding, elements, body[1:]


def _check_size(elements: list[_Element], size: int) -> None:
    """Refuses numbers of rows that the file cannot hold, or no mesh needs, before memory is reserved for them."""
    total = sum(element.count * max(len(element.properties), 1) for element in elements)
    if total > size:
        raise MeshFileError(f"claims {total} values, more than fit into its {size} bytes.")
    for element in elements:
        if element.count > _MOST_ROWS:
            raise MeshFileError(f"has too many rows of {quoted(element.name)}: expected at most {_MOST_ROWS}.")
        if len({property_.name for property_ in element.properties}) < len(element.properties):
            raise MeshFileError(f"is no valid PLY file: {quoted(element.name)} has two properties of one name.")


def _text_rows(body: bytes) -> Callable[[_Element, int], Row]:
    """Gives the next row; a line each."""
    lines = (words for line in body.decode("utf-8", "replace").split("\n") if (words := line.split()))

    def next_row(element: _Element, index: int) -> Row:
        where = f"{element.name} {index}"
        words = iter(next(lines, []))
        row: Row = {}
        for property_ in element.properties:
            length = 1.0 if property_.length_code is None else _number(words, property_.length_code, where)
            row[property_.name] = [_number(words, property_.code, where) for _ in range(_length(length, where))]
        if next(words, None) is not None:
            raise MeshFileError(f"is no valid PLY file: {where}: expected fewer values on its line.")
        return row

    return next_row


def _number(words: Iterator[str], code: str, where: str) -> float:
    """The next word, rounded to float32 where that is the property's type, so that text and binary mean the same."""
    word = next(words, None)
    if word is None:
        raise MeshFileError(f"is no valid PLY file: {where}: expected a line with more values.")
    try:
        value: float = struct.unpack("f", struct.pack("f", float(word)))[0] if code == "f" else float(word)
    except (ValueError, OverflowError) as error:
        raise MeshFileError(f"is no valid PLY file: {where}: expected a number, found {quoted(word)}.") from error
    return value


def _binary_rows(body: bytes, order: str) -> Callable[[_Element, int], Row]:
    """Gives the next row."""
    position = 0

    def next_numbers(code: str, count: int, where: str) -> list[float]:
        nonlocal position
        form = f"{order}{count}{code}"
        try:
            numbers = struct.unpack_from(form, body, position)
        except struct.error as error:
            raise MeshFileError(f"is no valid PLY file: {where}: it ends before all values.") from error
        position += struct.calcsize(form)
        return list(numbers)

    def next_row(element: _Element, index: int) -> Row:
        where = f"{element.name} {index}"
        row: Row = {}
        for property_ in element.properties:
            length = 1 if property_.length_code is None else next_numbers(property_.length_code, 1, where)[0]
            row[property_.name] = next_numbers(property_.code, _length(length, where), where)
        return row

    return next_row


def _length(length: float, where: str) -> int:
    # Written so that NaN fails, too.
    if not (0 <= length <= _LONGEST_LIST and length == int(length)):
        raise MeshFileError(f"is no valid PLY file: {where}: expected the length of a list, found {length:g}.")
    return int(length)


def _vertex(row: Row, index: int) -> tuple[float, float, float]:
    x, y, z = (check_coordinate(row[axis][0], f"vertex {index}") for axis in "xyz")
    return x, y, z


def _polygon(corners: list[float], vertex_count: int, index: int) -> tuple[int, ...]:
    if len(corners) < 3:
        raise MeshFileError(f"face {index}: expected at least three vertices, found {len(corners)}.")
    for corner in corners:
        if not (0 <= corner < vertex_count and corner == int(corner)):
            raise MeshFileError(
                f"face {index}: expected vertex numbers from 0 to {vertex_count - 1}, found {corner:g}."
            )
    return tuple(int(corner) for corner in corners)
