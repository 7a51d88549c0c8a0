from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Any

import mpmath
import pytest
from flint import arb
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.ray_offsets import offset_behaviour
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import merged
from raytruth.reference_tracer.source.scene_data import (
    PLANE_MATERIAL,
    PLANE_NORMAL,
    PLANE_POINT,
    SPHERE_CENTER,
    SPHERE_RADIUS,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
    TRIANGLE_MATERIAL,
)
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import kept_precision, put_in_force, scene_data

if TYPE_CHECKING:
    from collections.abc import Iterator

OFFSET = 2.0**-13
SHORTENING = 2.0**-10
# Of the angle between ray and normal: what grazes is another test's.
SMALLEST_COSINE = 0.01
# The precision is the same in all examples, so that it does not matter that the fixture runs once for all of them.
with_fixture = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


LIKE_MITSUBA = RayOffset(OFFSET, OFFSET)


@cache
def kernel_of(offset: RayOffset = LIKE_MITSUBA, bits: int = 53) -> tuple[Any, Decisions]:
    decisions = Decisions()
    model = ErrorModel("", bits, offset, SHORTENING)
    arithmetic = put_in_force(rounded_ball_arithmetic(bits, decisions))
    return make_kernel(arithmetic, set(Feature), merged(HELPERS, offset_behaviour(model))), decisions


def balls(vector: Any) -> Any:
    return tuple(arb(float(part)) for part in vector)


def holds(ball: Any, value: Any) -> bool:
    with mpmath.workprec(300):
        low, high = (mpmath.mpf(end.mid().str(90, radius=False)) for end in (ball.lower(), ball.upper()))
        slack = mpmath.mpf(10) ** -80 * (1 + abs(value))  # the decimals' own
        return bool(low - slack <= value <= high + slack)


def test_only_what_the_offset_changes_is_overridden() -> None:
    def names(offset: RayOffset, shortening: float = 0.0) -> set[str]:
        return set(offset_behaviour(ErrorModel("", 24, offset, shortening)).functions)

    tested = {"distance_to_sphere", "distance_to_triangle", "distance_to_plane"}
    assert names(RayOffset()) == set()
    assert names(RayOffset(), SHORTENING) == {"shadow_ray_end"}
    assert names(LIKE_MITSUBA) == {"departure", "distance_to_sphere", "distance_to_other_side"}
    assert names(RayOffset(absolute=OFFSET, excludes_surface=False)) == {"departure", *tested}
    assert names(RayOffset(minimum_distance=OFFSET, excludes_surface=False)) == tested
    model = ErrorModel("", 24, RayOffset(excludes_surface=False), shadow_tolerance=OFFSET)
    assert set(offset_behaviour(model).functions) == {"is_shadowed", *tested}
    assert set(offset_behaviour(ErrorModel("", 24, farthest=9.0)).functions) == {"nearest_hit"}


@pytest.mark.parametrize(("height", "comes_back"), [(0.3, True), (-0.3, False)])
def test_who_starts_beside_a_sphere_may_come_back_to_it_from_outside(height: float, comes_back: bool) -> None:
    kernel, decisions = kernel_of(RayOffset(absolute=0.3))
    data = scene_data({SPHERE_CENTER: [balls((0.0, 0.0, 0.0))], SPHERE_RADIUS: [arb(1)]})
    origin, down = balls((0.0, 1.0 + height, 0.0)), balls((0.0, -1.0, 0.0))
    (distance,) = every_outcome(lambda: kernel.distance_to_sphere(data, origin, down, 0, 0), decisions, 1)
    assert float(distance.mid()) == pytest.approx(height if comes_back else 1.7, abs=1e-9)


def test_shadow_rays_end_before_the_light() -> None:
    end = kernel_of()[0].shadow_ray_end()
    assert end.contains(arb(1 - SHORTENING))
    assert float(end.rad()) < 2.0**-50


POINTS = [((0.0, 0.0, 0.0), 0.0), ((1.0, -7.0, 3.0), 7.0), ((-2.5, 0.5, 1.0), 2.5), ((0.5, 1.0, 4.0), 4.0)]
POLICIES = [
    LIKE_MITSUBA,
    RayOffset(absolute=OFFSET),
    RayOffset(relative=OFFSET),
    RayOffset(OFFSET, 3 * OFFSET, excludes_surface=False),
    RayOffset(absolute=OFFSET, along="direction", excludes_surface=False),
    RayOffset(relative=OFFSET, along="direction", excludes_surface=False),
]


