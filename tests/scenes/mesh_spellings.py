"""Meshes written in random spellings that the grammar of docs/scene-format.md allows, and the meshes they state."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from hypothesis import strategies as st

if TYPE_CHECKING:
    from collections.abc import Sequence

    from hypothesis.strategies import DrawFn, SearchStrategy

    from raytruth.scenes.triangle_lists import TriangleLists

LINE_ENDS = st.sampled_from(["\n", "\r\n", "\r"])
BLANKS = st.sampled_from([" ", "  ", "\t", " \t", "\v", "\f"])
MARKS = st.sampled_from([b"", b"\xef\xbb\xbf"])
# No bytes that end a line, in no encoding in particular.
COMMENTS = st.binary(max_size=8).map(lambda text: text.translate(None, b"\r\n"))

COORDINATES = st.floats(-1e12, 1e12)


@dataclass(frozen=True)
class Polygons:
    """Points and faces of three corners or more, by the indices of points."""

    points: list[tuple[float, ...]]
    faces: list[list[int]]

    def triangles(self) -> TriangleLists:
        """What a reader gives back, written apart from it: fans around the first corner."""
        fans = [(face[0], b, c) for face in self.faces for b, c in pairwise(face[1:])]
        return tuple((x, y, z) for x, y, z in self.points), tuple(fans)


@st.composite
def polygons(draw: DrawFn, coordinates: SearchStrategy[float] = COORDINATES) -> Polygons:
    """A few points and faces."""
    points = draw(st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=3, max_size=6))
    corners = st.lists(st.sampled_from(range(len(points))), min_size=3, unique=True)
    return Polygons(points, draw(st.lists(corners, min_size=1, max_size=3)))


@st.composite
def spellings(draw: DrawFn, value: float) -> bytes:
    """A decimal number whose nearest double is `value`."""
    sign, text = ("-", repr(value)[1:]) if repr(value)[0] == "-" else (draw(st.sampled_from(["", "+"])), repr(value))
    digits, _, exponent = text.partition("e")
    whole, _, part = digits.partition(".")
    if part == "0" and not exponent:
        digits = draw(st.sampled_from([whole, f"{whole}.", f"{whole}.0", f"00{whole}", f"{whole}.000e-0"]))
    elif whole == "0":
        digits = draw(st.sampled_from(["", "0"])) + f".{part}"
    letter = draw(st.sampled_from("eE"))
    shown = digits + (f"{letter}{exponent}" if exponent else draw(st.sampled_from(["", "e0", "E+00", "e-0"])))
    shown = digits if "e" in digits else shown
    return (sign + shown).encode()


@st.composite
def obj_files(draw: DrawFn, mesh: Polygons) -> bytes:
    """The mesh in OBJ."""
    lines: list[bytes] = []
    for point in mesh.points:
        words = [draw(spellings(value)) for value in point]
        words += draw(st.sampled_from([[], [b"1"], [b"1.0"], [b"0.5", b".25", b"1"], [b"255", b"0", b"0", b"1e0"]]))
        lines += [*draw(NOTHING), draw(statements([b"v", *words]))]
    for face in mesh.faces:
        corners = [draw(obj_corners(index, len(mesh.points))) for index in face]
        lines += [*draw(NOTHING), draw(statements([b"f", *corners]))]
    lines += draw(NOTHING)
    line_end = draw(LINE_ENDS).encode()
    last = draw(st.sampled_from([b"", line_end]))
    return draw(MARKS) + line_end.join(line.replace(b"\n", line_end) for line in lines) + last


@st.composite
def obj_corners(draw: DrawFn, index: int, count: int) -> bytes:
    """A corner of a face, counted from the first vertex or from the latest."""
    number = draw(st.sampled_from([f"{index + 1}", f"+{index + 1}", f"0{index + 1}", f"{index - count}"]))
    return (number + draw(st.sampled_from(["", "/", "//", "/1", "/1/", "//1", "/1/1", "/-1/-1", "/0/0"]))).encode()


@st.composite
def statements(draw: DrawFn, words: Sequence[bytes]) -> bytes:
    """Words with blanks around them, perhaps on several lines, perhaps with a comment behind."""
    text = draw(st.sampled_from([b"", b" ", b"\t"])) + words[0]
    for word in words[1:]:
        joint = draw(st.sampled_from([b"", b"", b"", b"\\\n", b" \\\n \\\n"]))
        text += draw(BLANKS).encode() + joint + word
    # A blank before the comment, since 1.# begins an infinite number of some libraries.
    return text + draw(st.sampled_from([b"", b" "]) | COMMENTS.map(lambda comment: b" #" + comment))


NOTHING: SearchStrategy[list[bytes]] = st.lists(
    st.sampled_from([b"", b" ", b"\f", b"# path C:\\", b"vn 0 nan 1", b"vt .5 .5 0", b"vp 0 1"])
    | st.sampled_from([b"o S\xe4ule", b"g a b \\\n c", b"s off", b"mg 1 .5", b"usemtl \x95\x5c", b"mtllib a b.mtl"])
    | st.sampled_from([b"p 1", b"l 1 2/2", b"cstype rat bspline", b"deg 3", b"curv 0 1 -1 -2 \\\n -3", b"end"])
    | COMMENTS.map(lambda comment: b"#" + comment),
    max_size=2,
)
"""Lines that state no surface."""


# The types of PLY, by what `struct` calls them.
TYPE_NAMES = {
    "b": ["char", "int8"],
    "B": ["uchar", "uint8"],
    "h": ["short", "int16"],
    "H": ["ushort", "uint16"],
    "i": ["int", "int32"],
    "I": ["uint", "uint32"],
    "f": ["float", "float32"],
    "d": ["double", "float64"],
}


@dataclass(frozen=True)
class Column:
    """A property and its values by row; a list of values a row for a list."""

    name: str
    code: str
    length_code: str | None
    values: list[Any]


@st.composite
def other_columns(draw: DrawFn, name: str, count: int) -> Column:
    """A property that no mesh needs."""
    code = draw(st.sampled_from("bBhHiIfd"))
    length_code = draw(st.sampled_from([None, "b", "B", "h", "H", "i", "I"]))
    value = st.integers(0, 100)
    row = value if length_code is None else st.lists(value, max_size=3)
    return Column(name, code, length_code, draw(st.lists(row, min_size=count, max_size=count)))


@st.composite
def ply_files(draw: DrawFn, mesh: Polygons, encoding: str) -> bytes:
    """The mesh in PLY; coordinates are doubles, in an order of their own among other properties and elements."""
    axes = [Column(name, "d", None, [point[i] for point in mesh.points]) for i, name in enumerate("xyz")]
    codes = st.sampled_from("bBhHiI")
    name = draw(st.sampled_from(["vertex_indices", "vertex_index"]))
    corners = Column(name, draw(codes), draw(codes), mesh.faces)
    elements = {
        "vertex": draw(shuffled([*axes, draw(other_columns("nx", len(mesh.points)))])),
        "face": draw(shuffled([corners, draw(other_columns("texcoord", len(mesh.faces)))])),
        "edge": [draw(other_columns("vertex1", 2)), draw(other_columns("vertex2", 2))],
        "nothing": [],
    }
    order = draw(shuffled(list(elements)))
    line_end = draw(LINE_ENDS).encode()
    header = [b"ply", *draw(ply_comments()), f"format {encoding} 1.0".encode()]
    body: list[bytes] = []
    for element in order:
        columns = elements[element]
        count = len(columns[0].values) if columns else 7
        header += [*draw(ply_comments()), f"element {element} {count}".encode()]
        for column in columns:
            length = f"list {draw(type_names(column.length_code))} " if column.length_code else ""
            header += [f"property {length}{draw(type_names(column.code))} {column.name}".encode()]
        for row in range(count if columns else 0):
            if encoding == "ascii":
                body += [draw(text_row(columns, row)), line_end]
            else:
                byte_order = "<" if encoding == "binary_little_endian" else ">"
                body += [binary_row(columns, row, byte_order)]
    header += [*draw(ply_comments()), b"end_header"]
    trailing = draw(st.sampled_from([b"", b" ", b"\t "]))
    return draw(MARKS) + b"".join(line + trailing + line_end for line in header) + b"".join(body)


def shuffled(items: list[Any]) -> SearchStrategy[list[Any]]:
    """The items in any order."""
    return st.permutations(items).map(list)


def type_names(code: str) -> SearchStrategy[str]:
    """Either name of a type."""
    return st.sampled_from(TYPE_NAMES[code])


def ply_comments() -> SearchStrategy[list[bytes]]:
    """Lines of a header that state nothing."""
    return st.lists(
        st.sampled_from([b"comment end_header", b"obj_info num_cols 512", b"comment", b"comment \xe9 \\", b""]),
        max_size=1,
    )


@st.composite
def text_row(draw: DrawFn, columns: list[Column], row: int) -> bytes:
    """The line of a row."""
    words: list[bytes] = []
    for column in columns:
        value = column.values[row]
        numbers = [value] if column.length_code is None else [len(value), *value]
        words += [draw(spellings(n)) if isinstance(n, float) else f"{n}".encode() for n in numbers]
    text = b"".join(word + draw(BLANKS).encode() for word in words)
    return draw(st.sampled_from([b"", b" "])) + text


def binary_row(columns: list[Column], row: int, byte_order: str) -> bytes:
    """The bytes of a row."""
    packed = b""
    for column in columns:
        value = column.values[row]
        numbers = [value] if column.length_code is None else value
        if column.length_code is not None:
            packed += struct.pack(byte_order + column.length_code, len(value))
        packed += struct.pack(f"{byte_order}{len(numbers)}{column.code}", *numbers)
    return packed
