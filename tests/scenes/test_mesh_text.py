from __future__ import annotations

import math
import struct
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from raytruth.scenes import mesh_text
from raytruth.scenes.mesh_text import lines_of, nearest_float32, number, shown, whole_number, without_byte_order_mark
from raytruth.scenes.triangle_lists import MeshFileError
from tests.scenes.mesh_spellings import spellings

pytestmark = pytest.mark.clause("SCN-2", "SCN-3")

# A word of a mesh file, as the grammar has it, whose exponent does not make an exact fraction of it too long.
DECIMALS = st.from_regex(rb"[-+]?([0-9]{1,25}\.?[0-9]{0,25}|\.[0-9]{1,25})([eE][-+]?[0-9]{1,2})?", fullmatch=True)
FLOAT32_NUMBERS = st.floats(width=32, allow_nan=False, allow_infinity=False)


def is_nearest(value: float, stated: Fraction, below: float, above: float, is_even: bool) -> bool:
    """Whether no neighbour is nearer to what is stated, nor as near where the value's significand is odd."""
    distance = abs(Fraction(value) - stated)
    others = [abs(Fraction(other) - stated) for other in (below, above)]
    return all(distance < other or (distance == other and is_even) for other in others)


def float32_of_bits(bits: int) -> float:
    value: float = struct.unpack("f", struct.pack("I", bits))[0]
    return value


def bits_of(value: float, form: str, unsigned: str) -> int:
    bits: int = struct.unpack(unsigned, struct.pack(form, value))[0]
    return bits


@given(DECIMALS)
@example(b"9007199254740993")
@example(b"1.00000000000000011102230246251565404236316680908203125")
@example(b".1e-30")
def test_a_decimal_number_is_the_nearest_double(word: bytes) -> None:
    value = number(word)
    is_even = bits_of(value, "d", "Q") % 2 == 0
    neighbours = math.nextafter(value, -math.inf), math.nextafter(value, math.inf)
    assert is_nearest(value, Fraction(word.decode()), *neighbours, is_even)


@given(FLOAT32_NUMBERS.filter(lambda value: 0 < value < 1e30), st.integers(-2, 2))
@example(1.0, 0)
@example(1.0, 1)
@example(2.0**-149, -1)
@example(2.0**-148, 1)
@example(2.0**-126, -1)
def test_beside_a_tie_a_number_is_the_nearest_of_binary32(below: float, nudge: int) -> None:
    bits = bits_of(below, "f", "I")
    halfway = (Fraction(below) + Fraction(float32_of_bits(bits + 1))) / 2
    # Two hundred digits state the tie exactly, and a nudge after them is far below what a double can tell.
    digits = halfway * 10**200 + nudge
    assert digits.denominator == 1
    value = nearest_float32(f"{digits.numerator}e-200".encode())
    above_the_tie = nudge > 0 or (nudge == 0 and bits % 2 == 1)
    assert value == float32_of_bits(bits + above_the_tie)
    assert nearest_float32(f"-{digits.numerator}e-200".encode()) == -value


@given(FLOAT32_NUMBERS)
def test_what_binary32_holds_is_read_back(value: float) -> None:
    assert nearest_float32(repr(value).encode()) == value


def test_a_number_beyond_binary32_is_infinite() -> None:
    assert nearest_float32(b"-3.5e38") == -math.inf
    assert nearest_float32(b"1e999") == math.inf


@given(st.floats(-1e12, 1e12), st.data())
def test_every_spelling_of_a_number_is_that_number(value: float, data: st.DataObject) -> None:
    assert number(data.draw(spellings(value))) == value


@pytest.mark.parametrize(
    "word",
    [
        *("", ".", "+", "e5", "1e", "1e+", "1_0", "0x1p3", "1,5", "1d3", "nan", "inf", "-Infinity", "1.2.3", "--1"),
        *("1.#INF", "-1.#IND", "١", "１", "1\u00a0", "1\0", "½", "1e²"),
    ],
)
def test_what_is_no_decimal_number_is_refused(word: str) -> None:
    for read in (number, nearest_float32):
        with pytest.raises(MeshFileError, match="expected a decimal number such as"):
            read(word.encode())


@pytest.mark.parametrize(("word", "value"), [(b"0", 0), (b"-0", 0), (b"+007", 7), (b"4294967295", 2**32 - 1)])
def test_a_whole_number_has_a_sign_and_digits(word: bytes, value: int) -> None:
    assert whole_number(word) == value


@pytest.mark.parametrize("word", ["", "1.0", "1e3", "1_0", "0x1", "٣", "12345678901"])
def test_what_is_no_whole_number_is_refused(word: str) -> None:
    with pytest.raises(MeshFileError, match="expected a whole number of at most ten digits"):
        whole_number(word.encode())


@given(st.lists(st.binary(max_size=5) | st.sampled_from([b"\r", b"\n", b"\r\n", b"\v", b"\f", b"\x85"])).map(b"".join))
def test_lines_end_at_lf_cr_lf_and_cr_and_nowhere_else(content: bytes) -> None:
    normalised = content.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    expected = normalised.split(b"\n")
    assert list(lines_of(content)) == (expected if expected[-1] else expected[:-1])


@given(st.integers(1, 5), st.lists(st.sampled_from([b"\r", b"\n", b"\r\n", b"ab"])).map(b"".join))
def test_where_a_file_is_cut_to_be_split_shows_in_no_line(size: int, content: bytes) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(mesh_text, "_BYTES_SPLIT_AT_ONCE", size)
        assert list(lines_of(content)) == content.splitlines()


def test_a_quote_is_as_long_as_a_sentence_bears() -> None:
    assert shown(b"v", *[b"1"] * 100) == f"'v{' 1' * 19} …'"
    assert shown("ä".encode() * 100) == f"'{'ä' * 40}…'"
    assert shown("😀".encode() * 41) == f"'{'😀' * 40}…'"


def test_the_mark_of_utf_8_is_taken_off_and_that_of_utf_16_refused() -> None:
    assert without_byte_order_mark("\ufeff\ufeffv".encode()) == "\ufeffv".encode()
    for encoding in ("utf-16-le", "utf-16-be", "utf-32-le"):
        with pytest.raises(MeshFileError, match="save it as UTF-8"):
            without_byte_order_mark("\ufeffv 0 0 0".encode(encoding))
