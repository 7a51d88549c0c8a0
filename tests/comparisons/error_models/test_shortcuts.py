from __future__ import annotations

from dataclasses import replace

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.shortcuts import has_shortcuts, shortcuts_in_words, without_shortcuts
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.scenes.library import open_scene

pytestmark = pytest.mark.clause("VER-14")

PLAIN = ErrorModel("float32", precision_bits=24)
TESTED = RayOffset(minimum_distance=1e-3, excludes_surface=False)
SHORTCUTS = {
    "an offset": replace(PLAIN, ray_offset=RayOffset(absolute=1e-4)),
    "a relative offset": replace(PLAIN, ray_offset=RayOffset(relative=1e-4)),
    "a least distance": replace(PLAIN, ray_offset=TESTED),
    "a surface that is tested": replace(PLAIN, ray_offset=RayOffset(excludes_surface=False)),
    "short shadow rays": replace(PLAIN, shadow_shortening=1e-3),
    "a farthest distance": replace(PLAIN, farthest=1e4),
    "missed triangles": replace(PLAIN, triangle_test="moeller-trumbore of 1997", least_determinant=1e-6),
    "near shadows": replace(PLAIN, ray_offset=TESTED, shadow_tolerance=1e-2),
}


@pytest.mark.parametrize("name", SHORTCUTS)
def test_a_shortcut_is_seen_and_taken_away_and_nothing_else_is(name: str) -> None:
    assert has_shortcuts(SHORTCUTS[name])
    assert without_shortcuts(SHORTCUTS[name]) == replace(PLAIN, triangle_test=SHORTCUTS[name].triangle_test)


def test_arithmetic_and_output_are_no_shortcuts() -> None:
    models = [model for renderer in all_renderers().values() for _, model in renderer.error_models]
    declared = {model.description for model in models if has_shortcuts(model)}
    assert len(models) > len(declared) > 0
    for model in models:
        assert not has_shortcuts(without_shortcuts(model))
        assert without_shortcuts(model).precision_bits == model.precision_bits
        assert without_shortcuts(model).output == model.output


def test_the_size_is_told_beside_the_smallest_sphere_or_edge() -> None:
    sphere = open_scene("single-sphere")
    small = sphere.model_copy(update={"objects": (sphere.objects[0].model_copy(update={"radius": 1e-5}),)})
    assert shortcuts_in_words(SHORTCUTS["an offset"], small) == (
        "its ray offset is up to 0.0001, 10 times the radius of the smallest sphere"
    )
    told = shortcuts_in_words(SHORTCUTS["near shadows"], open_scene("single-triangle"))
    assert "its least distance is up to 0.001, " in told
    assert "its shadow tolerance is up to 0.01, " in told
    assert told.endswith("times the shortest edge")
    assert "before the light" in shortcuts_in_words(SHORTCUTS["short shadow rays"], small)
    assert shortcuts_in_words(PLAIN, small) == ""


def test_planes_have_no_size_and_only_beside_them_something_is_far() -> None:
    plane, with_spheres = open_scene("single-plane"), open_scene("spheres-on-a-plane")
    assert (
        shortcuts_in_words(SHORTCUTS["an offset"], plane)
        == "its ray offset is up to 0.0001, 0.0001 times a unit of length"
    )
    assert shortcuts_in_words(SHORTCUTS["a relative offset"], plane).startswith("its ray offset is up to 0.00023, ")
    assert shortcuts_in_words(SHORTCUTS["an offset"], with_spheres).endswith("times the radius of the smallest sphere")
    told = shortcuts_in_words(SHORTCUTS["a farthest distance"], plane)
    assert told == "it may miss what is farther than 1e+04, and planes are infinite"
    assert shortcuts_in_words(SHORTCUTS["a farthest distance"], open_scene("single-sphere")) == ""
