"""Formulas in exact arithmetic against the truth's own, and in float32 against their enclosures."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS, edge_slack
from raytruth.comparisons.error_models.triangle_tests import (
    cramer_distance,
    moeller_trumbore_distance,
    moeller_trumbore_distance_of_1997,
    plane_and_inside_distance,
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

TESTS = {
    "moeller-trumbore": moeller_trumbore_distance,
    "pluecker": pluecker_distance,
    "moeller-trumbore of 1997": moeller_trumbore_distance_of_1997,
    "cramer": cramer_distance,
    "plane and inside": plane_and_inside_distance,
}
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


F = np.float32


def dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Any, b: Any) -> Any:
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def moeller_trumbore_program(origin: Any, direction: Any, a: Any, b: Any, c: Any) -> Any:
    """As in the paper, without its threshold."""
    first_edge, second_edge = b - a, c - a
    p = cross(direction, second_edge)
    determinant = dot(first_edge, p)
    if determinant == 0:
        return math.inf
    inverse = F(1) / determinant
    to_origin = origin - a
    u = dot(to_origin, p) * inverse
    if u < 0 or u > 1:
        return math.inf
    q = cross(to_origin, first_edge)
    v = dot(direction, q) * inverse
    if v < 0 or u + v > 1:
        return math.inf
    t = dot(second_edge, q) * inverse
    return t if t > 0 else math.inf


def determinant_of(x: Any, y: Any, z: Any) -> Any:
    """Of three columns, by the first of them."""
    return x[0] * (y[1] * z[2] - z[1] * y[2]) + x[1] * (y[2] * z[0] - z[2] * y[0]) + x[2] * (y[0] * z[1] - z[0] * y[1])


def cramer_program(origin: Any, direction: Any, a: Any, b: Any, c: Any) -> Any:
    whole = determinant_of(a - b, a - c, direction)
    if whole == 0:
        return math.inf
    beta = determinant_of(a - origin, a - c, direction) / whole
    gamma = determinant_of(a - b, a - origin, direction) / whole
    t = determinant_of(a - b, a - c, a - origin) / whole
    return t if beta >= 0 and gamma >= 0 and beta + gamma <= 1 and t > 0 else math.inf


def plane_program(origin: Any, direction: Any, a: Any, b: Any, c: Any) -> Any:
    """As Scratchapixel's lesson has it, but for its threshold."""
    normal = cross(b - a, c - a)
    against = dot(normal, direction)
    if against == 0:
        return math.inf
    t = -(dot(normal, origin) - dot(normal, a)) / against
    if t <= 0:
        return math.inf
    point = origin + t * direction
    for start, end in ((a, b), (b, c), (c, a)):
        if dot(normal, cross(end - start, point - start)) < 0:
            return math.inf
    return t


def plane_program_by_difference(origin: Any, direction: Any, a: Any, b: Any, c: Any) -> Any:
    """The same, with the way to the corner in one."""
    normal = cross(b - a, c - a)
    t = dot(normal, a - origin) / dot(normal, direction)
    point = origin + t * direction
    inside = all(dot(normal, cross(end - start, point - start)) >= 0 for start, end in ((a, b), (b, c), (c, a)))
    return t if inside and t > 0 else math.inf


PROGRAMS: list[tuple[str, Callable[..., Any]]] = [
    ("moeller-trumbore of 1997", moeller_trumbore_program),
    ("cramer", cramer_program),
    ("plane and inside", plane_program),
    ("plane and inside", plane_program_by_difference),
]


def float32_cases(count: int) -> Iterator[tuple[Any, ...]]:
    """Unit directions toward points of triangles of all sizes, most of these points on or near an edge or a corner."""
    random = np.random.default_rng(11)
    for number in range(count):
        size, away = 10.0 ** random.uniform(-4, 4), 10.0 ** random.uniform(-2, 2)
        a, b, c = ((random.normal(size=3) * size).astype(F) for _ in range(3))
        u, v = ((random.uniform(), 0.0), (0.0, 1.0), tuple(random.uniform(-0.2, 1.0, 2)), (0.4, 0.6))[number % 4]
        beside = 10.0 ** random.uniform(-9, -5)
        target = a + (u + random.normal() * beside) * (b - a) + (v + random.normal() * beside) * (c - a)
        origin = (target + random.normal(size=3) * size * away).astype(F)
        direction = (target - origin).astype(F)
        yield origin, direction * (F(1) / np.sqrt(dot(direction, direction))), a, b, c


@pytest.mark.parametrize(("name", "program"), PROGRAMS, ids=[program.__name__ for _, program in PROGRAMS])
def test_the_enclosures_hold_what_a_program_computes_in_float32(name: str, program: Callable[..., Any]) -> None:
    decisions = Decisions()
    model = ErrorModel("", 24, triangle_test=name)  # type: ignore[arg-type]  # one of the names
    arithmetic = put_in_force(rounded_ball_arithmetic(24, decisions))
    kernel: Any = make_kernel(arithmetic, set(Feature), merged(HELPERS, triangle_test_behaviour(model)))
    hits = undecided = 0
    for case in float32_cases(2000):
        distance = float(program(*case))
        balls = [tuple(map(arb, vector.astype(float).tolist())) for vector in case]
        found = list(every_outcome(lambda balls=balls: kernel.triangle_distance(*balls), decisions, 256))
        wide = [ball for ball in found if ball.is_finite() or ball.is_nan()]
        if math.isfinite(distance):
            assert any(ball.is_nan() or ball.contains(arb(distance)) for ball in wide)
        else:
            assert len(wide) < len(found)
        hits, undecided = hits + math.isfinite(distance), undecided + (len(found) > 1)
    assert hits > 400
    assert undecided > 400
