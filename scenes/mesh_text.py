"""Lines, words and numbers of mesh files that are text.

They are read as bytes: only comments and names may hold other characters than ASCII's, in any encoding, and these are
read past. The grammar is in docs/scene-format.md, "Mesh files".
"""

from __future__ import annotations

import math
import re
import struct
from decimal import Decimal
from typing import TYPE_CHECKING

from raytruth.scenes.triangle_lists import MeshFileError
from raytruth.scenes.wording import LONGEST_QUOTE, quoted

if TYPE_CHECKING:
    from collections.abc import Iterator

_UTF_8_MARK = b"\xef\xbb\xbf"
_UTF_16_MARKS = (b"\xff\xfe", b"\xfe\xff")

_LINE_END = re.compile(rb"\r\n?|\n")
# A file may have 64 million lines, which would take gigabytes all at once.
_BYTES_SPLIT_AT_ONCE = 2**16
_NUMBER = re.compile(rb"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
# Ten digits hold every 32-bit integer, and so every number of a vertex.
_WHOLE_NUMBER = re.compile(rb"[-+]?[0-9]{1,10}")

# IEEE 754 binary32: significands of 24 bits, and no spacing of numbers below 2^-149.
_FLOAT32_BITS = 24
_FLOAT32_SMALLEST_EXPONENT = -149


def without_byte_order_mark(content: bytes) -> bytes:
    """The content after the mark that some editors put before UTF-8. Raises MeshFileError for UTF-16."""
    if content.startswith(_UTF_16_MARKS):
        raise MeshFileError("expected ASCII or UTF-8, found the byte order mark of UTF-16; save it as UTF-8.")
    return content.removeprefix(_UTF_8_MARK)


def lines_of(content: bytes) -> Iterator[bytes]:
    """Each line without its end, which is LF, CR LF or CR."""
    start = 0
    while start < len(content):
        line_end = _LINE_END.search(content, start + _BYTES_SPLIT_AT_ONCE)
        end = line_end.end() if line_end else len(content)
        yield from content[start:end].splitlines()
        start = end


def shown(*words: bytes) -> str:
    """Words of a file as a sentence quotes them, in quotes and shortened."""
    longest = 4 * (LONGEST_QUOTE + 1)  # four bytes a character
    return quoted(b" ".join(word[:longest] for word in words[:longest])[:longest].decode("utf-8", "replace"))


def number(word: bytes) -> float:
    """The double nearest to a decimal number. Raises MeshFileError for any other word, also for nan and inf."""
    if not _NUMBER.fullmatch(word):
        raise MeshFileError(f"expected a decimal number such as -1.5 or 2e-3, found {shown(word)}.")
    return float(word)


def nearest_float32(word: bytes) -> float:
    """The number of IEEE 754 binary32 nearest to a decimal number, ties to even; infinite where that overflows.

    Rounding the nearest double once more would be wrong where that double lies halfway between two numbers of binary32
    and the decimal number does not: there it is first moved to the decimal number's side.
    """
    value = number(word)
    spacing = max(math.frexp(value)[1] - _FLOAT32_BITS, _FLOAT32_SMALLEST_EXPONENT)
    if math.isfinite(value) and math.ldexp(value, 1 - spacing) % 2 == 1:
        stated, halfway = Decimal(word.decode("ascii")), Decimal(value)
        if stated != halfway:
            value = math.nextafter(value, math.inf if stated > halfway else -math.inf)
    try:
        rounded: float = struct.unpack("f", struct.pack("f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return rounded


def whole_number(word: bytes) -> int:
    """The whole number that a word of at most ten digits states. Raises MeshFileError for any other word."""
    if not _WHOLE_NUMBER.fullmatch(word):
        raise MeshFileError(f"expected a whole number of at most ten digits, found {shown(word)}.")
    return int(word)
