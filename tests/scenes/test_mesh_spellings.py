"""Mesh files drawn from the grammar of docs/scene-format.md, and their broken neighbours."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.scenes.obj_file import read_obj
from raytruth.scenes.ply_file import read_ply
from raytruth.scenes.triangle_lists import MeshFileError
from tests.scenes.mesh_spellings import Polygons, obj_files, ply_files, polygons
from tests.scenes.scene_files import is_triangles_or_a_sentence

pytestmark = pytest.mark.clause("SCN-2", "SCN-3")

ENCODINGS = ["ascii", "binary_little_endian", "binary_big_endian"]


def bits(mesh: Polygons) -> str:
    """The mesh with the sign of each zero."""
    return repr(mesh.triangles())


@st.composite
def neighbours(draw: st.DrawFn, content: bytes) -> bytes:
    """The file with a byte deleted, replaced or inserted, or with its end cut off."""
    position = draw(st.integers(0, len(content) - 1))
    noise = draw(st.sampled_from([b"", bytes([draw(st.integers(0, 255))]), b"-", b"_", b"9", b"#", b"\\", b"\r", b" "]))
    return content[:position] + noise + content[position + draw(st.sampled_from([0, 1, len(content)])) :]


@given(polygons(), st.data())
def test_every_spelling_of_obj_gives_the_mesh_that_it_states(mesh: Polygons, data: st.DataObject) -> None:
    assert repr(read_obj(data.draw(obj_files(mesh)))) == bits(mesh)


@pytest.mark.parametrize("encoding", ENCODINGS)
@given(polygons(), st.data())
def test_every_spelling_of_ply_gives_the_mesh_that_it_states(
    encoding: str, mesh: Polygons, data: st.DataObject
) -> None:
    assert repr(read_ply(data.draw(ply_files(mesh, encoding)))) == bits(mesh)


@given(polygons(), st.data())
def test_a_broken_neighbour_of_obj_gives_triangles_or_a_sentence(mesh: Polygons, data: st.DataObject) -> None:
    assert is_triangles_or_a_sentence(read_obj, data.draw(neighbours(data.draw(obj_files(mesh)))))


@pytest.mark.parametrize("encoding", ENCODINGS)
@given(polygons(), st.data())
def test_a_broken_neighbour_of_ply_gives_triangles_or_a_sentence(
    encoding: str, mesh: Polygons, data: st.DataObject
) -> None:
    assert is_triangles_or_a_sentence(read_ply, data.draw(neighbours(data.draw(ply_files(mesh, encoding)))))


@pytest.mark.parametrize("encoding", ENCODINGS[1:])
@given(polygons(), st.data())
def test_binary_data_that_are_cut_or_go_on_are_refused(encoding: str, mesh: Polygons, data: st.DataObject) -> None:
    content = data.draw(ply_files(mesh, encoding))
    for broken in (content[: data.draw(st.integers(0, len(content) - 1))], content + b"\0"):
        with pytest.raises(MeshFileError):
            read_ply(broken)


@given(polygons(), st.data())
def test_text_with_a_row_too_few_or_too_many_is_refused(mesh: Polygons, data: st.DataObject) -> None:
    content = data.draw(ply_files(mesh, "ascii"))
    for broken in (re.sub(rb"[^\r\n]*\Z", b"", content.rstrip()), content + b"0"):
        with pytest.raises(MeshFileError):
            read_ply(broken)
