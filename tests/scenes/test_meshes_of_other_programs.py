"""The square, as OBJ and PLY files of many programs state it; one kind a test. What none may hold is refused."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

import pytest

from raytruth.scenes.loading import SceneError
from raytruth.scenes.obj_file import read_obj
from raytruth.scenes.ply_file import read_ply
from raytruth.scenes.scene import Scene
from raytruth.scenes.shapes import Mesh
from raytruth.scenes.triangle_lists import MeshFileError
from tests.scenes.scene_files import changed, loaded, write_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SCN-2", "SCN-3")

CORNERS = ((-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0))
SQUARE = (CORNERS, ((0, 1, 2), (0, 2, 3)))

V = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
F = "f 1 2 3\nf 1 3 4\n"


def vertices(after: str) -> str:
    """The square's vertices with the same words behind each."""
    return V.replace(" 0\n", f" 0{after}\n")


OBJ_KINDS = {
    "vertex colours": vertices(" 0.5 0.25 1.0") + F,
    "vertex colours with opacity": vertices(" 255 0 0 255") + F,
    "vertex colours that are not a number": vertices(" nan nan nan") + F,
    "a weight of one": vertices(" 1.0") + F,
    "trailing slashes": V + "f 1/ 2/ 3/\nf 1// 3// 4//\n",
    "texture coordinates with a trailing slash": V + "vt 0 0\nf 1/1/ 2/1/ 3/1/\nf 1/1/ 3/1/ 4/1/\n",
    "normals alone, some not a number": V + "vn 0 0 1\nvn -nan(ind) 0 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4//1\n",
    "a byte order mark": "\ufeff" + V + F,
    "points, lines and curves": V + "p 1 -1\nl 1/1 2/1\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n" + F,
    "CR line ends": ("# old Mac\n" + V + F).replace("\n", "\r"),
    "CR LF line ends": (V + F).replace("\n", "\r\n"),
    "a continued statement": V.replace(" 1 -1", " 1 \\\n -1") + "f 1 2 \\\n3\nf 1 \\\n\t3 \\\n 4",
    "a continued statement with CR LF": (V + "f 1 2 \\\n3 \\\n4\n").replace("\n", "\r\n"),
    "a comment that ends in a backslash": "# C:\\models\\\n" + V + F,
    "a comment right behind a statement": V + "f 1 2 3# half\nf 1 3 4#",
    "tabs, form feeds and blanks at the ends of lines": V.replace(" ", "\t") + "\f\n \n  f\t1  2 3 \nf 1 3 4\t\n\n",
    "exponents, signs and bare points": "v -1e0 -.1E+1 +0\nv +1. -1.e0 0e9\nv 10e-1 1 .0\nv -1.000 001 0e-5\n" + F,
    "no line end at the end": V + F.rstrip(),
    "numbers that count backwards": V + "f -4 -3 -2\nf -4/-1 -2//-1 -1/-1/-1\n",
    "a quadrilateral": V + "vt 0 0\nvn 0 0 1\n" * 4 + "f 1/1/1 2/2/1 3/3/1 4/4/1 \n",
    "groups, smoothing, materials and display": "mtllib a b.mtl\no Box 1\ng default\ns off\ns 1\nusemtl None\nmg 0\n"
    "bevel on\nc_interp off\nd_interp off\nlod 0\nshadow_obj a.obj\ntrace_obj b.obj\nusemap off\n" + V + "g\n" + F,
    "colours in comments, as ZBrush has them": "#MRGB ffaabbccffaabbcc\n" + V + F,
    "faces before vertices": F + V,
}


@pytest.mark.parametrize("kind", OBJ_KINDS)
def test_the_square_is_read_from_obj(kind: str) -> None:
    assert read_obj(OBJ_KINDS[kind].encode()) == SQUARE


@pytest.mark.parametrize("encoding", ["latin-1", "shift-jis", "gb18030", "utf-8"])
def test_comments_and_names_of_obj_may_be_in_any_encoding(encoding: str) -> None:
    name = {"latin-1": "créé à Zürich", "utf-8": "créé 表"}.get(encoding, "表")
    text = f"# {name}\n#{name}\no {name}\nusemtl {name}\n{V}g {name}\n{F}# {name}"
    assert read_obj(text.encode(encoding)) == SQUARE


PROPERTIES = "property float x\nproperty float y\nproperty float z\n"
ROWS = "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n"
FACES = "3 0 1 2\n3 0 2 3\n"