@pytest.mark.parametrize("offset", POLICIES, ids=RayOffset.in_words)
@pytest.mark.parametrize(("point", "largest"), POINTS)
def test_a_departing_ray_starts_where_the_policy_says(
    offset: RayOffset, point: tuple[float, float, float], largest: float
) -> None:
    normal, direction = (0.0, -0.75, 0.5), (3.0, 0.0, -4.0)  # the direction has length 5, the normal need not have 1
    start, left = kernel_of(offset)[0].departure(5, balls(point), balls(normal), balls(direction))
    assert left == 5
    vector = normal if offset.along == "normal" else (0.6, 0.0, -0.8)
    for coordinate, p, v in zip(start, point, vector, strict=True):
        exact = p + v * (offset.absolute + offset.relative * largest)
        assert float(abs(coordinate - exact).upper()) <= 2.0**-49 * (abs(p) + OFFSET * 32)


SPHERE = scene_data({SPHERE_CENTER: [(arb(0), arb(0), arb(0))], SPHERE_RADIUS: [arb(1)]})
CORNERS = {TRIANGLE_A: (-1, -1, 0), TRIANGLE_B: (1, -1, 0), TRIANGLE_C: (0, 1, 0)}
TRIANGLE = scene_data({**{table: [balls(corner)] for table, corner in CORNERS.items()}, TRIANGLE_MATERIAL: [0]})
LEAST = 2.0**-6


@pytest.mark.parametrize("speed", [1.0, 4.0])
def test_with_a_least_distance_each_root_of_a_sphere_is_tested_by_itself(speed: float) -> None:
    kernel, _ = kernel_of(RayOffset(minimum_distance=LEAST, excludes_surface=False))
    for start, expected in (
        (-3.0, 2.0),  # from far before it, the near side
        (-1.0 - 2 * LEAST, 2 * LEAST),
        (-1.0 - LEAST / 2, 2.0 + LEAST / 2),  # the near side is too near, the far one is not
        (-1.0, 2.0),  # on it, as a ray that goes on inside
        (1.0 - 2 * LEAST, 2 * LEAST),
        (1.0 - LEAST / 2, math.inf),
        (1.0, math.inf),
    ):
        ray = balls((0.0, 0.0, start)), balls((0.0, 0.0, speed))
        for left in (-1, 0):  # it does not matter where the ray says that it comes from
            distance = kernel.distance_to_sphere(SPHERE, *ray, left, 0)
            assert float(distance.mid()) * speed == pytest.approx(expected, rel=2.0**-40), start


@pytest.mark.parametrize("speed", [1.0, 4.0])
def test_with_a_least_distance_a_triangle_is_hit_only_beyond_it(speed: float) -> None:
    kernel, _ = kernel_of(RayOffset(minimum_distance=LEAST, excludes_surface=False))
    for height, expected in ((1.0, 1.0), (2 * LEAST, 2 * LEAST), (LEAST / 2, math.inf), (0.0, math.inf)):
        ray = balls((0.0, 0.0, height)), balls((0.0, 0.0, -speed))
        distance = kernel.distance_to_triangle(TRIANGLE, *ray, 0, 0)
        assert float(distance.mid()) * speed == pytest.approx(expected, rel=2.0**-40), height


@pytest.mark.parametrize(("absolute", "clear"), [(2.0**-30, False), (2.0**-10, True)])
def test_a_surface_that_is_not_excluded_may_be_met_again_where_the_offset_is_no_larger_than_rounding(
    absolute: float, clear: bool
) -> None:
    kernel, decisions = kernel_of(RayOffset(absolute=absolute, excludes_surface=False), 24)
    blurred = (arb(0), arb(0), arb(0, 2.0**-20))  # a hit point, as float32 knows it
    start, left = kernel.departure(0, blurred, balls((0, 0, 1)), balls((0, 0, 1)))
    run = lambda: kernel.distance_to_triangle(TRIANGLE, start, balls((0, 0, 1)), left, 0)  # noqa: E731 - used here only
    outcomes = {bool(distance.is_finite()) for distance in every_outcome(run, decisions, 4)}
    assert outcomes == ({False} if clear else {False, True})


COORDINATE = st.floats(-3, 3, width=32)
VECTOR = st.tuples(COORDINATE, COORDINATE, COORDINATE)


def length(vector: Any) -> Any:
    return mpmath.sqrt(mpmath.fsum(part * part for part in vector))


