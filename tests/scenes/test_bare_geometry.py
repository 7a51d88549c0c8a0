from __future__ import annotations

import numpy as np
import pytest

from raytruth.reference_tracer.rendering import first_hits, prepare, primary_rays
from raytruth.scenes.bare_geometry import bare_geometry
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-2")


@pytest.mark.parametrize("name", library_names())
def test_it_is_a_dark_scene_of_one_diffuse_material_that_a_file_could_state(name: str) -> None:
    bare = bare_geometry(open_scene(name))
    assert Scene.model_validate(bare.model_dump()) == bare
    assert bare.lights == ()
    assert [list(material.model_dump(exclude_none=True)) for material in bare.materials.values()] == [["diffuse"]]


@pytest.mark.parametrize("name", ["bubble-in-glass", "camera-under-water", "parallel-projection", "trefoil-knot"])
def test_its_rays_and_what_they_hit_first_are_those_of_the_scene(name: str) -> None:
    scene = open_scene(name)
    bare = bare_geometry(scene)
    for of_bare, of_scene in zip(primary_rays(bare), primary_rays(scene), strict=True):
        np.testing.assert_array_equal(of_bare, of_scene)
    for of_bare, of_scene in zip(first_hits(prepare(bare)), first_hits(prepare(scene)), strict=True):
        np.testing.assert_array_equal(of_bare, of_scene)
