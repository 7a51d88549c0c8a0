"""The worked numbers of docs/implementers-notes.md are those of the truth."""

from __future__ import annotations

from math import exp
from typing import Any

import numpy as np
import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from tests.reference_tracer.small_scenes import lamp, small_scene, sphere, square

pytestmark = pytest.mark.clause("PRJ-2")

WHITE = (1.0, 1.0, 1.0)


def center(**changes: Any) -> float:
    """The one pixel of a scene of small_scenes.py, which is grey."""
    image = np.asarray(render(small_scene(**changes), FLOAT))
    return float(image[0, 0, 0])


def glass(**more: Any) -> dict[str, Any]:
    return {"dielectric": {"index_of_refraction": 1.5, **more}}


@pytest.mark.clause("REFR-1", "REFR-5", "REFR-9")
@pytest.mark.parametrize("inside", [None, "water"])
def test_the_sky_over_water_is_brighter_in_the_water_whether_or_not_the_camera_states_that_it_is_inside(
    inside: str | None,
) -> None:
    surface = {"shape": "mesh", "vertices": ((9, 0, 9), (9, 0, -9), (-9, 0, -9), (-9, 0, 9)), "material": "water"}
    sky = center(
        convention="radiometric",
        max_depth=1,
        background={"bottom": (0.0, 0.0, 0.0), "top": WHITE},
        camera={"position": (0.0, -5.0, 0.0), "up": (0.0, 0.0, 1.0), "inside": inside},
        materials={"water": glass(index_of_refraction=4 / 3)},
        objects=[surface | {"faces": ((0, 1, 2), (0, 2, 3))}],
    )
    assert sky == pytest.approx((48 / 49) * (16 / 9))
    assert sky == pytest.approx(1.741, abs=1e-3)


@pytest.mark.clause("SHAD-1", "SHAD-5")
@pytest.mark.parametrize(("height", "lit"), [(1.0, 1.0), (1.001, 0.0), (0.999, 1.0)])
def test_a_light_on_a_closed_surface_lights_its_inside(height: float, lit: float) -> None:
    camera = {"position": (0.0, 0.0, 0.0), "look_at": (0.0, -1.0, 0.0), "up": (0.0, 0.0, 1.0)}
    assert center(projection="perspective", camera=camera, lights=[lamp((0.0, height, 0.0))]) == pytest.approx(lit)


@pytest.mark.clause("SHAD-1", "SHAD-5")
def test_a_light_on_a_closed_surface_lights_its_outside() -> None:
    objects = [sphere("white", (0.0, 0.0, 2.0)), square("white", 0.0)]  # the light is where the sphere touches z = 3
    camera = {"position": (0.5, 0.0, 9.0), "look_at": (0.5, 0.0, 3.5)}
    screen = square("white", 3.5)
    assert center(camera=camera, objects=[*objects, screen], lights=[lamp((0.5, 0.0, 4.0))]) == 1.0


@pytest.mark.clause("REFR-7")
def test_absorption_weighs_local_light() -> None:
    def lit(**absorption: Any) -> float:
        return center(
            camera={"position": (0.0, 0.0, 3.0), "inside": "syrup"},
            materials={"white": {"diffuse": {"reflectance": WHITE}}, "syrup": glass(**absorption)},
            lights=[lamp((0.0, 0.0, 9.0))],
        )

    assert lit() == 1.0
    assert lit(absorption=(0.5, 0.5, 0.5)) == pytest.approx(exp(-1))


@pytest.mark.clause("TREE-2")
def test_a_glass_ball_needs_depth_2_to_be_seen_through() -> None:
    ball = {
        "background": {"color": WHITE},
        "materials": {"glass": glass()},
        "objects": [sphere("glass")],
    }
    shown = [center(max_depth=depth, **ball) for depth in (0, 1, 2)]
    assert shown == pytest.approx([0.0, 0.04, 0.04 + 0.96**2])


def test_a_float32_of_a_tenth_is_off_by_less_than_its_roundoff() -> None:
    assert float(np.float32(0.1)) == pytest.approx(0.100000001490, abs=1e-12)
    assert abs(float(np.float32(0.1)) / 0.1 - 1) == pytest.approx(1.5e-8, rel=0.01)
