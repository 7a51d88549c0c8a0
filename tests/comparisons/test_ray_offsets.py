from __future__ import annotations

from typing import TYPE_CHECKING, Any

import mpmath
import pytest
from flint import arb
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from comparisons.error_model import ErrorModel
from comparisons.ray_offsets import offset_overrides
from reference_tracer.balls import Decisions, ball_arithmetic, every_outcome
from tests.reference_tracer.kernels import kept_precision

if TYPE_CHECKING:
    from collections.abc import Iterator

OFFSET = 2.0**-13
SHORTENING = 2.0**-10
# Of the angle between ray and normal: what grazes is another test's.
SMALLEST_COSINE = 0.01
# The precision is the same in all examples, so that it does not matter that the fixture runs once for all of them.
with_fixture = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=50)
pytestmark = pytest.mark.usefixtures("keep_precision")


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def overrides(bits: int = 53, offset: float = OFFSET, shortening: float = SHORTENING) -> tuple[Any, Decisions]:
    decisions = Decisions()
    functions = offset_overrides(ErrorModel("", bits, offset, shortening), decisions)
    ball_arithmetic(bits, decisions, functions)
    return functions, decisions


def balls(vector: Any) -> Any:
    return tuple(arb(float(part)) for part in vector)


def holds(ball: Any, value: Any) -> bool:
    with mpmath.workprec(300):
        low, high = (mpmath.mpf(end.mid().str(90, radius=False)) for end in (ball.lower(), ball.upper()))
        slack = mpmath.mpf(10) ** -80 * (1 + abs(value))  # the decimals' own
        return bool(low - slack <= value <= high + slack)


def test_a_renderer_without_offsets_changes_nothing() -> None:
    assert overrides(offset=0.0, shortening=0.0)[0] == {}
    assert set(overrides(offset=0.0)[0]) == {"shadow_ray_end"}
    assert set(overrides(shortening=0.0)[0]) == {"departure", "distance_to_other_side"}


def test_shadow_rays_end_before_the_light() -> None:
    assert overrides()[0]["shadow_ray_end"]() == arb(1 - SHORTENING)


@pytest.mark.parametrize(
    ("point", "largest"), [((0.0, 0.0, 0.0), 0), ((1.0, -7.0, 3.0), 7), ((-2.5, 0.5, 1.0), 2.5), ((0.5, 1.0, 4.0), 4)]
)
def test_a_departing_ray_starts_off_the_surface_by_the_offset_times_one_more_than_the_largest_coordinate(
    point: tuple[float, float, float], largest: float
) -> None:
    functions, _ = overrides()
    normal = (0.0, -0.75, 0.5)  # any vector: it is not made a unit vector here
    start, left = functions["departure"](5, balls(point), balls(normal))
    assert left == 5
    for coordinate, p, n in zip(start, point, normal, strict=True):
        assert coordinate == p + n * OFFSET * (1 + largest)  # dyadic numbers of few bits: nothing is rounded


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
    functions, decisions = overrides(bits)
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
        every_outcome(lambda: functions["distance_to_other_side"](start, balls(direction), balls(center)), decisions, 2)
    )
    assert len(outcomes) == 1
    assert holds(outcomes[0], expected)
    # As tight as its inputs: the direction's and the origin's roundings grow with the inverse of the cosine; some ten
    # operations follow; and the offset itself is known up to ε times, and moves the root by up to 1/cosine times.
    coordinates = (max(map(abs, center)) + radius) / radius
    rounding = 2.0**-bits * 16 * float(expected) * (1 + coordinates) / SMALLEST_COSINE
    assert float(outcomes[0].rad()) <= rounding + 2 * float(offset / speed) * OFFSET / SMALLEST_COSINE


def test_a_ray_that_leaves_outward_does_not_meet_its_sphere_again() -> None:
    functions, _ = overrides(24)
    center = balls((0, 0, 0))
    for direction in ((0, 0, 1), (1, 0, 1), (1, 0, 0)):  # a tangent leaves, too
        distance = functions["distance_to_other_side"](balls((0, 0, 1 + OFFSET)), balls(direction), center)
        assert not distance.is_finite()
        assert distance > 0


def test_a_ray_that_may_graze_its_sphere_does_both() -> None:
    functions, decisions = overrides(24)
    grazing = (arb(1), arb(0), arb(0, 2.0**-20))
    outcomes = list(
        every_outcome(
            lambda: functions["distance_to_other_side"](balls((0, 0, 1 - OFFSET)), grazing, balls((0, 0, 0))),
            decisions,
            2,
        )
    )
    assert sorted(ball.is_finite() for ball in outcomes) == [False, True]
