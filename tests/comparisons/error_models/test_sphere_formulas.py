"""People's formulas for spheres: the truth's roots in exact arithmetic, and float32's in their enclosures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, get_args, get_type_hints

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.ray_offsets import offset_behaviour
from raytruth.comparisons.error_models.ray_policies import ray_policy_behaviour
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import merged
from raytruth.reference_tracer.source.sphere import sphere_distance
from raytruth.scenes.features import Feature
from tests.comparisons.deciding_scenes import far_sphere
from tests.reference_tracer.kernels import kept_precision, put_in_force

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

FORMULAS = ("quadratic", "stable quadratic", "geometric")
F = np.float32


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def behaviour_of(formula: Any, bits: int) -> Behaviour:
    # "unnormalised" has policies apply to the truth's own formula, too.
    model = ErrorModel("", bits, sphere_test=formula, directions="unnormalised")
    return merged(HELPERS, offset_behaviour(model), ray_policy_behaviour(model, far_sphere()))


def kernel_of(formula: Any, bits: int) -> tuple[Any, Decisions]:
    decisions = Decisions()
    arithmetic = put_in_force(rounded_ball_arithmetic(bits, decisions))
    return make_kernel(arithmetic, set(Feature), behaviour_of(formula, bits)), decisions


def unit(vector: Any) -> Any:
    """As a program of float32 does it."""
    return vector * (F(1) / np.sqrt(dot(vector, vector)))


def dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cases(count: int) -> Iterator[tuple[Any, Any, Any, Any]]:
    """Rays of float32 toward spheres from near, far, inside and their surface, many of them grazing."""
    random = np.random.default_rng(3)
    for number in range(count):
        radius = F(10.0 ** random.uniform(-3, 4))
        center = (random.normal(size=3) * radius * 10.0 ** random.uniform(-1, 1)).astype(F)
        side = random.normal(size=3)
        side /= np.linalg.norm(side)
        height = (0.0, 10.0 ** random.uniform(-6, 3), -(10.0 ** random.uniform(-3, 0)))[number % 3]
        origin = (center + side * radius * (1.0 + height)).astype(F)
        across = np.cross(random.normal(size=3), side)
        across /= np.linalg.norm(across)
        grazing = 1.0 + random.normal() * 10.0 ** random.uniform(-7, -1)
        target = center + radius * (across * grazing if number % 2 else random.normal(size=3))
        yield origin, unit((target - origin).astype(F)), center, radius


def quadratic(origin: Any, direction: Any, center: Any, radius: Any) -> Any:
    to_origin = origin - center
    a, b = dot(direction, direction), F(2) * dot(to_origin, direction)
    c = dot(to_origin, to_origin) - radius * radius
    discriminant = b * b - F(4) * a * c
    if discriminant < 0:
        return math.inf, math.inf
    root = np.sqrt(discriminant)
    return (-b - root) / (F(2) * a), (-b + root) / (F(2) * a)


def half_quadratic_of_units(origin: Any, direction: Any, center: Any, radius: Any) -> Any:
    """With half of b, and without a, which is nearly 1."""
    to_origin = origin - center
    b = dot(to_origin, direction)
    discriminant = b * b - (dot(to_origin, to_origin) - radius * radius)
    if discriminant < 0:
        return math.inf, math.inf
    root = np.sqrt(discriminant)
    return -b - root, -b + root


def stable_quadratic(origin: Any, direction: Any, center: Any, radius: Any) -> Any:
    """As in PBRT's first edition and Scratchapixel's lessons."""
    to_origin = origin - center
    a, b = dot(direction, direction), F(2) * dot(direction, to_origin)
    c = dot(to_origin, to_origin) - radius * radius
    discriminant = b * b - F(4) * a * c
    if discriminant < 0:
        return math.inf, math.inf
    root = np.sqrt(discriminant)
    q = F(-0.5) * (b + root) if b > 0 else F(-0.5) * (b - root)
    with np.errstate(all="ignore"):
        return tuple(sorted((q / a, c / q)))


def geometric(origin: Any, direction: Any, center: Any, radius: Any) -> Any:
    to_center = center - origin
    foot = dot(to_center, direction)
    distance_squared = dot(to_center, to_center) - foot * foot
    if distance_squared > radius * radius:
        return math.inf, math.inf
    half_chord = np.sqrt(radius * radius - distance_squared)
    return foot - half_chord, foot + half_chord


PROGRAMS: list[tuple[str, Callable[..., Any]]] = [
    ("quadratic", quadratic),
    ("quadratic", half_quadratic_of_units),
    ("stable quadratic", stable_quadratic),
    ("geometric", geometric),
]


def holds(ball: Any, value: float) -> bool:
    return bool(ball.contains(arb(value))) if math.isfinite(value) else not ball.is_finite()


@pytest.mark.parametrize(("formula", "program"), PROGRAMS, ids=[program.__name__ for _, program in PROGRAMS])
def test_the_enclosures_hold_what_a_program_computes_in_float32(formula: str, program: Callable[..., Any]) -> None:
    kernel, decisions = kernel_of(formula, 24)
    hits = misses = 0
    for ray in cases(3000):
        roots = [float(root) for root in program(*ray)]
        if any(map(math.isnan, roots)):
            continue  # 0/0 where a ray leaves along the surface
        balls = [tuple(map(arb, vector.astype(float).tolist())) for vector in ray[:3]]
        found = every_outcome(lambda b=balls, r=ray[3]: kernel.sphere_roots(*b, arb(float(r))), decisions, 32)
        assert any(all(map(holds, both, roots)) for both in found), [vector.tolist() for vector in ray]
        hits, misses = hits + math.isfinite(roots[0]), misses + math.isinf(roots[0])
    assert hits > 1000
    assert misses > 100


@pytest.mark.parametrize("formula", ["accurate", *FORMULAS])
def test_a_formula_gives_the_truths_roots_in_exact_arithmetic(formula: str) -> None:
    kernel, _ = kernel_of(formula, 200)
    compared = 0
    for origin, direction, center, radius in cases(600):
        balls = [tuple(map(arb, vector.astype(float).tolist())) for vector in (origin, direction, center)]
        c, d, r = (np.array(vector, float) for vector in (center - origin, direction, radius))
        gap = float(r) ** 2 - (c @ c - (c @ d) ** 2 / (d @ d))
        if abs(gap) < 1e-3 * float(r) ** 2:
            continue  # floats do not decide it
        nearer, farther = kernel.sphere_roots(*balls, arb(float(radius)))
        if gap < 0:
            assert not nearer.is_finite()
            continue
        half = math.sqrt(gap / (d @ d))
        foot = c @ d / (d @ d)
        for root, expected in ((nearer, foot - half), (farther, foot + half)):
            # A direction of float32 is no unit vector: a formula that takes it for one is off by its roundoffs.
            assert float(abs(root - expected).mid()) <= 2.0**-21 * (abs(foot) + half + float(r) ** 2 / half)
        compared += 1
    assert compared > 200


@pytest.mark.parametrize("formula", ["accurate", *FORMULAS])
def test_the_nearest_root_ahead_is_the_truths_in_float64(formula: str) -> None:
    behaviour = behaviour_of(formula, 53).with_numbers(lambda ball: float(ball.mid()))
    kernel: Any = make_kernel(FLOAT, set(Feature), behaviour)
    hits = 0
    for case in cases(600):
        ray = [tuple(vector.astype(float).tolist()) for vector in case[:3]]
        length = math.hypot(*ray[1])
        ray[1] = tuple(part / length for part in ray[1])
        expected = sphere_distance(*ray, float(case[3]))  # type: ignore[call-arg]
        ahead = [root for root in kernel.sphere_roots(*ray, float(case[3])) if root > 1e-6 * float(case[3])]
        if expected < 1e-6 * float(case[3]) or (math.isfinite(expected) != bool(ahead and math.isfinite(ahead[0]))):
            continue  # a start on the surface, or a tangent
        if math.isfinite(expected):
            assert ahead[0] == pytest.approx(expected, rel=1e-4)
            hits += 1
    assert hits > 200


@pytest.mark.parametrize("formula", FORMULAS)
def test_with_more_bits_a_formula_encloses_more_tightly(formula: str) -> None:
    """So that its enclosures do not hold everything: of a sphere seen from ten radii, to some roundoffs."""
    kernel, _ = kernel_of(formula, 24)
    ray = (arb(0), arb(0), arb(10)), (arb(0), arb(0.0625), arb(-1)), (arb(0), arb(0), arb(0))
    nearer, farther = kernel.sphere_roots(*ray, arb(1))
    assert float(nearer.rad()) < 2000 * 2.0**-24
    assert float(farther.rad()) < 2000 * 2.0**-24


def test_the_names_are_those_of_the_error_model() -> None:
    assert set(FORMULAS) < set(get_args(get_type_hints(ErrorModel)["sphere_test"]))
