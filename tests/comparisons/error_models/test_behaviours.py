"""All parts of an error model change the tracer together, and no two of them the same function."""

from __future__ import annotations

import pytest

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.error_models.error_model import ErrorModel, Rasterisation, RayOffset
from raytruth.comparisons.error_models.helpers import HELPERS
from tests.reference_tracer.small_scenes import library_scene

pytestmark = pytest.mark.clause("VER-2")


def test_the_behaviour_of_an_error_model_is_what_all_its_parts_change() -> None:
    scene = library_scene("single-triangle", 4, 3)
    assert behaviour_of(ErrorModel("", 24), scene).functions == {}
    offset = RayOffset(absolute=0.25, is_bound=True)
    model = ErrorModel("", 24, offset, triangle_test="pluecker", triangle_points="barycentric")
    behaviour = behaviour_of(model, scene)
    assert set(behaviour.functions) == {"departure", "is_shadowed", "triangle_distance", "surface_at"}
    assert set(HELPERS.names) < set(behaviour.names)
    drawn = behaviour_of(ErrorModel("", 24, rasterisation=Rasterisation(8, 24, 22)), scene)
    assert {"distance_to_triangle", "direct_light"} < set(drawn.functions)


def test_an_error_model_of_which_two_parts_change_one_function_is_refused() -> None:
    model = ErrorModel("", 24, triangle_points="barycentric", rasterisation=Rasterisation(8, 24, 22))
    with pytest.raises(ValueError, match=r"^points on triangles and .* both say what surface_at is$"):
        behaviour_of(model, library_scene("single-triangle", 4, 3))
