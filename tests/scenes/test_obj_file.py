from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raytruth.scenes import triangle_lists
from raytruth.scenes.obj_file import read_obj
from raytruth.scenes.triangle_lists import MeshFileError
from tests.scenes.scene_files import is_triangles_or_a_sentence

pytestmark = pytest.mark.clause("SCN-2", "SCN-3")

VERTEX = "expected 'v x y z', which a weight or a colour may follow, so 3, 4, 6 or 7 numbers"
NUMBER = "expected a decimal number such as -1.5 or 2e-3"
CORNER = "expected a vertex number such as 3, 3/1, 3//2 or 3/1/2"
SURFACE = "makes a surface that is no polygon, which is not read; save it as a mesh of polygons."
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
        ("v 0 0", f"{VERTEX}, found 'v 0 0'."),
        ("v 0 0 0 1 1", f"{VERTEX}, found 'v 0 0 0 1 1'."),
        ("v 0 0 0 1 1 1 1 1", f"{VERTEX}, found 'v 0 0 0 1 1 1 1 1'."),
        ("v 0 0 nan", f"{NUMBER}, found 'nan'."),
        ("v 0 0 -inf", f"{NUMBER}, found '-inf'."),
        ("v 0 0 1.#INF", f"{NUMBER}, found '1.#INF'."),
        ("v 0 0 0 red", f"{NUMBER}, found 'red'."),
        ("v 0 0 1e999", "expected a finite coordinate of at most 1e+12 in size, found inf."),
        ("v 0 0 -2e12", "expected a finite coordinate of at most 1e+12 in size, found -2000000000000.0."),
        ("f", "expected a face with at least three vertices, found 0."),
        ("f 1 2", "expected a face with at least three vertices, found 2."),
        ("f 1 2 2", "expected a face with each vertex once, found one again; remove the corner or the face."),
        ("f 1 2 -3", "expected a face with each vertex once, found one again; remove the corner or the face."),
        ("f 1 2 x", f"{CORNER}, found 'x'."),
        ("f 1 2 3/1/1/1", f"{CORNER}, found '3/1/1/1'."),
        ("f 1 2 /3", f"{CORNER}, found '/3'."),
        ("f 1 2 3.0", f"{CORNER}, found '3.0'."),
        ("f 1 2 3 \\", f"{CORNER}, found '\\'."),
        ("f 1 2 0", "expected vertex numbers that count from 1, found number 0."),
        ("f 1 2 5", "expected one of the file's 4 vertices, found number 5."),
        ("f 1 2 -5", "expected one of the 4 vertices above this line, found number -5."),
        ("surf 0 1 0 1 1 2 3 4", f"'surf' {SURFACE}"),
        ("bzp 1 2 3 4", f"'bzp' {SURFACE}"),
        ("call other.obj", "'call' would read another file; put what that holds into this one."),
        ("csh -rm scene", "'csh' would run a command, which no file makes raytruth do; remove the line."),
        ("V 0 0 0", "expected a statement of OBJ such as v or f, found 'V'."),
        ("\ufeffv 0 0 0", 'expected a statement of OBJ such as v or f, found "\\ufeffv".'),
    ],
)
def test_each_broken_line_gets_its_sentence(line: str, sentence: str) -> None:
    with pytest.raises(MeshFileError) as caught:
        read_obj((SQUARE + line + " # why\nf 1 2 3").encode())
    assert str(caught.value) == f"line 5: {sentence}"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"", "has no faces: expected at least one line that starts with f."),
        (b"v 0 0 0\nl 1 1\np 1\ncurv 0 1 1 1", "has no faces: expected at least one line that starts with f."),
        (b"v \xff", "line 1: expected 'v x y z', which a weight or a colour may follow"),
        (b"\xff\xfev\0 \0", "expected ASCII or UTF-8, found the byte order mark of UTF-16; save it as UTF-8."),
        (b"\xfe\xff\0v\0 ", "expected ASCII or UTF-8, found the byte order mark of UTF-16; save it as UTF-8."),
        (b"f 1 2 3 \\", "ends within a statement: expected a line after the backslash that ends line 1."),
        (b"\nf 1 2\\\n3", "line 3: expected a blank before what continues line 2; add one."),
        (
            b"v 0 0 0\nv 1 0 0 0.5\nv 0 1 0\nf 1 2 3",
            "line 2: expected the weight 1, or none, of a face's vertex, found '0.5', "
            "which some programs divide by and others leave out.",
        ),
    ],
)
def test_each_file_that_is_broken_as_a_whole_gets_its_sentence(content: bytes, sentence: str) -> None:
    with pytest.raises(MeshFileError) as caught:
        read_obj(content)
    assert str(caught.value).startswith(sentence)


def test_a_face_may_come_before_its_vertices() -> None:
    assert read_obj(("f 1 2 3\n" + SQUARE).encode())[1] == ((0, 1, 2),)


def test_a_weight_does_not_matter_where_no_face_has_the_vertex() -> None:
    content = (SQUARE + "v 2 0 0 0.7071\nv 2 0 1 1.0\nf 1 2 3\nf 1 2 6").encode()
    assert read_obj(content)[1] == ((0, 1, 2), (0, 1, 5))


def test_a_statement_is_named_by_its_first_line() -> None:
    with pytest.raises(MeshFileError, match=r"^line 2: expected a vertex number such as .*, found 'x'\.$"):
        read_obj(b"# ends with a path C:\\\r\nf 1 \\\r\n 2 \\\r\n x\r\n")


def test_a_face_with_too_many_corners_is_refused_before_they_are_read() -> None:
    with pytest.raises(MeshFileError, match="expected at most 500000 triangles"):
        read_obj(b"f" + b" x" * (triangle_lists.LARGEST_FACE_COUNT + 9))


def test_too_many_faces_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(triangle_lists, "LARGEST_FACE_COUNT", 2)
    read_obj((SQUARE + "f 1 2 3 4").encode())
    with pytest.raises(MeshFileError, match="expected at most 2 triangles"):
        read_obj((SQUARE + "f 1 2 3 4\nf 1 2 3").encode())


@settings(deadline=None)  # the machine may be busy
@given(st.text(alphabet="vf 0123/-.#e\\\r\n", max_size=60))
def test_any_text_gives_valid_triangles_or_a_sentence(text: str) -> None:
    assert is_triangles_or_a_sentence(read_obj, (SQUARE + text).encode())
