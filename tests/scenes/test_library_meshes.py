from __future__ import annotations

import pytest

from raytruth.scenes.library import LIBRARY_FOLDER
from raytruth.scenes.library_meshes import MESH_FILES

pytestmark = pytest.mark.clause("SCN-5")


@pytest.mark.parametrize("name", MESH_FILES)
def test_the_generator_makes_the_very_file_of_the_library(name: str) -> None:
    assert MESH_FILES[name]() == (LIBRARY_FOLDER / name).read_text(encoding="utf-8")


def test_every_mesh_file_of_the_library_has_a_generator() -> None:
    assert {path.name for path in LIBRARY_FOLDER.iterdir() if path.suffix != ".json"} == set(MESH_FILES)
