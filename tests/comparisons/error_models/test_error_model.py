from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.scenes.library import library_names, open_scene
from tests.reference_tracer.small_scenes import small_scene, sphere

pytestmark = pytest.mark.clause("VER-1")

CLAUSES = {
    RayOffset(): "on the surface; the surface cannot be hit again there",
    RayOffset(excludes_surface=False): "on the surface; the surface is tested as all others are",
    RayOffset(
        absolute=1e-4, excludes_surface=False
    ): "0.0001 along the normal; the surface is tested as all others are",
    RayOffset(relative=0.5): "0.5·max|p| along the normal; the surface cannot be hit again there",
    RayOffset(0.25, 0.25): "0.25·(1 + max|p|) along the normal; the surface cannot be hit again there",
    RayOffset(0.25, 0.5): "0.25 + 0.5·max|p| along the normal; the surface cannot be hit again there",
    RayOffset(1e-3, along="direction", excludes_surface=False): (
        "0.001 along the ray; the surface is tested as all others are"
    ),
    RayOffset(relative_minimum_distance=1e-4, scale="scene", excludes_surface=False): (
        "on the surface, hits nearer than 0.0001·the scene's largest coordinate are ignored; "
        "the surface is tested as all others are"
    ),
    RayOffset(minimum_distance=1e-3, relative_minimum_distance=1e-4): (
        "on the surface, hits nearer than 0.001 + 0.0001·max|o| are ignored; the surface cannot be hit again there"
    ),
    RayOffset(error_bound=10): (
        "up to 10 roundoffs of the point's terms along the normal; the surface cannot be hit again there"
    ),
    RayOffset(in_units=True): (
        "256 units of float32 in the last place, or 2^-16 near 0, for each coordinate along the normal; "
        "the surface cannot be hit again there"
    ),
    RayOffset(minimum_distance=1e-3, excludes_surface=False): (
        "on the surface, hits nearer than 0.001 are ignored; the surface is tested as all others are"
    ),
}


@pytest.mark.parametrize("offset", CLAUSES, ids=RayOffset.in_words)
def test_a_ray_offset_is_told_in_words(offset: RayOffset) -> None:
    assert offset.in_words() == CLAUSES[offset]


def test_how_triangles_are_drawn_is_told_in_words() -> None:
    model = ErrorModel("", 24, rasterisation=Rasterisation(subpixel_bits=8, depth_bits=16, light_bits=22))
    words = model.in_words()["drawing"]
    assert "snapped to 2^-8 of a pixel" in words
    assert "z-buffer of 16 bits" in words
    assert "their light errs by at most 2^-22" in words


def test_light_has_another_precision_only_where_triangles_are_drawn() -> None:
    traced = ErrorModel("", 24)
    assert traced.of_light() is traced
    drawn = replace(traced, rasterisation=Rasterisation(subpixel_bits=8, depth_bits=16, light_bits=22))
    assert drawn.of_light() == replace(drawn, precision_bits=22)
    assert drawn.of_light().of_light() == drawn.of_light()


def test_offsets_that_no_renderer_can_have_are_refused() -> None:
    with pytest.raises(ValueError, match="not negative"):
        RayOffset(absolute=-1e-4)
    with pytest.raises(ValueError, match="by nothing else"):
        RayOffset(absolute=1e-4, in_units=True)
    with pytest.raises(ValueError, match="along the normal"):
        RayOffset(error_bound=10, along="direction")
    with pytest.raises(ValueError, match="any of the other policies"):
        RayOffset(absolute=1e-4, is_bound=True, scale="scene")


@pytest.mark.parametrize(
    "fields",
    [
        {"sphere_test": "from the foot", "directions": "normalised"},
        {"shadow_tolerance": 1e-3, "triangle_test": "cramer"},
        {"ray_offset": RayOffset(absolute=1e-3, is_bound=True), "reflected_offset": RayOffset()},
    ],
)
def test_what_references_declare_alone_does_not_go_with_policies_for_kinds_of_rays(fields: Any) -> None:
    offset = RayOffset(excludes_surface="shadow_tolerance" not in fields)
    with pytest.raises(ValueError, match="do not go with policies"):
        ErrorModel("", 24, **{"ray_offset": offset, **fields})


def test_kinds_of_rays_have_the_offset_of_all_unless_they_have_their_own() -> None:
    own, all_others = RayOffset(absolute=1e-3), RayOffset(minimum_distance=1e-4)
    model = ErrorModel("", 24, all_others, reflected_offset=own)
    assert model.offsets() == (all_others, own, all_others, all_others)
    assert model.in_words()["reflected rays start"] == own.in_words()
    assert model.in_words()["shadow rays start"] == "as all others"


def test_a_shadow_tolerance_needs_surfaces_that_are_tested_and_is_no_less_than_the_least_distance() -> None:
    tested = RayOffset(minimum_distance=1e-3, excludes_surface=False)
    with pytest.raises(ValueError, match="shadow tolerance"):
        ErrorModel("", 24, shadow_tolerance=1e-3)
    with pytest.raises(ValueError, match="shadow tolerance"):
        ErrorModel("", 24, tested, shadow_tolerance=1e-4)
    words = ErrorModel("", 24, tested, shadow_tolerance=1e-2, index_bits=11).in_words()
    assert words["what is near"] == "nearer than 0.01 from the surface or the light may throw a shadow or none"
    assert words["indices of refraction"] == "stored with 11 bits"


def test_an_image_radius_is_not_negative_and_told_in_words() -> None:
    with pytest.raises(ValueError, match="image radius"):
        ErrorModel("", 24, image_radius=-0.5)
    assert ErrorModel("", 24).in_words()["camera rays go"] == "through the centres of pixels"
    words = ErrorModel("", 24, image_radius=0.5).in_words()
    assert words["camera rays go"] == "within 0.5 pixels of a pixel's centre, in x and in y"


@pytest.mark.parametrize(("radius", "growth"), [(1.0, 1.0), (1e3, 1.0), (1e4, 16.0), (1e5, 128.0)])
def test_least_distances_grow_with_the_extent_of_a_scene_by_powers_of_two(radius: float, growth: float) -> None:
    tested = RayOffset(absolute=1e-3, minimum_distance=1e-3, excludes_surface=False)
    model = ErrorModel("", 24, tested, shadow_tolerance=1e-2, largest_extent=16_384.0, farthest=1e5)
    scene = small_scene(objects=[sphere("white", radius=radius)])
    scaled = model.in_scene(scene)
    assert scaled.ray_offset == replace(tested, minimum_distance=growth * 1e-3)
    assert scaled.shadow_tolerance == growth * 1e-2
    assert scaled.farthest == growth * 1e5
    assert "farther than 1.638e+04" in model.in_words()["large scenes"]
    assert "farther than 1e+05" in model.in_words()["infinite planes"]
    assert ErrorModel("", 24).in_words()["infinite planes"] == "are met at any distance"
    assert ErrorModel("", 24, tested).in_scene(scene) == ErrorModel("", 24, tested)


def test_the_words_have_a_clause_for_every_field() -> None:
    assert len(ErrorModel("a renderer", 24).in_words()) == len(fields(ErrorModel))


def test_a_renderer_declares_random_choices_if_and_only_if_some_scene_is_stochastic() -> None:
    scenes = [open_scene(name) for name in library_names()]
    for renderer in all_renderers().values():
        is_random = any(
            renderer.is_stochastic(scene, integrator.name) for scene in scenes for integrator in renderer.integrators
        )
        assert is_random == bool(renderer.error_model.random_choices), renderer.name
