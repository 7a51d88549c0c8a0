"""All parts of an error model change the tracer together, and no two of them the same function."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.shortcuts import without_shortcuts
from raytruth.comparisons.feasible_sets.rounded_rays import PlainRays
from raytruth.comparisons.renderers.catalogue import all_renderers
from tests.comparisons.deciding_scenes import far_sphere, single_triangle
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2")


def test_the_behaviour_of_an_error_model_is_what_all_its_parts_change() -> None:
    scene = library_scene("single-triangle", 4, 3)
    assert behaviour_of(ErrorModel("", 24), scene).functions == {}
    offset = RayOffset(absolute=0.25, is_bound=True)
    model = ErrorModel("", 24, offset, triangle_test="pluecker", triangle_points="barycentric")
    behaviour = behaviour_of(model, scene)
    assert set(behaviour.functions) == {"departure", "is_shadowed", "triangle_distance", "hit_point"}
    assert set(HELPERS.names) < set(behaviour.names)
    drawn = behaviour_of(ErrorModel("", 24, rasterisation=Rasterisation(8, 24, 22)), scene)
    assert {"distance_to_triangle", "direct_light"} < set(drawn.functions)


def test_an_error_model_of_which_two_parts_change_one_function_is_refused() -> None:
    model = ErrorModel("", 24, RayOffset(excludes_surface=False), rasterisation=Rasterisation(8, 24, 22))
    with pytest.raises(ValueError, match=r"^ray offsets and .* both say what distance_to_triangle is$"):
        behaviour_of(model, library_scene("single-triangle", 4, 3))


SCENES = {
    "spheres": far_sphere(),
    "triangles": single_triangle(),
    "both": library_scene("sphere-over-floor", 4, 3),
}


@pytest.mark.parametrize("changed", [lambda model: model, without_shortcuts], ids=["as declared", "without shortcuts"])
@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
@pytest.mark.parametrize("name", all_renderers())
def test_no_two_parts_of_what_a_renderer_declares_change_one_function(
    name: str, scene: Scene, changed: Callable[[ErrorModel], ErrorModel]
) -> None:
    for _, error_model in all_renderers()[name].error_models:
        PlainRays(scene, changed(error_model))  # which raises an error where they do, or need what is not there
