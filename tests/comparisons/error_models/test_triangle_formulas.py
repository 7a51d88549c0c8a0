"""People's formulas for triangles: the truth's in exact arithmetic, and float32's in their enclosures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.triangle_formulas import (
    cramer_root,
    moeller_trumbore_root,
    plain_root,
    plane_and_inside_root,
)
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.scenes.features import Feature
from tests.comparisons.deciding_scenes import far_sphere
from tests.comparisons.error_models.test_triangle_tests import exactly, random_cases
from tests.reference_tracer.kernels import kept_precision, put_in_force

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

FORMULAS = {
    "watertight": plain_root,
    "moeller-trumbore of 1997": moeller_trumbore_root,
    "cramer": cramer_root,
    "plane and inside": plane_and_inside_root,
}

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


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def kernel_of(name: Any, bits: int) -> tuple[Any, Decisions]:
    decisions = Decisions()
    # "unnormalised" has policies apply to the formulas that ray_offsets.py knows, too.
    model = ErrorModel("", bits, triangle_test=name, directions="unnormalised")
    arithmetic = put_in_force(rounded_ball_arithmetic(bits, decisions))
    return make_kernel(arithmetic, set(Feature), behaviour_of(model, far_sphere())), decisions


@pytest.mark.parametrize(("name", "program"), PROGRAMS, ids=[program.__name__ for _, program in PROGRAMS])
def test_the_enclosures_hold_what_a_program_computes_in_float32(name: str, program: Callable[..., Any]) -> None:
    kernel, decisions = kernel_of(name, 24)
    hits = undecided = unknown = 0
    for case in float32_cases(2000):
        distance = float(program(*case))
        balls = [tuple(map(arb, vector.astype(float).tolist())) for vector in case]
        found = list(every_outcome(lambda balls=balls: kernel.triangle_root(*balls), decisions, 256))
        if math.isfinite(distance):
            assert any(ball.is_nan() or ball.contains(arb(distance)) for ball in found)
        else:
            assert any(not ball.is_finite() or not ball > 0 for ball in found)
        hits, undecided = hits + math.isfinite(distance), undecided + (len(found) > 1)
        unknown += any(ball.is_nan() for ball in found)
    assert hits > 400
    assert undecided > 400
    assert unknown < 10  # of a triangle seen edge on nothing is known


def test_with_an_epsilon_the_enclosures_hold_what_a_program_with_that_one_computes() -> None:
    epsilon = 1e-6
    model = ErrorModel("", 24, triangle_test="moeller-trumbore of 1997", least_determinant=epsilon)
    decisions = Decisions()
    arithmetic = put_in_force(rounded_ball_arithmetic(24, decisions))
    kernel = make_kernel(arithmetic, set(Feature), behaviour_of(model, far_sphere()))
    missed = hits = 0
    for origin, direction, a, b, c in float32_cases(1000):
        balls = [tuple(map(arb, vector.astype(float).tolist())) for vector in (origin, direction, a, b, c)]
        found = list(every_outcome(lambda balls=balls: kernel.triangle_root(*balls), decisions, 256))
        distance = float(moeller_trumbore_program(origin, direction, a, b, c))
        if abs(dot(b - a, cross(direction, c - a))) < F(epsilon):
            missed += math.isfinite(distance)
            assert any(not ball.is_finite() for ball in found)
        elif math.isfinite(distance):
            hits += 1
            assert any(ball.is_nan() or ball.contains(arb(distance)) for ball in found)
    assert missed > 20  # which a program without it hits
    assert hits > 100


@pytest.mark.parametrize("name", FORMULAS)
def test_a_formula_hits_what_the_truth_hits_at_the_same_distance(name: str) -> None:
    hits = misses = 0
    for case in random_cases(400):
        truth, found = triangle_distance(*exactly(case)), FORMULAS[name](*exactly(case))
        found = found if found > 0 else math.inf
        if math.isinf(truth):
            misses += 1
            assert math.isinf(found), [[number.hex() for number in vector] for vector in case]
        else:
            hits += 1
            # 1.0 times a fraction is a float, of 53 bits; a flat triangle loses what its flatness costs.
            assert float(found) == pytest.approx(float(truth), rel=1e-9)
    assert hits > 50
    assert misses > 50


@pytest.mark.parametrize("name", FORMULAS)
def test_a_ray_in_the_plane_misses(name: str) -> None:
    triangle = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    assert math.isinf(FORMULAS[name]((-1.0, 0.25, 0.0), (1.0, 0.0, 0.0), *triangle))


@pytest.mark.parametrize("name", ["pluecker", "moeller-trumbore"])
def test_with_embrees_formulas_the_root_is_what_they_give(name: str) -> None:
    kernel, _ = kernel_of(name, 53)
    balls = [tuple(map(arb, vector)) for vector in ((0.25, 0.25, 1.0), (0.0, 0.0, -1.0))]
    corners = [tuple(map(arb, corner)) for corner in ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))]
    assert kernel.triangle_root(*balls, *corners).contains(arb(1))
    assert not kernel.triangle_root(balls[0], tuple(-part for part in balls[1]), *corners).is_finite()


def test_a_plane_seen_edge_on_from_above_is_met_nowhere_on_the_triangle() -> None:
    """Although the determinant's sign is unknown, and so the distance: it is large."""
    kernel, decisions = kernel_of("plane and inside", 24)
    level = arb(0, 2.0**-24)
    corners = [tuple(map(arb, corner)) for corner in ((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, -3.0))]
    for height, known in ((0.5, True), (2.0**-25, False)):
        ray = (arb(0), arb(height), arb(1)), (arb(0), level, arb(-1))
        found = list(every_outcome(lambda ray=ray: kernel.triangle_root(*ray, *corners), decisions, 64))
        assert (len(found) == 1 and found[0] == arb(math.inf)) == known
