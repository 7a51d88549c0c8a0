from __future__ import annotations

import pytest

from comparisons.exercised_scenes import scenes_by_function
from scenes.library import library_names

pytestmark = pytest.mark.clause("PRJ-6")


def test_a_function_stands_beside_the_scenes_that_need_it() -> None:
    scenes = scenes_by_function()
    assert scenes[None] == scenes["camera_frame"] == library_names()
    assert "glass-slab" in scenes["fresnel_reflectance"]
    assert "ambient-sphere" not in scenes["fresnel_reflectance"]
    assert scenes["blinn"] == tuple(name for name in library_names() if name in scenes["blinn"])