@with_fixture
@pytest.mark.parametrize("bits", [24, 51])
@given(center=VECTOR, radius=st.floats(0.125, 3, width=32), toward=VECTOR, direction=VECTOR)
def test_the_other_side_of_a_sphere_is_where_it_is_from_the_place_that_the_ray_started_at(
    bits: int, center: Any, radius: float, toward: Any, direction: Any
) -> None:
    assume(sum(abs(part) for part in toward) > 0.1)
    assume(sum(abs(part) for part in direction) > 0.1)
    kernel, decisions = kernel_of(bits=bits)
    with mpmath.workprec(300):
        normal = [mpmath.mpf(part) / length(map(mpmath.mpf, toward)) for part in toward]
        point = [c + radius * n for c, n in zip(center, normal, strict=True)]
        offset = mpmath.mpf(OFFSET) * (1 + max(map(abs, point)))
        assume(offset < radius / 2)
        origin = [p - offset * n for p, n in zip(point, normal, strict=True)]
        from_center = [o - c for o, c in zip(origin, center, strict=True)]
        half_linear = mpmath.fsum(d * f for d, f in zip(direction, from_center, strict=True))
        # Well inward, beyond what the bits of the origin below leave open.
        speed = length(map(mpmath.mpf, direction))
        assume(half_linear < -SMALLEST_COSINE * radius * speed)
        squared = mpmath.fsum(mpmath.mpf(d) * d for d in direction)
        constant = mpmath.fsum(f * f for f in from_center) - mpmath.mpf(radius) ** 2
        expected = (mpmath.sqrt(half_linear**2 - squared * constant) - half_linear) / squared
        # Balls that hold the exact origin, as wide as a renderer of so many bits would know it.
        start = tuple(arb(float(part), 2.0**-bits * (abs(float(part)) + 2.0**-20)) for part in origin)
    outcomes = list(
        every_outcome(lambda: kernel.distance_to_other_side(start, balls(direction), balls(center)), decisions, 2)
    )
    assert len(outcomes) == 1
    assert holds(outcomes[0], expected)
    # As tight as its inputs: the direction's and the origin's roundings grow with the inverse of the cosine; some ten
    # operations follow; and the offset itself is known up to ε times, and moves the root by up to 1/cosine times.
    coordinates = (max(map(abs, center)) + radius) / radius
    rounding = 2.0**-bits * 16 * float(expected) * (1 + coordinates) / SMALLEST_COSINE
    assert float(outcomes[0].rad()) <= rounding + 2 * float(offset / speed) * OFFSET / SMALLEST_COSINE


def test_a_ray_that_leaves_outward_does_not_meet_its_sphere_again() -> None:
    kernel, _ = kernel_of(bits=24)
    center = balls((0, 0, 0))
    for direction in ((0, 0, 1), (1, 0, 1), (1, 0, 0)):  # a tangent leaves, too
        distance = kernel.distance_to_other_side(balls((0, 0, 1 + OFFSET)), balls(direction), center)
        assert not distance.is_finite()
        assert distance > 0


def test_a_ray_that_may_graze_its_sphere_does_both() -> None:
    kernel, decisions = kernel_of(bits=24)
    grazing = (arb(1), arb(0), arb(0, 2.0**-20))
    outcomes = list(
        every_outcome(
            lambda: kernel.distance_to_other_side(balls((0, 0, 1 - OFFSET)), grazing, balls((0, 0, 0))),
            decisions,
            2,
        )
    )
    assert sorted(ball.is_finite() for ball in outcomes) == [False, True]


@pytest.mark.parametrize("light_is_near", [True, False])
@pytest.mark.parametrize(
    ("height", "expected"), [(LEAST / 2, {False}), (3 * LEAST, {True, False}), (5 * LEAST, {True}), (4.0, {True})]
)
def test_within_the_shadow_tolerance_something_throws_a_shadow_or_none(
    height: float, expected: set[bool], light_is_near: bool
) -> None:
    """The triangle stands at this height above the point, and below the light if that is near."""
    decisions = Decisions()
    offset = RayOffset(minimum_distance=LEAST, excludes_surface=False)
    model = ErrorModel("", 53, offset, shadow_tolerance=4 * LEAST)
    arithmetic = put_in_force(rounded_ball_arithmetic(53, decisions))
    features = set(Feature) - {Feature.BOUNDING_VOLUMES}  # one triangle needs no tree
    kernel = make_kernel(arithmetic, features, merged(HELPERS, offset_behaviour(model)))
    up = balls((0.0, 0.0, 1.0))
    below = balls((0.0, -0.2, -height))

    def answers(to_light: float) -> set[bool]:
        def shadowed() -> bool:
            return bool(kernel.is_shadowed(TRIANGLE, -1, below, up, balls((0.0, 0.0, to_light)), light_is_near))

        return set(every_outcome(shadowed, decisions, 4))

    assert answers(16.0) == expected
    if light_is_near and expected == {True}:
        assert answers(height + 3 * LEAST) == {True, False}
        assert answers(height + 5 * LEAST) == {True}
        assert answers(height - LEAST) == {False}


