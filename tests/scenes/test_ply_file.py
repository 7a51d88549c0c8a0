from __future__ import annotations

import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plyfile import PlyData, PlyElement

from scenes.ply_file import read_ply
from scenes.triangle_lists import MeshFileError
from tests.scenes.scene_files import is_triangles_or_a_sentence

POINTS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.5)]


def ply(polygons: list[list[int]], *, text: bool, order: str = "<", name: str = "vertex_indices") -> bytes:
    vertex = np.array(POINTS, dtype=[("x", "f4"), ("y", "f4"), ("z", "f4")])
    face = np.empty(len(polygons), dtype=[(name, "O")])
    for index, polygon in enumerate(polygons):
        face[name][index] = np.array(polygon, dtype="i4")
    elements = [PlyElement.describe(vertex, "vertex"), PlyElement.describe(face, "face", val_types={name: "i4"})]
    stream = io.BytesIO()
    PlyData(elements, text=text, byte_order=order).write(stream)
    return stream.getvalue()


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
        (b"", "is no valid PLY file"),
        (b"v 0 0 0\n", "is no valid PLY file"),
        (VALID[1][:-3], "is no valid PLY file"),
        (VALID[0].replace(b"element face 2", b"element face 3"), "is no valid PLY file"),
        (VALID[0].replace(b"vertex 4", b"vertex 400000000000"), "claims 1200000000002 values, more than fit"),
        (VALID[0].replace(b"vertex 4", b"vertex -4"), "is no valid PLY file"),
        (VALID[0].replace(b"element vertex", b"element points"), "expected an element 'vertex'"),
        (VALID[0].replace(b"float z", b"float w"), "expected an element 'vertex' with the properties x, y and z"),
        (VALID[0].replace(b"element face", b"element side"), "expected an element 'face'"),
        (VALID[0].replace(b"vertex_indices", b"neighbours"), "expected an element 'face' with a property list"),
        (ply([[0, 1]], text=True), "face 0: expected a list of at least three whole numbers, found 2"),
        (ply([[0, 1, 2], [0, 1, 4]], text=True), "face 1: expected vertex numbers from 0 to 3, found 4"),
        (ply([[0, 1, -1]], text=True), "face 0: expected vertex numbers from 0 to 3, found -1"),
        (ply([], text=True), "has no faces"),
        (VALID[0].replace(b"1 1 0\n", b"1 nan 0\n", 1), "vertex 2: expected a finite coordinate"),
    ],
)
def test_each_broken_file_gets_its_sentence(content: bytes, sentence: str) -> None:
    with pytest.raises(MeshFileError) as caught:
        read_ply(content)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


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
