"""trimesh as a second opinion: what it writes is read, and it reads the same from what other programs write."""

from __future__ import annotations

import io

import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from raytruth.scenes.obj_file import read_obj
from raytruth.scenes.ply_file import read_ply
from tests.scenes.mesh_spellings import Polygons, polygons
from tests.scenes.test_meshes_of_other_programs import OBJ_KINDS, PLY_KINDS, SQUARE

pytestmark = pytest.mark.clause("SCN-3")

# Kinds that trimesh 5 does not read, or not as the formats have it: it splits lines at LF alone, counts a comment's
# backslash as continuation, and takes the first end_header anywhere for the header's end.
NOT_READ_BY_TRIMESH = {
    "CR line ends",
    "a byte order mark",
    "a comment that ends in a backslash",
    "a comment right behind a statement",
    "tabs, form feeds and blanks at the ends of lines",
    "CR CR LF line ends, converted twice",
    "a comment that holds end_header",
    "a comment that is end_header",
    "comments before format, and obj_info",
    # It warns about texture coordinates of corners that the first three leave out.
    "a quadrilateral",
}
KINDS = [
    (kind, text, suffix)
    for kinds, suffix in ((OBJ_KINDS, "obj"), (PLY_KINDS, "ply"))
    for kind, text in kinds.items()
    if kind not in NOT_READ_BY_TRIMESH
]


def turned(face: list[int]) -> list[int]:
    """The same triangle from its smallest corner on: trimesh begins the second one of a quadrilateral elsewhere."""
    first = face.index(min(face))
    return face[first:] + face[:first]


@pytest.mark.parametrize(("kind", "text", "suffix"), KINDS, ids=lambda value: value[:40])
def test_trimesh_reads_the_same_square(kind: str, text: str, suffix: str) -> None:
    mesh = trimesh.load_mesh(io.BytesIO(text.encode()), suffix, process=False, maintain_order=True)
    assert isinstance(mesh, trimesh.Trimesh)
    assert mesh.vertices.tolist() == [list(corner) for corner in SQUARE[0]], kind
    assert [turned(face) for face in mesh.faces.tolist()] == [turned(list(face)) for face in SQUARE[1]], kind


# It writes eight decimals, and float32 where the file is binary.
EIGHTHS = st.integers(-(2**20), 2**20).map(lambda count: count / 8)


@given(polygons(EIGHTHS))
def test_what_trimesh_writes_is_read(mesh: Polygons) -> None:
    vertices, faces = mesh.triangles()
    written = trimesh.Trimesh(vertices, faces, process=False)
    assert read_obj(written.export(file_type="obj").encode()) == (vertices, faces)
    for encoding in ("ascii", "binary"):
        assert read_ply(written.export(file_type="ply", encoding=encoding)) == (vertices, faces)
