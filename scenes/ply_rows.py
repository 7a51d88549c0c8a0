"""The rows of a PLY file, as text or binary: those of each element in turn, with the properties that are wanted."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.scenes.mesh_text import lines_of, nearest_float32, number, whole_number
from raytruth.scenes.triangle_lists import MeshFileError
from raytruth.scenes.wording import LONGEST_QUOTE

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.ply_header import Element, Header

Row = dict[bytes, tuple[float, ...]]
"""The values of a row by property: a number is a list of one."""

Wanted = dict[bytes, frozenset[bytes]]
"""The properties that are wanted, by element; other rows and values are read past."""

_BYTE_ORDERS = {b"binary_little_endian": "<", b"binary_big_endian": ">"}
_RANGES = {code: range(-(2 ** (bits - 1)), 2 ** (bits - 1)) for code, bits in zip("bhi", (8, 16, 32), strict=True)}
_RANGES |= {code: range(2**bits) for code, bits in zip("BHI", (8, 16, 32), strict=True)}


def rows_of(header: Header, wanted: Wanted) -> Iterator[tuple[Element, str, Row]]:
    """(element, place in words, row) of each row of the wanted elements. Raises MeshFileError, which names the place.

    An ASCII file has a row a line. What follows the last row must be blank.
    """
    if header.encoding == b"ascii":
        return _text_rows(header, wanted)
    return _binary_rows(header, wanted)


def _text_rows(header: Header, wanted: Wanted) -> Iterator[tuple[Element, str, Row]]:
    numbered = enumerate(lines_of(header.body), start=header.line_count + 1)
    lines = ((line, words) for line, text in numbered if (words := text.split()))
    for element in header.elements:
        names = wanted.get(element.name, frozenset())
        # A row without values has no line.
        for index in range(element.count if element.properties else 0):
            line, words = next(lines, (0, []))
            if not words:
                raise MeshFileError(f"ends before {_row_name(element, index)}, a row that its header states.")
            place = f"line {line}: {_row_name(element, index)}"
            try:
                row = _text_row(words, element, names)
            except MeshFileError as error:
                raise MeshFileError(f"{place}: {error}") from error
            if names:
                yield element, place, row
    for line, _ in lines:
        raise MeshFileError(f"line {line}: expected the end of the file after all rows that its header states.")


def _text_row(words: list[bytes], element: Element, names: frozenset[bytes]) -> Row:
    row: Row = {}
    position = 0
    for property_ in element.properties:
        length = 1
        if property_.length_code is not None and position < len(words):
            length = _length(int(_value(words[position], property_.length_code)))
            position += 1
        if position + length > len(words):
            raise MeshFileError("expected more values on this line.")
        if property_.name in names:
            row[property_.name] = tuple(_value(word, property_.code) for word in words[position : position + length])
        position += length
    if position < len(words):
        raise MeshFileError("expected fewer values on this line.")
    return row


def _value(word: bytes, code: str) -> float:
    """The value nearest to the text among those of the type, which a binary file would hold."""
    if code in _RANGES:
        whole = whole_number(word)
        allowed = _RANGES[code]
        if whole not in allowed:
            raise MeshFileError(f"expected a whole number from {allowed[0]} to {allowed[-1]}, found {whole}.")
        return whole
    return nearest_float32(word) if code == "f" else number(word)


def _row_name(element: Element, index: int) -> str:
    return f"{element.name.decode('ascii', 'backslashreplace')[:LONGEST_QUOTE]} {index}"


def _length(length: int) -> int:
    if length < 0:
        raise MeshFileError(f"expected the length of a list, found {length}.")
    return length


@dataclass
class _Cursor:
    """A place in binary data."""

    body: bytes
    order: str
    """The order of bytes: `<` or `>`."""
    position: int = 0

    def skip(self, size: int) -> bool:
        """Whether that many bytes were left, which are passed then."""
        if size > len(self.body) - self.position:
            return False
        self.position += size
        return True

    def skip_numbers(self, code: str, count: int) -> None:
        """Raises MeshFileError if fewer are left."""
        if not self.skip(count * struct.calcsize("<" + code)):
            raise MeshFileError("expected more values, found the end of the file.")

    def take(self, code: str, count: int) -> tuple[float, ...]:
        """The next numbers. Raises MeshFileError if fewer are left."""
        start = self.position
        self.skip_numbers(code, count)
        return struct.unpack_from(f"{self.order}{count}{code}", self.body, start)


def _binary_rows(header: Header, wanted: Wanted) -> Iterator[tuple[Element, str, Row]]:
    cursor = _Cursor(header.body, _BYTE_ORDERS[header.encoding])
    for element in header.elements:
        names = wanted.get(element.name, frozenset())
        if element.names(lists=True):
            yield from _rows_with_lists(cursor, element, names)
        elif element.properties:
            yield from _rows_of_one_size(cursor, element, names)
    # A blank or a line end there can only come from an editor.
    if header.body[cursor.position :].strip():
        surplus = len(header.body) - cursor.position
        raise MeshFileError(f"holds {surplus} bytes after all rows that its header states: expected its end there.")


def _rows_of_one_size(cursor: _Cursor, element: Element, names: frozenset[bytes]) -> Iterator[tuple[Element, str, Row]]:
    """All rows at once: a file may hold millions that are not wanted."""
    form = struct.Struct(cursor.order + "".join(property_.code for property_ in element.properties))
    start = cursor.position
    if not cursor.skip(element.count * form.size):
        whole_rows = (len(cursor.body) - start) // form.size
        raise MeshFileError(f"ends before all of {_row_name(element, whole_rows)}, a row that its header states.")
    if not names:
        return
    columns = [(i, property_.name) for i, property_ in enumerate(element.properties) if property_.name in names]
    for index, values in enumerate(form.iter_unpack(cursor.body[start : cursor.position])):
        yield element, _row_name(element, index), {column: (values[i],) for i, column in columns}


def _rows_with_lists(cursor: _Cursor, element: Element, names: frozenset[bytes]) -> Iterator[tuple[Element, str, Row]]:
    for index in range(element.count):
        place = _row_name(element, index)
        row: Row = {}
        try:
            for property_ in element.properties:
                length = 1
                if property_.length_code is not None:
                    length = _length(int(cursor.take(property_.length_code, 1)[0]))
                if property_.name in names:
                    row[property_.name] = cursor.take(property_.code, length)
                else:
                    cursor.skip_numbers(property_.code, length)
        except MeshFileError as error:
            raise MeshFileError(f"{place}: {error}") from error
        if names:
            yield element, place, row
