from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

import mpmath
import numpy as np
import pytest
from flint import arb
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import (
    Decisions,
    TooManyOutcomesError,
    ball_arithmetic,
    every_outcome,
    rounded_ball_arithmetic,
    stored_number,
)
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import kept_precision, numpy_kernel, put_in_force

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("ARI-3")]
# The precision is the same in all examples, so that it does not matter that the fixture runs once for all of them.
with_fixture = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def functions(bits: int, decisions: Decisions | None = None) -> Any:
    return put_in_force(ball_arithmetic(bits, decisions or Decisions())).functions


def between(low: float, high: float) -> Any:
    """The ball with these ends."""
    return arb((arb(low) + arb(high)) / 2, (arb(high) - arb(low)) / 2)


@pytest.mark.parametrize("undecided", [0, 1, 2, 4])
def test_each_combination_of_undecided_comparisons_comes_exactly_once(undecided: int) -> None:
    decisions = Decisions()
    is_less = functions(53, decisions)["is_less"]
    straddling = between(-1.0, 1.0)

    def run() -> tuple[bool, ...]:
        return tuple(is_less(straddling, arb(0)) for _ in range(undecided))

    outcomes = list(every_outcome(run, decisions, 2**undecided))
    assert sorted(outcomes) == sorted(product((False, True), repeat=undecided))


def test_later_comparisons_may_depend_on_earlier_answers() -> None:
    decisions = Decisions()
    is_less = functions(53, decisions)["is_less"]
    straddling = between(-1.0, 1.0)

    def run() -> str:
        if is_less(straddling, arb(0)):
            return "a"
        if is_less(straddling, arb(0)):
            return "b"
        return "c" if is_less(straddling, arb(0)) else "d"

    assert sorted(every_outcome(run, decisions, 4)) == ["a", "b", "c", "d"]


def test_more_outcomes_than_the_limit_are_an_error() -> None:
    decisions = Decisions()
    is_less = functions(53, decisions)["is_less"]
    outcomes = every_outcome(lambda: [is_less(between(-1, 1), arb(0)) for _ in range(3)], decisions, 7)
    with pytest.raises(TooManyOutcomesError):
        list(outcomes)


@pytest.mark.parametrize("limit", [1, 3, 4, 8, 20])
def test_who_needs_all_outcomes_or_none_gets_the_same_ones_and_hears_early_of_too_many(limit: int) -> None:
    decisions, runs = Decisions(), []
    is_less = functions(53, decisions)["is_less"]

    def run() -> tuple[bool, ...]:
        runs.append(1)
        return tuple(is_less(between(-1, 1), arb(0)) for _ in range(3))

    if limit >= 8:
        found = list(every_outcome(run, decisions, limit, all_or_none=True))
        assert found == list(every_outcome(run, decisions, limit))
        return
    with pytest.raises(TooManyOutcomesError):
        list(every_outcome(run, decisions, limit, all_or_none=True))
    assert len(runs) == {1: 1, 3: 1, 4: 3}[limit]  # the first run leaves three others to take


def test_comparisons_are_counted_whether_they_are_decided_or_not() -> None:
    decisions = Decisions()
    compare = [functions(53, decisions)[name] for name in COMPARISONS]
    for function in compare:
        function(arb(1), arb(2))
        function(between(-1, 1), arb(0))
    assert decisions.comparisons == 2 * len(compare)


COMPARISONS = {
    "is_less": lambda a, b: a < b,
    "is_less_or_equal": lambda a, b: a <= b,
    "is_greater": lambda a, b: a > b,
    "is_greater_or_equal": lambda a, b: a >= b,
    "is_equal": lambda a, b: a == b,
    "is_different": lambda a, b: a != b,
}


