"""Points on triangles from barycentric coordinates: they are the truth's, and float32's lie in their enclosures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb
from raytruth.comparisons.error_models.triangle_points import (
    INTERPOLATION_ROUNDOFFS,
    surface_at_barycentric,
    triangle_point_constants,
    triangle_point_overrides,
)

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.source.ray_tree import surface_at
from raytruth.reference_tracer.source.scene_data import (
    SPHERE_CENTER,
    SPHERE_MATERIAL,
    SPHERE_RADIUS,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
)
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.scenes.requirements import Feature
from tests.comparisons.error_models.test_triangle_tests import random_cases
from tests.reference_tracer.kernels import kept_precision, scene_data

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

BITS = 23
BARYCENTRIC = ErrorModel("", BITS, triangle_points="barycentric")


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def hits() -> list[tuple[Any, ...]]:
    cases = [case for case in random_cases(400) if math.isfinite(triangle_distance(*case))]
    assert len(cases) > 50
    return cases


def triangle_data(*corners: Any) -> Any:
    return scene_data({table: [corner] for table, corner in zip(TABLES, corners, strict=True)})


TABLES = (TRIANGLE_A, TRIANGLE_B, TRIANGLE_C)


def test_the_point_is_the_truths() -> None:
    for origin, direction, *corners in hits():
        data, distance = triangle_data(*corners), triangle_distance(origin, direction, *corners)
        point, normal, entering = surface_at_barycentric(data, origin, direction, distance, 0)
        expected = surface_at(data, origin, direction, distance, 0)
        assert point == pytest.approx(expected[0], rel=1e-9, abs=1e-9 * np.abs(corners).max())
        assert (normal, entering) == expected[1:]


def test_a_point_on_a_sphere_is_found_along_the_ray() -> None:
    data = scene_data({SPHERE_CENTER: [(0.0, 0.0, 0.0)], SPHERE_RADIUS: [1.0], SPHERE_MATERIAL: [0]})
    point, _, entering = surface_at_barycentric(data, (0.25, 0.0, 3.0), (0.0, 0.0, -1.0), 2.0, 0)
    assert point == (0.25, 0.0, 1.0)
    assert entering


def interpolated(origin: Any, direction: Any, corners: Any) -> Any:
    """In float32, one rounding at a time."""
    to_corners = [corner - origin for corner in corners]
    products = []
    for first, second in ((2, 0), (0, 1), (1, 2)):
        edge, middle = to_corners[first] - to_corners[second], to_corners[first] + to_corners[second]
        x, y, z = (edge[i - 2] * middle[i - 1] - edge[i - 1] * middle[i - 2] for i in range(3))
        products.append(x * direction[0] + y * direction[1] + z * direction[2])
    reciprocal = np.float32(1) / (products[0] + products[1] + products[2])
    u, v = products[0] * reciprocal, products[1] * reciprocal
    return (np.float32(1) - u - v) * corners[0] + u * corners[1] + v * corners[2]


def test_the_enclosure_holds_what_float32_interpolates_and_is_not_much_wider() -> None:
    decisions = Decisions()
    arithmetic = rounded_ball_arithmetic(BITS, decisions, triangle_point_constants(BARYCENTRIC))
    kernel = make_kernel(arithmetic, set(Feature), triangle_point_overrides(BARYCENTRIC))
    ratios = []
    for case in hits():
        origin, direction, *corners = (np.array(vector, dtype=np.float32) for vector in case)
        found = interpolated(origin, direction, corners)
        balls = [tuple(arb(float(number)) for number in vector) for vector in (origin, direction, *corners)]
        data = triangle_data(*balls[2:])
        (surface,) = every_outcome(
            lambda data=data, balls=balls: kernel.surface_at(data, *balls[:2], arb(1), 0), decisions, 1
        )
        for ball, value in zip(surface[0], found.tolist(), strict=True):
            assert ball.contains(arb(value))
            ratios.append(float(ball.rad()) / (np.abs(corners).max() * 2.0**-BITS))
    assert np.median(ratios) < 16 * INTERPOLATION_ROUNDOFFS


def test_only_who_interpolates_is_given_it_and_the_words_say_so() -> None:
    assert triangle_point_overrides(ErrorModel("", 24)) == {}
    assert triangle_point_overrides(BARYCENTRIC) == {"surface_at": surface_at_barycentric}
    assert BARYCENTRIC.in_words()["points on triangles"] == "barycentric"
