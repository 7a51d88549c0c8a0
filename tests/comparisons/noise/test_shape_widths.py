from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.noise.shape_widths import LEAST_WIDTH, narrowest_width
from raytruth.comparisons.noise.splat_bound import GRID, largest_splats
from raytruth.reference_tracer.rendering import render
from tests.reference_tracer.small_scenes import lamp, small_scene, sphere

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2")

PIXELS = 8
DISTANCE = 4.0
# Of a pixel of a camera with a field of view of 90 degrees, at that distance.
PIXEL = 2 * DISTANCE / PIXELS


def lit(*objects: object, size: float = 1.0) -> Scene:
    return small_scene(
        projection="perspective",
        width=PIXELS,
        height=PIXELS,
        extent=90.0,
        camera={"position": (0.0, 0.0, DISTANCE * size)},
        materials={"red": {"diffuse": {"reflectance": (1.0, 0.0, 0.0)}}},
        objects=list(objects),
        lights=[lamp((0.0, 0.0, DISTANCE * size), falloff="inverse_square")],
    )


def triangle(*vertices: tuple[float, float, float]) -> dict[str, object]:
    return {"shape": "triangle", "vertices": vertices, "material": "red"}


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e4])
def test_a_ball_is_as_wide_as_its_diameter_at_its_far_side(size: float) -> None:
    radius = 0.1 * size
    ball = sphere("red", radius=radius)
    expected = 0.2 * size / (PIXEL * size * (DISTANCE + 0.1) / DISTANCE)
    assert narrowest_width(lit(ball, size=size)) == pytest.approx(expected)


@pytest.mark.parametrize("turn", range(3))
def test_a_triangle_is_as_wide_as_the_circle_inscribed_in_it(turn: int) -> None:
    corners = [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 4.0, 0.0)]  # with an inscribed circle of radius 1
    whole = lit(triangle(*corners[turn:], *corners[:turn]))
    assert narrowest_width(whole) == pytest.approx(2.0 / PIXEL)
    half = {"shape": "mesh", "vertices": corners, "faces": [(0, 1, 2)], "material": "red"}
    assert narrowest_width(lit(half, sphere("red", radius=9.0))) == pytest.approx(2.0 / PIXEL)


def test_what_lies_behind_the_camera_counts_for_nothing() -> None:
    behind = sphere("red", center=(0.0, 0.0, 2 * DISTANCE), radius=1e-9)
    assert narrowest_width(lit(behind)) == math.inf
    assert narrowest_width(lit(behind, sphere("red", radius=0.5))) > 0.1


def test_a_ball_that_is_wide_enough_is_seen_by_a_point_wherever_it_lies() -> None:
    random = np.random.default_rng(7)
    missed = 0
    for _ in range(60):
        x, y = random.uniform(-1, 1, 2)
        seen = [hides(x, y, share) for share in (1.001, 0.5)]
        assert not seen[0], f"a ball at {x.hex()}, {y.hex()}"
        missed += seen[1]
    assert missed > 0, "no ball was narrow enough to hide"


def hides(x: float, y: float, share: float) -> bool:
    """Whether none of the points of the grid sees a ball of this share of the least width."""
    radius = share * LEAST_WIDTH * PIXEL / 2
    scene = lit(sphere("red", center=(x, y, -radius), radius=radius))
    points = scene.resized(PIXELS * GRID, PIXELS * GRID)
    return not render(points).any() and not largest_splats(scene).any()