def header(encoding: str = "ascii", properties: str = PROPERTIES, face: str = "list uchar int vertex_indices") -> str:
    return f"ply\nformat {encoding} 1.0\nelement vertex 4\n{properties}element face 2\nproperty {face}\nend_header\n"


TEXT = header() + ROWS + FACES
STRIPS = "element tristrips 0\nproperty list int int vertex_indices\nend_header"

PLY_KINDS = {
    "CR line ends": TEXT.replace("\n", "\r"),
    "CR LF line ends": TEXT.replace("\n", "\r\n"),
    "CR CR LF line ends, converted twice": TEXT.replace("\n", "\r\r\n"),
    "a byte order mark": "\ufeff" + TEXT,
    "a comment that holds end_header": TEXT.replace("element vertex", "comment no end_header yet\nelement vertex"),
    "a comment that is end_header": TEXT.replace("element vertex", "comment end_header\nelement vertex"),
    "comments before format, and obj_info": TEXT.replace("format", "comment Ä\nobj_info num_cols 512\nformat"),
    "blanks at the ends of lines, and blank lines": TEXT.replace("\n", " \t\n").replace("0 2 3", "0 2 3 \n\n "),
    "no line end at the end": TEXT.rstrip(),
    "normals that are not a number": header(properties=PROPERTIES + "property float nx\n")
    + ROWS.replace(" 0\n", " 0 -nan(ind)\n")
    + FACES,
    "colours between the coordinates": header(properties=PROPERTIES.replace("y\n", "y\nproperty uchar red\n"))
    + "-1 -1 7 0\n1 -1 7 0\n1 1 7 0\n-1 1 7 0\n"
    + FACES,
    "a list of a vertex": header(properties="property list uint8 int8 ring\n" + PROPERTIES)
    + "0 -1 -1 0\n2 7 8 1 -1 0\n1 9 1 1 0\n0 -1 1 0\n"
    + FACES,
    "vertex_index and long names of types": header(
        properties=PROPERTIES.replace("float", "float64"), face="list uint8 int32 vertex_index"
    )
    + ROWS
    + FACES,
    "whole coordinates": header(properties=PROPERTIES.replace("float", "char")) + ROWS + FACES,
    "triangle strips, of which there are none": TEXT.replace("end_header", STRIPS),
    "edges behind, and a camera before": TEXT.replace(
        "element vertex", "element camera 1\nproperty float view_px\nelement vertex"
    ).replace("end_header\n", "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n0.5\n")
    + "0 1\n",
    "faces before vertices": "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar uint vertex_indices\n"
    f"element vertex 4\n{PROPERTIES}end_header\n{FACES}{ROWS}",
}


@pytest.mark.parametrize("kind", PLY_KINDS)
def test_the_square_is_read_from_ply(kind: str) -> None:
    assert read_ply(PLY_KINDS[kind].encode()) == SQUARE


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("count", [4, 10])
def test_the_square_is_read_from_binary_ply(order: str, line_end: str, count: int) -> None:
    encoding = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    # Rows before the vertices that begin with the byte of a line end, which belongs to the data.
    text = header(encoding).replace("element vertex", f"element mark {count}\nproperty uchar code\nelement vertex")
    body = b"\n" * count + b"".join(struct.pack(f"{order}3f", *corner) for corner in CORNERS)
    body += b"".join(struct.pack(f"{order}B3i", 3, *face) for face in SQUARE[1])
    assert read_ply(text.replace("\n", line_end).encode() + body) == SQUARE
    assert read_ply(b"\xef\xbb\xbf" + text.replace("\n", line_end).encode() + body + b"\n") == SQUARE


def test_the_float_of_a_text_is_that_of_binary_data() -> None:
    content = (header() + ROWS.replace("1 1 0", "0.1 1 0", 1) + FACES).encode()
    assert read_ply(content)[0][2][0] == struct.unpack("f", struct.pack("f", 0.1))[0]
    assert read_ply(content.replace(b"float x", b"double x"))[0][2][0] == 0.1


