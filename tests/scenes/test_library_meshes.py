from __future__ import annotations

import pytest

from raytruth.scenes.library import LIBRARY_FOLDER
from raytruth.scenes.library_meshes import MESH_FILES

pytestmark = pytest.mark.clause("SCN-5")

WRITTEN_ONCE = {
    "crumpled-foil.obj": "heights drawn at random",
    "polygons.obj": "what modellers write, spelled out by hand",
    "polygons.ply": "as above, in bytes",
}
"""Mesh files that no formula makes, with what they are."""


@pytest.mark.parametrize("name", MESH_FILES)
def test_the_generator_makes_the_very_file_of_the_library(name: str) -> None:
    assert MESH_FILES[name]() == (LIBRARY_FOLDER / name).read_text(encoding="utf-8")


def test_every_mesh_file_of_the_library_has_a_generator_or_says_why_not() -> None:
    files = {path.name for path in LIBRARY_FOLDER.iterdir() if path.suffix != ".json"}
    assert files == MESH_FILES.keys() | WRITTEN_ONCE.keys()