def floor(height: float) -> Any:
    """A plane across the z axis, and no triangle."""
    tables: dict[int, list[Any]] = {PLANE_POINT: [balls((9.0, 9.0, height))], PLANE_NORMAL: [balls((0.0, 0.0, 2.0))]}
    return scene_data(tables | {PLANE_MATERIAL: [0]})


def ways(ask: Any, decisions: Decisions) -> set[Any]:
    return set(every_outcome(ask, decisions, 4))


@pytest.mark.parametrize("speed", [1.0, 16.0])
def test_with_a_least_distance_a_plane_is_met_only_beyond_it_also_by_who_starts_on_it(speed: float) -> None:
    kernel, decisions = kernel_of(RayOffset(minimum_distance=LEAST, excludes_surface=False))
    down = balls((0.0, 0.0, -speed))

    def distance(height: float) -> Any:
        (found,) = every_outcome(
            lambda: kernel.distance_to_plane(floor(0.0), balls((0.0, 0.0, height)), down, 0, 0), decisions, 1
        )
        return found

    assert holds(distance(1.0), mpmath.mpf(1) / speed)
    assert holds(distance(2 * LEAST), mpmath.mpf(2 * LEAST) / speed)
    assert float(distance(LEAST / 2)) == math.inf
    assert float(distance(-1.0)) == math.inf


FARTHEST = 64.0


@pytest.mark.parametrize(("depth", "hits"), [(1.0, {0}), (FARTHEST / 2, {0}), (2 * FARTHEST, {0, -1})])
@pytest.mark.parametrize("speed", [1.0, 4.0])
def test_a_plane_that_is_too_far_is_met_or_not(depth: float, hits: set[int], speed: float) -> None:
    decisions = Decisions()
    arithmetic = put_in_force(rounded_ball_arithmetic(53, decisions))
    model = ErrorModel("", 53, farthest=FARTHEST)
    kernel = make_kernel(arithmetic, set(Feature), merged(HELPERS, offset_behaviour(model)))
    origin, down = balls((0.0, 0.0, 0.0)), balls((0.0, 0.0, -speed))
    assert ways(lambda: kernel.nearest_hit(floor(-depth), origin, down, -1)[1], decisions) == hits


@pytest.mark.parametrize("light_is_near", [True, False])
@pytest.mark.parametrize(("height", "expected"), [(4.0, {True}), (2 * FARTHEST, {True, False}), (-4.0, {False})])
def test_a_plane_that_is_too_far_throws_a_shadow_or_none(
    height: float, expected: set[bool], light_is_near: bool
) -> None:
    decisions = Decisions()
    arithmetic = put_in_force(rounded_ball_arithmetic(53, decisions))
    offset = RayOffset(minimum_distance=LEAST, excludes_surface=False)
    model = ErrorModel("", 53, offset, shadow_tolerance=4 * LEAST, farthest=FARTHEST)
    kernel = make_kernel(arithmetic, set(Feature), merged(HELPERS, offset_behaviour(model)))
    point, up, to_light = balls((0.0, 0.0, 0.0)), balls((0.0, 0.0, 1.0)), balls((0.0, 0.0, 4 * FARTHEST))

    def shadowed() -> bool:
        return bool(kernel.is_shadowed(floor(height), -1, point, up, to_light, light_is_near))

    assert ways(shadowed, decisions) == expected


@pytest.mark.parametrize("light_is_near", [True, False])
def test_without_a_farthest_distance_planes_throw_shadows_at_any(light_is_near: bool) -> None:
    decisions = Decisions()
    arithmetic = put_in_force(rounded_ball_arithmetic(53, decisions))
    offset = RayOffset(minimum_distance=LEAST, excludes_surface=False)
    model = ErrorModel("", 53, offset, shadow_tolerance=4 * LEAST)
    kernel = make_kernel(arithmetic, set(Feature), merged(HELPERS, offset_behaviour(model)))
    point, up, to_light = balls((0.0, 0.0, 0.0)), balls((0.0, 0.0, 1.0)), balls((0.0, 0.0, 1e12))

    def shadowed() -> bool:
        return bool(kernel.is_shadowed(floor(1e9), -1, point, up, to_light, light_is_near))

    assert ways(shadowed, decisions) == {True}