@pytest.mark.parametrize("name", COMPARISONS)
@pytest.mark.parametrize("other", [(-2, -1), (-2, 0), (0, 0), (-1, 1), (0.5, 0.5), (1, 1), (1, 2), (2, 3)])
def test_a_comparison_forks_if_points_of_the_balls_disagree(name: str, other: tuple[int, int]) -> None:
    decisions = Decisions()
    decide = functions(53, decisions)[name]
    ends = (0, 1)
    outcomes = set(every_outcome(lambda: decide(between(*ends), between(*other)), decisions, 2))
    # The ends and the middles show every order that points of two intervals can have.
    points = [(a, b) for a in (0, 0.5, 1) for b in (other[0], sum(other) / 2, other[1])]
    points += [(x, x) for x in (0, 0.5, 1) if other[0] <= x <= other[1]]
    expected = {COMPARISONS[name](a, b) for a, b in points}
    assert outcomes >= expected
    if not {0, 1} & set(other):  # where balls touch, their radii, which are rounded up, make them overlap
        assert outcomes == expected


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (2.25, 2.75, {2}),
        (2.0, 2.0, {2}),
        (2.75, 3.25, {2, 3}),
        (2.75, 3.0, {2, 3}),
        (-0.25, 0.25, {-1, 0}),
        (0.5, 2.5, {0, 1}),  # an even and an odd one: all that is ever asked
        (3.0 - 2.0**-50, 3.0 - 2.0**-51, {2}),
    ],
)
def test_the_whole_numbers_below_a_ball_are_those_below_its_points(low: float, high: float, expected: set[int]) -> None:
    decisions = Decisions()
    floor = functions(128, decisions)["floor"]
    assert set(every_outcome(lambda: floor(between(low, high)), decisions, 8)) == expected


def test_a_floor_is_right_where_a_float_would_round_up() -> None:
    floor = functions(128)["floor"]
    assert floor(arb(3) - arb(2) ** -80) == 2
    decisions = Decisions()
    floor = functions(128, decisions)["floor"]
    around = arb(3, arb(2) ** -80)
    assert set(every_outcome(lambda: floor(around), decisions, 4)) == {2, 3}


POSITIVE = st.floats(1e-6, 1e6)
PRECISIONS = st.sampled_from([24, 53, 128])


def holds(ball: Any, value: Any) -> bool:
    """Whether a ball contains mpmath's value, which is given with enough digits."""
    with mpmath.workprec(400):
        low, high = (mpmath.mpf(end.mid().str(130, radius=False)) for end in (ball.lower(), ball.upper()))
        slack = mpmath.mpf(10) ** -120 * max(1, abs(value))  # the decimals' own
        return bool(low - slack <= value <= high + slack)


@with_fixture
@given(POSITIVE, POSITIVE, st.floats(0.5, 200), PRECISIONS, st.sampled_from([0.0, 2.0**-30, 0.25]))
def test_functions_of_balls_hold_mpmaths_values_at_their_points(
    x: float, y: float, exponent: float, bits: int, spread: float
) -> None:
    table = functions(bits)
    a, b = arb(x, spread * x), arb(y, spread * y)
    for p in (x * (1 - spread), x, x * (1 + spread)):
        if not a.contains(arb(p)):
            continue  # rounded out of the ball
        with mpmath.workprec(400):
            point, other, power = mpmath.mpf(p), mpmath.mpf(y), mpmath.mpf(exponent)
            assert holds(table["sqrt"](a), mpmath.sqrt(point))
            assert holds(table["exp"](-a / 1000), mpmath.exp(-point / 1000))
            assert holds(table["max"](a, b), max(point, other))
            assert holds(table["min"](a, b), min(point, other))
            assert holds(table["power"](a / 2**20, arb(exponent)), (point / 2**20) ** power)
            assert holds(table["pi"], mpmath.pi)
    with mpmath.workprec(400):
        assert holds(table["tan"](arb(1) * x / 2**20), mpmath.tan(mpmath.mpf(x) / 2**20))


@with_fixture
@given(st.floats(0, 4), st.floats(1e-3, 4), st.sampled_from([1.0, 2.5, 17.0]), PRECISIONS, st.floats(0, 1))
def test_roots_and_powers_of_straddling_balls_hold_those_of_their_positive_part(
    below: float, above: float, exponent: float, bits: int, part: float
) -> None:
    table = functions(bits)
    ball = between(-below, above)
    with mpmath.workprec(400):
        point = mpmath.mpf(above) * part
        assert holds(table["sqrt"](ball), mpmath.sqrt(point))
        assert holds(table["power"](ball, arb(exponent)), point**exponent)
        assert holds(table["max"](ball, arb(0)), point)
    assert table["power"](between(-2, -1), arb(exponent)) == 0


def test_a_power_of_the_unknown_is_unknown() -> None:
    unknown = arb(1) / between(-1.0, 1.0)
    assert not functions(53)["power"](unknown, arb(5)).is_finite()
    assert not functions(53)["sqrt"](unknown).is_finite()


