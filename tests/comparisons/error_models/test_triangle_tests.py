"""Embree's formulas in exact arithmetic against the truth's own, and in float32 against their enclosures."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS, edge_slack
from raytruth.comparisons.error_models.triangle_tests import (
    moeller_trumbore_distance,
    pluecker_distance,
    triangle_test_behaviour,
)
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import merged
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import kept_precision, put_in_force

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

TESTS = {"moeller-trumbore": moeller_trumbore_distance, "pluecker": pluecker_distance}
pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def random_cases(count: int) -> list[tuple[Any, ...]]:
    """Rays toward random points of random triangles' planes, of all octants and scales, half of them beside it."""

    numbers = random.Random(5)
    cases = []
    for _ in range(count):
        scale = 2.0 ** numbers.randint(-8, 8)
        a, b, c, origin = (tuple(scale * numbers.uniform(-1, 1) for _ in range(3)) for _ in range(4))
        u, v = numbers.uniform(-0.5, 1.0), numbers.uniform(-0.5, 1.0)
        target = [a[i] + u * (b[i] - a[i]) + v * (c[i] - a[i]) for i in range(3)]
        side = numbers.choice((-1, 1, 1))
        cases.append((origin, tuple(side * (target[i] - origin[i]) for i in range(3)), a, b, c))
    return cases


def exactly(case: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(tuple(Fraction(number) for number in vector) for vector in case)


@pytest.mark.parametrize("test", TESTS.values(), ids=TESTS)
def test_a_formula_hits_what_the_truth_hits_at_the_same_distance(test: Callable[..., Any]) -> None:
    hits = misses = 0
    for case in random_cases(400):
        truth, found = triangle_distance(*exactly(case)), test(*exactly(case))
        if math.isinf(truth):
            misses += 1
            assert math.isinf(found), [[number.hex() for number in vector] for vector in case]
        else:
            hits += 1
            # 1.0 * a fraction is a float, of 53 bits; a flat triangle loses what its flatness costs.
            assert float(found) == pytest.approx(float(truth), rel=1e-9)
    assert hits > 50
    assert misses > 50


def test_the_robust_formula_hits_a_little_outside_and_the_other_does_not() -> None:
    triangle = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    for outside, hit in ((edge_slack / 2, True), (edge_slack * 4, False)):
        ray = ((0.25, -outside, 1.0), (0.0, 0.0, -1.0))
        assert math.isfinite(pluecker_distance(*exactly((*ray, *triangle)))) == hit
        assert math.isinf(moeller_trumbore_distance(*exactly((*ray, *triangle))))


@pytest.mark.parametrize("name", TESTS)
def test_a_ray_in_the_plane_and_a_triangle_behind_are_missed(name: str) -> None:
    triangle = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    for ray in (((-1.0, 0.25, 0.0), (1.0, 0.0, 0.0)), ((0.25, 0.25, 1.0), (0.0, 0.0, 1.0))):
        assert math.isinf(TESTS[name](*ray, *triangle))


@pytest.mark.parametrize("name", TESTS)
def test_the_enclosure_holds_the_exact_distance(name: str) -> None:
    decisions = Decisions()
    model = ErrorModel("", 24, triangle_test=name)  # type: ignore[arg-type]  # one of the two names
    arithmetic = put_in_force(rounded_ball_arithmetic(24, decisions))
    kernel = make_kernel(arithmetic, set(Feature), merged(HELPERS, triangle_test_behaviour(model)))
    compared = 0
    for case in random_cases(400):
        truth = float(triangle_distance(*exactly(case)))
        balls = [tuple(arb(number) for number in vector) for vector in case]
        found = list(every_outcome(lambda balls=balls: kernel.triangle_distance(*balls), decisions, 64))
        if math.isinf(truth):
            continue
        near = [ball for ball in found if ball.is_finite()]
        assert any(abs(ball - truth) < 1e-9 * abs(truth) or ball.contains(arb(truth)) for ball in near)
        compared += 1
    assert compared > 30


def test_only_a_formula_other_than_the_truths_is_overridden() -> None:
    assert triangle_test_behaviour(ErrorModel("", 24)).names == ()
    for name, test in TESTS.items():
        model = ErrorModel("", 24, triangle_test=name)  # type: ignore[arg-type]  # one of the two names
        assert triangle_test_behaviour(model).functions == {"triangle_distance": test}
        assert model.in_words()["triangles"] == f"{name} test"
