"""Points on triangles from barycentric coordinates: they are the truth's, and float32's lie in their enclosures."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.hit_points import (
    INTERPOLATION_ROUNDOFFS,
    hit_point_behaviour,
    hit_point_by_moeller_trumbore,
    hit_point_by_pluecker,
)
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import merged
from raytruth.reference_tracer.source.ray_tree import hit_point
from raytruth.reference_tracer.source.scene_data import (
    SPHERE_CENTER,
    SPHERE_MATERIAL,
    SPHERE_RADIUS,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
    TRIANGLE_MATERIAL,
)
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.scenes.features import Feature
from tests.comparisons.error_models.test_triangle_tests import random_cases
from tests.reference_tracer.kernels import kept_precision, put_in_force, scene_data

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

BITS = 23
PLUECKER = ErrorModel("", BITS, triangle_test="pluecker", triangle_points="barycentric")
MOELLER_TRUMBORE = replace(PLUECKER, triangle_test="moeller-trumbore", sphere_points="put back")
TABLES = (TRIANGLE_A, TRIANGLE_B, TRIANGLE_C)
BALL = {SPHERE_CENTER: [(0.0, 0.0, 0.0)], SPHERE_RADIUS: [1.0], SPHERE_MATERIAL: [0]}


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def hits() -> list[tuple[Any, ...]]:
    cases = [case for case in random_cases(400) if math.isfinite(triangle_distance(*case))]
    assert len(cases) > 50
    return cases


def triangle_data(*corners: Any) -> Any:
    tables: dict[int, list[Any]] = {table: [corner] for table, corner in zip(TABLES, corners, strict=True)}
    return scene_data(tables | {TRIANGLE_MATERIAL: [0]})


@pytest.mark.parametrize("find", [hit_point_by_pluecker, hit_point_by_moeller_trumbore])
def test_the_point_is_the_truths(find: Any) -> None:
    for origin, direction, *corners in hits():
        data, distance = triangle_data(*corners), triangle_distance(origin, direction, *corners)
        expected = hit_point(data, origin, direction, distance, 0)
        tolerance = 1e-9 * np.abs(corners).max()
        assert find(data, origin, direction, distance, 0) == pytest.approx(expected, rel=1e-9, abs=tolerance)


@pytest.mark.parametrize("find", [hit_point_by_pluecker, hit_point_by_moeller_trumbore])
def test_a_point_on_a_sphere_is_found_along_the_ray(find: Any) -> None:
    assert find(scene_data(BALL), (0.25, 0.0, 3.0), (0.0, 0.0, -1.0), 2.0, 0) == (0.25, 0.0, 1.0)


def kernel_of(model: ErrorModel) -> tuple[Any, Decisions]:
    decisions = Decisions()
    arithmetic = put_in_force(rounded_ball_arithmetic(BITS, decisions))
    return make_kernel(arithmetic, set(Feature), merged(HELPERS, hit_point_behaviour(model))), decisions


def balls_of(*vectors: Any) -> list[tuple[Any, ...]]:
    return [tuple(arb(float(number)) for number in vector) for vector in vectors]


def test_the_normal_at_a_point_beside_a_sphere_has_length_1() -> None:
    kernel, _ = kernel_of(replace(MOELLER_TRUMBORE, sphere_points="normalised"))
    normal = kernel.sphere_normal(*balls_of((0.25, 0.0, 1.0), (0.0, 0.0, 0.0)), arb(1))
    assert float(sum(ball * ball for ball in normal).mid()) == pytest.approx(1.0, abs=1e-6)


def pluecker_weights(origin: Any, direction: Any, corners: Any) -> tuple[Any, Any]:
    to_corners = [corner - origin for corner in corners]
    products = []
    for first, second in ((2, 0), (0, 1), (1, 2)):
        edge, middle = to_corners[first] - to_corners[second], to_corners[first] + to_corners[second]
        products.append(sum_of_products(cross_product(edge, middle), direction))
    reciprocal = np.float32(1) / (products[0] + products[1] + products[2])
    return products[0] * reciprocal, products[1] * reciprocal


def moeller_trumbore_weights(origin: Any, direction: Any, corners: Any) -> tuple[Any, Any]:
    a, b, c = corners
    turn = cross_product(a - origin, direction)
    reciprocal = np.float32(1) / sum_of_products(cross_product(c - a, a - b), direction)
    return sum_of_products(turn, c - a) * reciprocal, sum_of_products(turn, a - b) * reciprocal


def cross_product(a: Any, b: Any) -> tuple[Any, ...]:
    """In float32, one rounding at a time, as the next."""
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def sum_of_products(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@pytest.mark.parametrize(
    ("model", "weights"), [(PLUECKER, pluecker_weights), (MOELLER_TRUMBORE, moeller_trumbore_weights)]
)
def test_the_enclosure_holds_what_float32_interpolates_and_is_not_much_wider(model: ErrorModel, weights: Any) -> None:
    kernel, decisions = kernel_of(model)
    ratios = []
    for case in hits():
        origin, direction, *corners = (np.array(vector, dtype=np.float32) for vector in case)
        u, v = weights(origin, direction, corners)
        found = (np.float32(1) - u - v) * corners[0] + u * corners[1] + v * corners[2]
        balls = balls_of(origin, direction, *corners)
        data = triangle_data(*balls[2:])
        distance = arb(triangle_distance(*(vector.astype(float).tolist() for vector in (origin, direction, *corners))))
        (point,) = every_outcome(
            lambda data=data, balls=balls, t=distance: kernel.hit_point(data, *balls[:2], t, 0), decisions, 1
        )
        for ball, value in zip(point, found.tolist(), strict=True):
            assert ball.contains(arb(value))
            ratios.append(float(ball.rad()) / (np.abs(corners).max() * 2.0**-BITS))
    assert np.median(ratios) < 16 * INTERPOLATION_ROUNDOFFS


def test_only_who_interpolates_is_given_it_and_the_words_say_so() -> None:
    assert hit_point_behaviour(ErrorModel("", 24)).functions == {}
    assert hit_point_behaviour(PLUECKER).functions == {"hit_point": hit_point_by_pluecker}
    assert hit_point_behaviour(MOELLER_TRUMBORE).functions == {"hit_point": hit_point_by_moeller_trumbore}
    assert PLUECKER.in_words()["points on triangles"].startswith("barycentric: ")
    assert MOELLER_TRUMBORE.in_words()["points on spheres"] == "put back"
    assert all(hit_point_behaviour(MOELLER_TRUMBORE).constants[f"put_back_error_{axis}"].rad() > 0 for axis in "xyz")
    assert all(hit_point_behaviour(PLUECKER).constants[f"put_back_error_{axis}"] == 0 for axis in "xyz")
