from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raytruth.scenes import triangle_lists
from raytruth.scenes.obj_file import read_obj
from raytruth.scenes.triangle_lists import MeshFileError
from tests.scenes.scene_files import is_triangles_or_a_sentence

pytestmark = pytest.mark.clause("SCN-2", "SCN-3")

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@pytest.mark.parametrize(
    "face", ["f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1//7 2//7 3//7 4//7", "f 1/1/7 2/2/7 3/3/7 4/4/7", "f -4 -3 -2 -1"]
)
def test_every_form_of_a_face_gives_the_same_fan(face: str) -> None:
    vertices, faces = read_obj((SQUARE + face).encode())
    assert vertices == ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
    assert faces == ((0, 1, 2), (0, 2, 3))


def test_what_changes_no_triangle_is_ignored() -> None:
    text = (
        "# square\r\nmtllib a.mtl\no square\ng side\nvn 0 0 1\nvt 0 0\ns off\nusemtl red\n"
        + SQUARE
        + "\nf 1 2 3 # half\n"
    )
    assert read_obj(text.encode())[1] == ((0, 1, 2),)


def test_a_negative_number_counts_from_the_vertices_stated_so_far() -> None:
    _, faces = read_obj((SQUARE + "f -4 -3 -2\nv 5 5 5\nf -1 1 2").encode())
    assert faces == ((0, 1, 2), (4, 0, 1))


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("v 0 0", "line 5: expected 'v x y z' with three numbers, found 'v 0 0'."),
        ("v 0 0 nan", "line 5: expected 'v x y z' with three numbers, found 'v 0 0 nan'."),
        ("v 0 0 1_0", "line 5: expected 'v x y z' with three numbers, found 'v 0 0 1_0'."),
        ("v 0 0 1e999", "line 5: expected a finite coordinate of at most 1e+12 in size, found inf."),
        ("v 0 0 -2e12", "line 5: expected a finite coordinate of at most 1e+12 in size, found -2000000000000.0."),
        ("f 1 2", "line 5: expected a face with at least three vertices, found 2."),
        ("f 1 2 x", "line 5: expected a vertex number such as 3, 3/1 or 3/1/2, found 'x'."),
        ("f 1 2 3/", "line 5: expected a vertex number such as 3, 3/1 or 3/1/2, found '3/'."),
        ("f 1 2 0", "line 5: expected one of the 4 vertices stated above this line, found number 0."),
        ("f 1 2 5", "line 5: expected one of the 4 vertices stated above this line, found number 5."),
        ("f 1 2 -5", "line 5: expected one of the 4 vertices stated above this line, found number -5."),
        ("curv 1 2", "line 5: expected a line that starts with v or f, found 'curv'."),
        ("", "has no faces: expected at least one line that starts with f."),
    ],
)
def test_each_broken_line_gets_its_sentence(line: str, sentence: str) -> None:
    with pytest.raises(MeshFileError) as caught:
        read_obj((SQUARE + line).encode())
    assert str(caught.value) == sentence


def test_bytes_that_are_no_text_are_refused() -> None:
    with pytest.raises(MeshFileError, match="is no OBJ text: byte 2 is not UTF-8"):
        read_obj(b"v \xff")


def test_too_many_faces_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(triangle_lists, "LARGEST_FACE_COUNT", 2)
    read_obj((SQUARE + "f 1 2 3 4").encode())
    with pytest.raises(MeshFileError, match="expected at most 2 triangles"):
        read_obj((SQUARE + "f 1 2 3 4\nf 1 2 3").encode())


@settings(deadline=None)  # the machine may be busy
@given(st.text(alphabet="vf 0123/-.#e\n", max_size=60))
def test_any_text_gives_valid_triangles_or_a_sentence(text: str) -> None:
    assert is_triangles_or_a_sentence(read_obj, (SQUARE + text).encode())