@pytest.mark.clause("ARI-4")
@with_fixture
@given(st.floats(-1e6, 1e6, width=32), st.floats(-1e6, 1e6), st.integers(11, 60))
def test_a_stored_number_is_exact_if_it_fits_and_else_holds_both_itself_and_what_is_stored(
    single: float, double: float, bits: int
) -> None:
    with mpmath.workprec(bits):
        as_stored = [float(+mpmath.mpf(value)) for value in (single, double)]
    for value, stored in zip((single, double), as_stored, strict=True):
        ball = stored_number(value, bits)
        assert ball.contains(arb(value))
        assert ball.contains(arb(stored))
        assert (ball == arb(value)) == (value == stored)
    assert ball_arithmetic(bits, Decisions()).number(double) == arb(double)
    assert stored_number(float("inf"), bits) == arb(float("inf"))


COORDINATES = st.floats(-1e3, 1e3, width=32).filter(lambda x: x == 0 or abs(x) > 1e-6)
VECTORS = st.tuples(COORDINATES, COORDINATES, COORDINATES)


@pytest.fixture
def rounded(keep_precision: None) -> Any:  # noqa: ARG001 - it sets the precision, which is to be put back
    return make_kernel(put_in_force(rounded_ball_arithmetic(24, Decisions())), set(Feature))


@pytest.mark.clause("ARI-4")
@with_fixture
@given(a=VECTORS, b=VECTORS, c=VECTORS)
def test_rounded_balls_hold_what_float32_makes_of_the_tracers_own_functions(
    rounded: Any, a: tuple[float, ...], b: tuple[float, ...], c: tuple[float, ...]
) -> None:
    """Balls that merely have 24 bits fail this for one product of three numbers in ten."""
    single = numpy_kernel(np.float32)
    singles = [tuple(map(np.float32, vector)) for vector in (a, b, c)]
    balls = [tuple(map(arb, vector)) for vector in (a, b, c)]
    with np.errstate(all="ignore"):
        pairs = [
            (rounded.dot(*balls[:2]), single.dot(*singles[:2])),
            *zip(rounded.cross(*balls[:2]), single.cross(*singles[:2]), strict=True),
            *zip(rounded.multiply(*balls[:2]), single.multiply(*singles[:2]), strict=True),
            *zip(rounded.mirror_direction(*balls[:2]), single.mirror_direction(*singles[:2]), strict=True),
            (rounded.dot(rounded.cross(*balls[:2]), balls[2]), single.dot(single.cross(*singles[:2]), singles[2])),
        ]
        if any(a):
            pairs.extend(zip(rounded.normalize(balls[0]), single.normalize(singles[0]), strict=True))
    for ball, value in pairs:
        assert isinstance(value, np.float32)
        assert ball.contains(arb(float(value))), [part.hex() for vector in (a, b, c) for part in vector]


@pytest.mark.clause("ARI-4")
@pytest.mark.parametrize("bits", [11, 24, 53])
def test_each_operation_widens_a_rounded_ball_by_one_roundoff(bits: int) -> None:
    kernel = make_kernel(put_in_force(rounded_ball_arithmetic(bits, Decisions())), set(Feature))
    once = kernel.scale((arb(3), arb(5), arb(7)), arb(11))
    for ball, exact in zip(once, (33, 55, 77), strict=True):
        assert ball.contains(arb(exact))
        assert abs(float(ball.rad()) - exact * 2.0**-bits) < exact * 2.0 ** (-bits - 20)
    assert kernel.NOTHING == -1
    functions = rounded_ball_arithmetic(bits, Decisions()).functions
    for name, argument in (("sqrt", 9), ("exp", 0), ("tan", 1)):
        ball = functions[name](arb(argument))
        assert float(ball.rad()) >= float(abs(ball.mid())) * 2.0**-bits * (1 - 2.0**-20)
    assert functions["rounded"](7) == 7
    assert isinstance(functions["rounded"](7), int)


@pytest.mark.parametrize("x", [arb(2) ** 200 + arb(1) / 3, arb(0, 1e300), arb("nan"), arb(2) ** 80 / 3])
def test_a_floor_beyond_the_precision_is_either_even_or_odd(x: Any) -> None:
    decisions = Decisions()
    floor = functions(53, decisions)["floor"]
    assert {outcome % 2 for outcome in every_outcome(lambda: floor(x), decisions, 2)} == {0, 1}
