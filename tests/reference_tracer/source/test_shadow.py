from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from raytruth.reference_tracer.rendering import render
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.source.shadow import is_shadowed
from tests.reference_tracer.kernels import EXACT, scene_data
from tests.reference_tracer.small_scenes import lamp, small_scene, sphere, square

# A floor (primitive 1) and a ball above it (primitive 0).
SCENE = scene_data(
    {
        layout.SPHERE_CENTER: [(0.0, 2.0, 0.0)],
        layout.SPHERE_RADIUS: [1.0],
        layout.SPHERE_MATERIAL: [0],
        layout.TRIANGLE_A: [(-9.0, 0.0, 9.0)],
        layout.TRIANGLE_B: [(9.0, 0.0, 9.0)],
        layout.TRIANGLE_C: [(0.0, 0.0, -9.0)],
        layout.TRIANGLE_MATERIAL: [0],
        layout.NODE_LOW: [(-9.0, 0.0, -9.0)],
        layout.NODE_HIGH: [(9.0, 0.0, 9.0)],
        layout.NODE_END: [1],
        layout.NODE_FIRST_TRIANGLE: [0],
        layout.NODE_TRIANGLES: [1],
        layout.NODE_ORDER: [0],
    }
)
UP = (0.0, 1.0, 0.0)
BALL, FLOOR = 0, 1


@pytest.mark.clause("SHAD-1")
@pytest.mark.parametrize(
    ("height", "shadowed"),
    [
        (0.5, False),  # a light below the ball: what stands behind a light does not matter
        (1.0, False),  # a light on the ball's surface, which is where the shadow ray ends
        (1.5, True),
        (4.0, True),
    ],
)
def test_only_what_stands_before_a_near_light_hides_it(height: float, shadowed: bool) -> None:
    assert is_shadowed(SCENE, FLOOR, (0.0, 0.0, 0.0), UP, (0.0, height, 0.0), True) == shadowed


@pytest.mark.clause("SHAD-2")
def test_a_far_light_is_hidden_by_anything_on_the_way() -> None:
    assert is_shadowed(SCENE, FLOOR, (0.0, 0.0, 0.0), UP, (0.0, 0.5, 0.0), False)
    assert not is_shadowed(SCENE, FLOOR, (1.5, 0.0, 0.0), UP, (0.0, 0.5, 0.0), False)


@pytest.mark.clause("SHAD-4")
def test_a_surface_does_not_hide_a_light_from_the_points_on_it() -> None:
    assert not is_shadowed(SCENE, FLOOR, (3.0, 0.0, 0.0), UP, (0.0, 9.0, 0.0), True)
    assert not is_shadowed(SCENE, BALL, (0.0, 3.0, 0.0), UP, (0.0, 9.0, 0.0), True)
    # Points that rounding has put a little below the surface: no shadow either.
    assert not is_shadowed(SCENE, FLOOR, (3.0, -(2.0**-30), 0.0), UP, (0.0, 9.0, 0.0), True)
    assert not is_shadowed(SCENE, BALL, (0.0, 3.0 - 2.0**-30, 0.0), UP, (0.0, 9.0, 0.0), True)


@pytest.mark.clause("SHAD-4")
def test_a_ball_hides_a_light_from_its_own_far_side() -> None:
    assert is_shadowed(SCENE, BALL, (0.0, 3.0, 0.0), UP, (0.0, -9.0, 0.0), True)


@pytest.mark.clause("SHAD-3")
@pytest.mark.parametrize(
    "term",
    [
        {"dielectric": {"index_of_refraction": 1.0}},
        {"emission": {"radiance": (1.0, 1.0, 1.0)}},
        {"mirror": {"reflectance": (1.0, 1.0, 1.0)}},
    ],
)
def test_glass_emitters_and_mirrors_hide_as_everything_does(term: dict[str, Any]) -> None:
    # The sphere is beside the ray from the camera to the origin, and on the way from there to the lamp.
    materials = {"white": {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}}, "other": term}
    floor, ball = square("white", 0.0), sphere("other", (3.0, 0.0, 4.0))
    for objects, seen in (([floor], Fraction(4, 5)), ([floor, ball], 0)):
        scene = small_scene(materials=materials, objects=objects, lights=[lamp((6.0, 0.0, 8.0))])
        assert render(scene, EXACT)[0, 0, 0] == seen


@pytest.mark.clause("SHAD-6")
def test_a_surface_in_the_same_place_throws_no_shadow() -> None:
    objects = [square("white", 0.0), square("white", 0.0), square("white", 0.0, 50.0)]
    image = render(small_scene(objects=objects, lights=[lamp((0.0, 0.0, 9.0))]), EXACT)
    assert image[0, 0, 0] == 1
