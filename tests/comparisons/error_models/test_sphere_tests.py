"""Mitsuba's tests of rays against spheres: they are the truth's, and float32's distances lie in their enclosures."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.hit_points import hit_point_behaviour
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.ray_offsets import offset_behaviour
from raytruth.comparisons.error_models.shortcuts import without_shortcuts
from raytruth.comparisons.error_models.sphere_tests import sphere_test_behaviour
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import merged
from raytruth.reference_tracer.source.scene_data import SPHERE_CENTER, SPHERE_MATERIAL, SPHERE_RADIUS
from raytruth.reference_tracer.source.sphere import sphere_distance
from raytruth.scenes.features import Feature
from tests.comparisons.deciding_scenes import ball_as_ground, ball_from_afar
from tests.reference_tracer.kernels import kept_precision, put_in_force, scene_data

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.scenes.scene import Scene

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

OFFSET = RayOffset(1500 * 2.0**-24, 1500 * 2.0**-24)
FROM_FOOT = ErrorModel("", 24, OFFSET, sphere_test="from the foot")
IN_DOUBLE = replace(FROM_FOOT, sphere_test="from the foot, accurate for shadows")
PUT_BACK = replace(IN_DOUBLE, sphere_points="put back", triangle_test="moeller-trumbore", triangle_points="barycentric")
Case = tuple[Any, Any, Any, float]


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def kernel_of(model: ErrorModel, scene: Scene) -> tuple[Any, Decisions]:
    decisions = Decisions()
    arithmetic = put_in_force(rounded_ball_arithmetic(model.precision_bits, decisions))
    return make_kernel(arithmetic, set(Feature) - {Feature.TRIANGLES}, behaviour_of(model, scene)), decisions


def behaviour_of(model: ErrorModel, scene: Scene) -> Behaviour:
    return merged(HELPERS, offset_behaviour(model), sphere_test_behaviour(model, scene), hit_point_behaviour(model))


def cases() -> list[Case]:
    """Rays of float32 near spheres, a quarter of them a million away from the origin."""
    random = np.random.default_rng(7)
    drawn: list[Case] = []
    for number in range(400):
        radius = np.float32(10.0 ** random.uniform(-2, 3))
        center = (random.normal(size=3) * radius + (1e6 if number % 4 == 0 else 0)).astype(np.float32)
        aim = random.normal(size=3)
        origin = (center + aim / np.linalg.norm(aim) * radius * 10.0 ** random.uniform(-1, 2)).astype(np.float32)
        target = center + random.normal(size=3) * radius * 0.7
        direction = (target - origin) / np.linalg.norm(target - origin)
        drawn.append((origin, direction.astype(np.float32), center, radius))
    return drawn


def mitsubas_distance(origin: Any, direction: Any, center: Any, radius: Any, kind: type) -> float:
    """Its own steps, one rounding at a time; `kind` is the number type of all but the foot on the ray."""
    wide_direction = direction.astype(kind)
    foot = -dot(origin.astype(kind) - center.astype(kind), wide_direction) / np.sqrt(
        dot(wide_direction, wide_direction)
    )
    start = (origin + np.float32(foot) * direction).astype(kind) - center.astype(kind)
    a, b = dot(wide_direction, wide_direction), kind(2) * dot(start, wide_direction)
    c = dot(start, start) - kind(radius) * kind(radius)
    discriminant = b * b - kind(4) * a * c
    if discriminant < 0:
        return math.inf
    larger = kind(-0.5) * (b + np.copysign(np.sqrt(discriminant), b))
    near, far = sorted((larger / a + foot, c / larger + foot))
    return float(np.float32(near if near >= 0 else far)) if far >= 0 else math.inf


def dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_the_enclosures_hold_what_mitsuba_computes(kind: Any) -> None:
    kernel, decisions = kernel_of(FROM_FOOT, ball_from_afar())
    hits = 0
    for origin, direction, center, radius in cases():
        balls = [tuple(arb(float(number)) for number in vector) for vector in (origin, direction, center)]
        data = scene_data({SPHERE_CENTER: [balls[2]], SPHERE_RADIUS: [arb(float(radius))]})
        outcomes = list(
            every_outcome(lambda data=data, balls=balls: kernel.nearest_sphere(data, *balls[:2], -1)[0], decisions, 8)
        )
        distance = mitsubas_distance(origin, direction, center, radius, kind)
        if math.isfinite(distance):
            hits += 1
            # It is rounded once more than the formula's result: to float32, where that is in float64.
            rounding = arb(0, distance * 2.0**-24)
            assert any((ball + rounding).contains(arb(distance)) for ball in outcomes if ball.is_finite())
        else:
            assert any(not ball.is_finite() for ball in outcomes)
    assert hits > 100


def test_the_enclosures_hold_the_points_that_mitsuba_puts_back() -> None:
    kernel, decisions = kernel_of(PUT_BACK, ball_from_afar())
    ratios = []
    for origin, direction, center, radius in cases():
        distance = mitsubas_distance(origin, direction, center, radius, np.float64)
        if not math.isfinite(distance):
            continue
        from_center = origin + np.float32(distance) * direction - center
        if not from_center.any():  # rounding has made the point the centre, which lies in no direction from itself
            continue
        point = from_center / np.sqrt(dot(from_center, from_center)) * np.float32(radius) + center
        balls = [tuple(arb(float(number)) for number in vector) for vector in (origin, direction, center)]
        data = scene_data({SPHERE_CENTER: [balls[2]], SPHERE_RADIUS: [arb(float(radius))], SPHERE_MATERIAL: [0]})

        def hit(data: Any = data, balls: Any = balls) -> Any:
            return kernel.hit_point(data, *balls[:2], kernel.nearest_sphere(data, *balls[:2], -1)[0], 0)

        points = [found for found in every_outcome(hit, decisions, 8) if all(ball.is_finite() for ball in found)]
        fits = [all(b.contains(arb(float(x))) for b, x in zip(found, point, strict=True)) for found in points]
        assert any(fits), [[number.hex() for number in map(float, vector)] for vector in (origin, direction, center)]
        lengths = distance + np.abs(center).max() + radius
        ratios.append(max(float(ball.rad()) for ball in points[fits.index(True)]) / (lengths * 2.0**-24))
    assert len(ratios) > 100
    assert np.median(ratios) < 64  # of some twenty roundings, and what plain balls count twice


@pytest.mark.parametrize("model", [FROM_FOOT, IN_DOUBLE])
def test_it_is_the_truths_in_float64(model: ErrorModel) -> None:
    behaviour = behaviour_of(model, ball_from_afar()).with_numbers(lambda ball: float(ball.mid()))
    kernel = make_kernel(FLOAT, set(Feature) - {Feature.TRIANGLES}, behaviour)
    for origin, direction, center, radius in cases():
        ray = [tuple(vector.astype(float).tolist()) for vector in (origin, direction, center)]
        data = scene_data({SPHERE_CENTER: [ray[2]], SPHERE_RADIUS: [float(radius)]})
        expected = sphere_distance(*ray, float(radius))
        assert kernel.nearest_sphere(data, *ray[:2], -1)[0] == pytest.approx(expected, rel=1e-5)
        assert kernel.distance_to_sphere(data, *ray[:2], -1, 0) == pytest.approx(expected, rel=1e-5)
        assert kernel.is_occluded(data, *ray[:2], -1, math.inf) == (expected < math.inf)


@pytest.mark.parametrize("model", [FROM_FOOT, IN_DOUBLE])
@pytest.mark.parametrize(("radius", "may_meet_itself"), [(1.0, {False}), (1e4, {True, False})])
def test_a_sphere_shadows_itself_where_the_offset_is_lost_to_rounding(
    model: ErrorModel, radius: float, may_meet_itself: set[bool]
) -> None:
    kernel, decisions = kernel_of(model, ball_as_ground())
    above = 1e-4 if radius == 1.0 else arb(0, 1e-3)
    origin = (arb(0), arb(above), arb(0))
    data = scene_data({SPHERE_CENTER: [(arb(0), arb(-radius), arb(0))], SPHERE_RADIUS: [arb(radius)]})
    up = (arb(0), arb(1), arb(0))
    outcomes = every_outcome(lambda: kernel.is_occluded(data, origin, up, 0, arb(math.inf)), decisions, 16)
    assert set(outcomes) == may_meet_itself


@pytest.mark.parametrize(("radius", "may_meet_itself"), [(1.0, {False}), (1e3, {True, False})])
def test_a_ray_may_come_back_to_a_sphere_that_is_large_beside_its_start(radius: float, may_meet_itself: Any) -> None:
    kernel, decisions = kernel_of(PUT_BACK, ball_from_afar())
    data = scene_data({SPHERE_CENTER: [(arb(0), arb(-radius), arb(0))], SPHERE_RADIUS: [arb(radius)]})
    origin, up = (arb(0), arb(1e-5, 2e-5), arb(0)), (arb(0), arb(1), arb(0))
    outcomes = [
        distance for distance, _ in every_outcome(lambda: kernel.nearest_sphere(data, origin, up, 0), decisions, 16)
    ]
    assert {bool(distance.is_finite()) for distance in outcomes} == may_meet_itself


@pytest.mark.parametrize("model", [FROM_FOOT, IN_DOUBLE])
def test_without_an_offset_a_sphere_that_a_ray_has_left_is_known_by_its_number(model: ErrorModel) -> None:
    """As in the truth: only its other side remains, however large it is and wherever rounding put the start."""
    kernel, decisions = kernel_of(without_shortcuts(model), ball_as_ground())
    data = scene_data({SPHERE_CENTER: [(arb(0), arb(-1e4), arb(0))], SPHERE_RADIUS: [arb(1e4)]})
    origin, up, down = (arb(0), arb(0, 1e-3), arb(0)), (arb(0), arb(1), arb(0)), (arb(0), arb(-1), arb(0))
    for find in (
        lambda direction: kernel.nearest_sphere(data, origin, direction, 0)[0],
        lambda direction: kernel.distance_to_sphere(data, origin, direction, 0, 0),
    ):
        (above,) = every_outcome(lambda find=find: find(up), decisions, 1)
        (below,) = every_outcome(lambda find=find: find(down), decisions, 1)
        assert not above.is_finite()
        assert float(below.mid()) == pytest.approx(2e4)


def test_only_who_tests_so_is_given_it_and_others_are_refused() -> None:
    scene = ball_from_afar()
    assert sphere_test_behaviour(ErrorModel("", 24), scene).names == ()
    assert set(sphere_test_behaviour(FROM_FOOT, scene).functions) == {"nearest_sphere", "distance_to_sphere"}
    assert FROM_FOOT.in_words()["spheres"] == "from the foot"
    for offset in (RayOffset(excludes_surface=False), replace(OFFSET, is_bound=True)):
        with pytest.raises(ValueError, match="from the foot"):
            replace(FROM_FOOT, ray_offset=offset)
    with pytest.raises(ValueError, match="weights"):
        ErrorModel("", 24, triangle_points="barycentric")
    with pytest.raises(ValueError, match="put back"):
        ErrorModel("", 24, sphere_points="put back")