NUMBER = "expected a decimal number such as -1.5 or 2e-3"
PROPERTY = (
    "expected 'property TYPE NAME' or 'property list TYPE TYPE NAME' after an element, with types such as uchar, int32 "
    "or float, and a whole one for a list's length"
)
WHOLE_NUMBER = "expected a whole number of at most ten digits"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (TEXT.replace("1 1 0", "1_0 1 0", 1), f"line 12: vertex 2: {NUMBER}, found '1_0'."),
        (TEXT.replace("1 1 0", "١ 1 0", 1), f"line 12: vertex 2: {NUMBER}, found '١'."),
        (TEXT.replace("3 0 1 2", "3 0 1 1_0"), f"line 14: face 0: {WHOLE_NUMBER}, found '1_0'."),
        (TEXT.replace("3 0 1 2", "3 0 1 ٢"), f"line 14: face 0: {WHOLE_NUMBER}, found '٢'."),
        (TEXT.replace("3 0 1 2", "256 0 1 2"), "line 14: face 0: expected a whole number from 0 to 255, found 256."),
        (
            TEXT.replace("3 0 1 2", "3 0 1 1"),
            "line 14: face 0: expected a face with each vertex once, found one again; ",
        ),
        (TEXT + "3 0 1 3\n", "line 16: expected the end of the file after all rows that its header states."),
        (
            TEXT.replace("end_header", STRIPS.replace("0", "1")),
            "has triangle strips (element 'tristrips'), which are not read; save it with faces.",
        ),
        (TEXT.replace("int vert", "float vert"), "expected whole numbers as the type of 'vertex_indices', found float"),
        (
            TEXT.replace("list uchar", "list float"),
            f"line 8: {PROPERTY}, found 'property list float int vertex_indices'.",
        ),
        (TEXT.replace("element vertex 4", "comment"), f"line 4: {PROPERTY}, found 'property float x'."),
        (
            TEXT.replace("vertex 4", "vertex 4.0"),
            "line 3: expected 'element NAME COUNT' with a whole number as count, ",
        ),
        (
            TEXT.replace("end_header", "property list uchar int vertex_index\nend_header"),
            "expected an element 'face' with one list that is 'vertex_indices' or 'vertex_index', found both.",
        ),
        (
            TEXT.replace("end_header", "element face 1\nend_header"),
            "line 9: expected one element 'face', found another.",
        ),
        (TEXT.replace("format ascii 1.0", "format ascii 2.0"), "line 2: expected 'format ascii 1.0', 'format binary_"),
        (TEXT.replace("format ascii 1.0", "format ascii 1.0\n" * 2), "line 3: expected one line that starts with for"),
        (
            TEXT.replace("end_header", "the end"),
            "line 9: expected a line that starts with format, comment, obj_info, e",
        ),
        (TEXT.replace("\n", "\r", 1), "has a header without end: expected a line that is 'end_header'."),
        (TEXT[: TEXT.index("end_header")], "has a header without end: expected a line that is 'end_header'."),
        (TEXT.replace("ply", "PLY", 1), "is no PLY file: expected a first line that is 'ply'."),
        (
            "ply\nelement a 0\n" + "".join(f"property int p{i}\n" for i in range(1000)),
            "line 1002: expected at most 1000 elements and properties, found more.",
        ),
    ],
)
def test_what_ply_does_not_state_so_is_refused(content: str, sentence: str) -> None:
    with pytest.raises(MeshFileError) as caught:
        read_ply(content.encode())
    assert str(caught.value).startswith(sentence)


def test_ply_in_utf_16_is_refused() -> None:
    with pytest.raises(MeshFileError, match="found the byte order mark of UTF-16; save it as UTF-8"):
        read_ply(TEXT.encode("utf-16"))


@pytest.mark.parametrize(("name", "content"), [("square.obj", V + F), ("square.ply", TEXT)])
def test_a_scene_has_the_square_of_its_file_or_tells_what_is_wrong_with_it(
    tmp_path: Path, name: str, content: str
) -> None:
    mesh = {"shape": "mesh", "file": name, "material": "red"}
    path = write_scene(tmp_path, changed(("objects",), [mesh]))
    (tmp_path / name).write_text(content, encoding="utf-8")
    scene = loaded(path)
    assert isinstance(scene, Scene)
    [square] = scene.objects
    assert isinstance(square, Mesh)
    assert (square.vertices, square.faces) == SQUARE
    (tmp_path / name).write_text(content.replace("1 1 0", "1_0 1 0", 1), encoding="utf-8")
    error = loaded(path)
    assert isinstance(error, SceneError)
    [problem] = error.problems
    assert problem.startswith(f"{path}: objects[0].file: '{name}' line ")
    assert problem.endswith("expected a decimal number such as -1.5 or 2e-3, found '1_0'.")
