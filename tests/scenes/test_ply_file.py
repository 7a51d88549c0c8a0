from __future__ import annotations

import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raytruth.scenes.ply_file import read_ply
from raytruth.scenes.triangle_lists import MeshFileError
from tests.scenes.scene_files import is_triangles_or_a_sentence

pytestmark = pytest.mark.clause("SCN-2", "SCN-3")

POINTS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.5)]


def ply(polygons: list[list[int]], *, text: bool, order: str = "<", name: str = "vertex_indices") -> bytes:
    encoding = "ascii" if text else {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    header = (
        f"ply\nformat {encoding} 1.0\nelement vertex {len(POINTS)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(polygons)}\nproperty list uchar int {name}\nend_header\n"
    )
    if text:
        rows = [*POINTS, *([len(polygon), *polygon] for polygon in polygons)]
        return (header + "".join(" ".join(f"{value:g}" for value in row) + "\n" for row in rows)).encode()
    points = b"".join(struct.pack(f"{order}3f", *point) for point in POINTS)
    faces = (struct.pack(f"{order}B{len(polygon)}i", len(polygon), *polygon) for polygon in polygons)
    return header.encode() + points + b"".join(faces)


VALID = [ply([[0, 1, 2, 3], [3, 1, 0]], text=True), ply([[0, 1, 2, 3], [3, 1, 0]], text=False)]


@pytest.mark.parametrize("text", [True, False])
@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("name", ["vertex_indices", "vertex_index"])
def test_every_encoding_gives_the_same_triangles(text: bool, order: str, name: str) -> None:
    vertices, faces = read_ply(ply([[0, 1, 2, 3], [3, 1, 0]], text=text, order=order, name=name))
    assert vertices == tuple(POINTS)
    assert faces == ((0, 1, 2), (0, 2, 3), (3, 1, 0))
    assert all(type(index) is int for face in faces for index in face)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"", "is no PLY file: expected a first line that is 'ply'."),
        (b"v 0 0 0\n", "is no PLY file: expected a first line that is 'ply'."),
        (VALID[1][:-3], "face 1: expected more values, found the end of the file."),
        (VALID[0].replace(b"element face 2", b"element face 3"), "ends before face 2, a row that its header states."),
        (VALID[0].replace(b"vertex 4", b"vertex 400000000000"), "claims 1200000000002 values, more than fit"),
        (VALID[0].replace(b"vertex 4", b"vertex -4"), "line 3: expected 'element NAME COUNT'"),
        (VALID[0].replace(b"element vertex", b"element points"), "expected an element 'vertex'"),
        (VALID[0].replace(b"float z", b"float w"), "expected an element 'vertex' with the properties x, y and z"),
        (VALID[0].replace(b"element face", b"element side"), "expected an element 'face'"),
        (VALID[0].replace(b"vertex_indices", b"neighbours"), "expected an element 'face' with one list that is"),
        (ply([[0, 1]], text=True), "line 14: face 0: expected a face with at least three vertices, found 2"),
        (
            ply([[0, 1, 2], [0, 1, 4]], text=True),
            "face 1: expected one of the file's 4 vertices, counted from 0, found number 4.",
        ),
        (
            ply([[0, 1, -1]], text=True),
            "face 0: expected one of the file's 4 vertices, counted from 0, found number -1.",
        ),
        (
            ply([[0, 1, 2]], text=True).replace(b"3 0 1 2", b"3 0 0.5 2"),
            "line 14: face 0: expected a whole number of at most ten digits, found '0.5'.",
        ),
        (VALID[0].replace(b"4 0 1 2 3", b"5 0 1 2 3"), "line 14: face 0: expected more values on this line."),
        (VALID[0].replace(b"4 0 1 2 3", b"3 0 1 2 3"), "line 14: face 0: expected fewer values on this line."),
        (VALID[0].replace(b"4 0 1 2 3", b"-1"), "line 14: face 0: expected a whole number from 0 to 255, found -1."),
        (
            VALID[0].replace(b"4 0 1 2 3", b"4 0 one 2 3"),
            "face 0: expected a whole number of at most ten digits, found 'one'.",
        ),
        (VALID[0].replace(b"float y", b"float x"), "line 5: expected one property 'x' of 'vertex', found another."),
        (
            VALID[0].replace(b"float y", b"real y"),
            "line 5: expected 'property TYPE NAME' or 'property list TYPE TYPE NAME' after an element",
        ),
        (VALID[0].replace(b"format ascii 1.0\n", b""), "expected a line such as 'format ascii 1.0'"),
        (VALID[0].replace(b"vertex 4", b"vertex 1500001") + b"0 0 0\n" * 10**6, "has too many rows of 'vertex'"),
        (ply([], text=True), "has no faces"),
        (
            VALID[0].replace(b"1 1 0\n", b"1 nan 0\n", 1),
            "line 12: vertex 2: expected a decimal number such as -1.5 or 2e-3, found 'nan'.",
        ),
    ],
)
def test_each_broken_file_gets_its_sentence(content: bytes, sentence: str) -> None:
    with pytest.raises(MeshFileError) as caught:
        read_ply(content)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_other_elements_and_properties_and_carriage_returns_are_read_past() -> None:
    text = """ply
comment made by hand
format ascii 1.0
element mark 1
property list uint8 float32 numbers
element face 1
property uchar red
property list uchar uint16 vertex_index
element vertex 3
property float64 z
property float64 x
property float64 y
property short weight
end_header
2 7 8
255 3 2 1 0
0 1 2 9
3 4 5 9
6 7 8 9
"""
    expected = (((1.0, 2.0, 0.0), (4.0, 5.0, 3.0), (7.0, 8.0, 6.0)), ((2, 1, 0),))
    assert read_ply(text.encode()) == expected
    assert read_ply(text.replace("\n", "\r\n").encode()) == expected


@settings(deadline=None)  # the machine may be busy
@given(st.sampled_from(VALID), st.integers(0, max(map(len, VALID))), st.binary(max_size=12), st.integers(0, 12))
def test_any_change_of_a_file_gives_valid_triangles_or_a_sentence(
    content: bytes, position: int, noise: bytes, removed: int
) -> None:
    assert is_triangles_or_a_sentence(read_ply, content[:position] + noise + content[position + removed :])


HEADER_LINES = st.lists(
    st.sampled_from(
        [
            "element vertex 3",
            "element vertex +2",
            "element vertex 1e3",
            "element face 1",
            "element face 0",
            "property float x",
            "property double y",
            "property float z",
            "property uchar z",
            "property int vertex_index",
            "property list int float x",
            "property list uchar int vertex_indices",
            "comment x",
        ]
    ),
    max_size=10,
)


@settings(deadline=None)  # the machine may be busy
@given(HEADER_LINES, st.lists(st.sampled_from(["0 0 0", "3 0 1 2", "1 0.5 2", "-1", "", "x"]), max_size=6))
def test_any_header_gives_valid_triangles_or_a_sentence(header: list[str], body: list[str]) -> None:
    text = "\n".join(["ply", "format ascii 1.0", *header, "end_header", *body, ""])
    assert is_triangles_or_a_sentence(read_ply, text.encode())
