"""The header of a PLY file: which elements follow it, in which order and encoding (Turk, "The PLY Polygon File
Format", 1994). The grammar is in docs/scene-format.md, "PLY".
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from raytruth.scenes.mesh_text import shown, without_byte_order_mark
from raytruth.scenes.triangle_lists import LARGEST_FACE_COUNT, MeshFileError

# The format's own names, and those with the size in bits, which are as common, for the codes of `struct`.
INTEGER_CODES = {
    b"char": "b",
    b"uchar": "B",
    b"short": "h",
    b"ushort": "H",
    b"int": "i",
    b"uint": "I",
    b"int8": "b",
    b"uint8": "B",
    b"int16": "h",
    b"uint16": "H",
    b"int32": "i",
    b"uint32": "I",
}
_TYPE_CODES = INTEGER_CODES | {b"float": "f", b"double": "d", b"float32": "f", b"float64": "d"}

# As many vertices as the largest mesh has corners.
_MOST_ROWS = 3 * LARGEST_FACE_COUNT

# Clouds of splats have some 60 properties; millions would take gigabytes before a row is read.
_MOST_DECLARATIONS = 1000

# The line end after `ply` is that of the whole header, which tells where binary data begin: a file whose lines end in
# CR may have data that begin with the byte of LF. Several CR before LF come from files that were converted twice.
_FIRST_LINE = re.compile(rb"ply[\t\v\f ]*(?:\r*(\n)|\r)")


@dataclass(frozen=True)
class Property:
    """A column of an element: a number in each row, or a list of numbers."""

    name: bytes
    code: str
    """Its type, as `struct` names it."""
    length_code: str | None
    """The type of a list's length; None for a number."""


@dataclass(frozen=True)
class Element:
    """A table of a PLY file, with `count` rows, each of which has these properties."""

    name: bytes
    count: int
    properties: list[Property]

    def names(self, *, lists: bool) -> set[bytes]:
        """The names of the element's lists if `lists`, else of its numbers."""
        return {property_.name for property_ in self.properties if (property_.length_code is not None) == lists}


@dataclass(frozen=True)
class Header:
    """What the header states, and the bytes after it."""

    encoding: bytes
    elements: list[Element]
    body: bytes
    line_count: int
    """The number of the line `end_header`."""


def read_header(content: bytes) -> Header:
    """The header. Raises MeshFileError, which names the line, also for more rows than fit into the file."""
    content = without_byte_order_mark(content)
    first = _FIRST_LINE.match(content)
    if first is None:
        raise MeshFileError("is no PLY file: expected a first line that is 'ply'.")
    line_end = b"\n" if first[1] else b"\r"
    start = first.end()
    line = 1
    encoding: bytes | None = None
    elements: list[Element] = []
    declarations = 0
    while True:
        line += 1
        end = content.find(line_end, start)
        if end < 0:
            raise MeshFileError("has a header without end: expected a line that is 'end_header'.")
        words = content[start:end].split()
        start = end + 1
        if words == [b"end_header"]:
            break
        try:
            if words[:1] == [b"format"]:
                encoding = _encoding(words, encoding)
            elif words and words[0] not in (b"comment", b"obj_info"):
                declarations += 1
                _declare(words, declarations, elements)
        except MeshFileError as error:
            raise MeshFileError(f"line {line}: {error}") from error
    if encoding is None:
        raise MeshFileError("expected a line such as 'format ascii 1.0' in its header, found none.")
    body = content[start:]
    _check_size(elements, len(body))
    return Header(encoding, elements, body, line)


def _encoding(words: list[bytes], stated_before: bytes | None) -> bytes:
    match words:
        case [_, (b"ascii" | b"binary_little_endian" | b"binary_big_endian") as encoding, b"1.0"]:
            if stated_before is not None:
                raise MeshFileError("expected one line that starts with format, found another.")
            return encoding
        case _:
            raise MeshFileError(
                "expected 'format ascii 1.0', 'format binary_little_endian 1.0' or 'format binary_big_endian 1.0', "
                f"found {shown(*words)}."
            )


def _declare(words: list[bytes], declarations: int, elements: list[Element]) -> None:
    """Adds an element, or a property to the latest one."""
    if declarations > _MOST_DECLARATIONS:
        raise MeshFileError(f"expected at most {_MOST_DECLARATIONS} elements and properties, found more.")
    match words:
        case [b"element", name, count] if re.fullmatch(rb"[0-9]{1,18}", count):
            if any(element.name == name for element in elements):
                raise MeshFileError(f"expected one element {shown(name)}, found another.")
            elements.append(Element(name, int(count), []))
        case [b"property", type_, name] if elements and type_ in _TYPE_CODES:
            _add(elements[-1], Property(name, _TYPE_CODES[type_], None))
        case [b"property", b"list", length, type_, name] if (
            elements and length in INTEGER_CODES and type_ in _TYPE_CODES
        ):
            _add(elements[-1], Property(name, _TYPE_CODES[type_], INTEGER_CODES[length]))
        case [b"element", *_]:
            raise MeshFileError(f"expected 'element NAME COUNT' with a whole number as count, found {shown(*words)}.")
        case [b"property", *_]:
            raise MeshFileError(
                "expected 'property TYPE NAME' or 'property list TYPE TYPE NAME' after an element, with types such as "
                f"uchar, int32 or float, and a whole one for a list's length, found {shown(*words)}."
            )
        case _:
            raise MeshFileError(
                "expected a line that starts with format, comment, obj_info, element, property or end_header, "
                f"found {shown(*words)}."
            )


def _add(element: Element, property_: Property) -> None:
    if any(other.name == property_.name for other in element.properties):
        raise MeshFileError(f"expected one property {shown(property_.name)} of {shown(element.name)}, found another.")
    element.properties.append(property_)


def _check_size(elements: list[Element], size: int) -> None:
    """Refuses numbers of rows that the file cannot hold, or no mesh needs, before memory is reserved for them."""
    total = sum(element.count * len(element.properties) for element in elements)
    if total > size:
        raise MeshFileError(f"claims {total} values, more than fit into the {size} bytes after its header.")
    for element in elements:
        if element.count > _MOST_ROWS:
            raise MeshFileError(f"has too many rows of {shown(element.name)}: expected at most {_MOST_ROWS}.")
