"""Formulas for dielectrics: the truth's in exact arithmetic, and float32's in their enclosures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.dielectric_formulas import dielectric_behaviour
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome, rounded_ball_arithmetic
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import kept_precision, put_in_force

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

F = np.float32
# Each with the formula of Fresnel's that goes with it in people's programs.
FORMULAS = {"heckbert": "cosines", "bec": "cosines", "as specified": "as specified"}
REFRACTIONS = tuple(FORMULAS)


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def kernel_of(bits: int, **formulas: Any) -> tuple[Any, Decisions]:
    decisions = Decisions()
    arithmetic = put_in_force(rounded_ball_arithmetic(bits, decisions))
    return make_kernel(arithmetic, set(Feature), dielectric_behaviour(ErrorModel("", bits, **formulas))), decisions


def dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(vector: Any) -> Any:
    return vector * (F(1) / np.sqrt(dot(vector, vector)))


def cases(count: int) -> Iterator[tuple[Any, Any, Any, Any]]:
    """Directions and normals of float32 that face each other, and both indices: many near grazing or nearly equal."""
    random = np.random.default_rng(6)
    for number in range(count):
        normal = unit(random.normal(size=3).astype(F))
        across = np.cross(normal, random.normal(size=3))
        cosine = random.uniform() if number % 2 else 10.0 ** random.uniform(-6, 0)
        slanted = across / np.linalg.norm(across) * np.sqrt(1 - cosine**2) - cosine * normal
        direction = unit(slanted.astype(F))
        if dot(direction, normal) >= 0:
            continue
        other = 1.0 + 10.0 ** random.uniform(-6, 0)
        first, second = (F(1), F(other)) if number % 3 else (F(other), F(1))
        yield direction, normal, first, second


def program(direction: Any, normal: Any, first: Any, second: Any, refraction: str) -> tuple[Any, Any]:
    """Fresnel's reflectance and the refracted direction as many have them; None for total reflection."""
    if refraction == "as specified":
        return as_specified(direction, normal, second / first)
    eta = first / second
    cosine = -dot(direction, normal)
    scaled = eta * cosine
    if refraction == "heckbert":
        discriminant = F(1) - eta * eta * (F(1) - cosine * cosine)
    else:
        discriminant = F(1) + (scaled - eta) * (scaled + eta)
    if discriminant < 0:
        return None, None
    root = np.sqrt(discriminant)
    sine = eta * np.sqrt(max(F(0), F(1) - cosine * cosine))
    beyond = np.sqrt(max(F(0), F(1) - sine * sine))
    across = (first * cosine - second * beyond) / (first * cosine + second * beyond)
    within = (second * cosine - first * beyond) / (second * cosine + first * beyond)
    return F(0.5) * (across * across + within * within), eta * direction + (scaled - root) * normal


def as_specified(direction: Any, normal: Any, eta: Any) -> tuple[Any, Any]:
    """The same by REFR-2, REFR-3 and REFR-4 as they are written."""
    c = -dot(direction, normal)
    squared = eta * eta - F(1) + c * c
    if squared < 0:
        return None, None
    g = np.sqrt(squared)
    across, within = (c - g) / (c + g), (eta * eta * c - g) / (eta * eta * c + g)
    return F(0.5) * (across * across + within * within), (direction + (c - g) * normal) / eta


@pytest.mark.parametrize("refraction", REFRACTIONS)
def test_the_enclosures_hold_what_a_program_computes_in_float32(refraction: str) -> None:
    kernel, decisions = kernel_of(24, fresnel=FORMULAS[refraction], refraction=refraction)

    def split(direction: Any, normal: Any, first: Any, second: Any) -> tuple[Any, Any]:
        ratio = kernel.index_ratio_of(first, second)
        cosine = -kernel.dot(direction, normal)
        discriminant = kernel.snell_discriminant(cosine, ratio)
        if kernel.is_less(discriminant, arb(0)):
            return None, None
        g = kernel.sqrt(discriminant)
        refracted = kernel.refracted_direction(direction, normal, cosine, g, ratio)
        return kernel.fresnel_reflectance(cosine, g, ratio), refracted

    kernel.index_ratio_of = lambda first, second: second / first * arb(1, 2.0**-24)
    total = refracted = 0
    for case in cases(2000):
        reflectance, onward = program(*case, refraction)
        balls = [tuple(map(arb, vector.astype(float).tolist())) for vector in case[:2]]
        indices = [arb(float(index)) for index in case[2:]]
        found = list(every_outcome(lambda b=balls, i=indices: split(*b, *i), decisions, 32))
        if onward is None:
            total += 1
            assert any(ball is None for ball, _ in found)
            continue
        refracted += 1
        assert any(
            ball is not None
            and ball.contains(arb(float(reflectance)))
            and all(part.contains(arb(float(value))) for part, value in zip(parts, onward, strict=True))
            for ball, parts in found
        ), case
    assert total > 200
    assert refracted > 1000


@pytest.mark.parametrize("refraction", REFRACTIONS)
def test_a_formula_is_the_truths_in_exact_arithmetic(refraction: str) -> None:
    kernel, _ = kernel_of(200, fresnel=FORMULAS[refraction], refraction=refraction)
    truth, _ = kernel_of(200)
    for cosine in (0.01, 0.3, 0.7, 1.0):
        for ratio in (0.6, 1.0001, 1.5):
            discriminants = [kernel.snell_discriminant(arb(cosine), arb(ratio)) for kernel in (kernel, truth)]
            assert abs(discriminants[0] - discriminants[1]) < 1e-30
            if discriminants[0] < 0:
                continue
            g = discriminants[1].sqrt()
            direction, normal = (arb(1 - cosine**2).sqrt(), arb(0), -arb(cosine)), (arb(0), arb(0), arb(1))
            mine, theirs = (
                [
                    k.fresnel_reflectance(arb(cosine), g, arb(ratio)),
                    *k.refracted_direction(direction, normal, arb(cosine), g, arb(ratio)),
                ]
                for k in (kernel, truth)
            )
            for a, b in zip(mine, theirs, strict=True):
                assert abs(a - b) < 1e-25


def test_only_what_is_declared_is_overridden() -> None:
    assert dielectric_behaviour(ErrorModel("", 24)).names == ()
    specified = dielectric_behaviour(ErrorModel("", 24, refraction="as specified")).functions
    assert set(specified) == {"snell_discriminant"}
    for fresnel in ("cosines", "as specified"):
        functions = dielectric_behaviour(ErrorModel("", 24, fresnel=fresnel)).functions  # type: ignore[arg-type]  # one of both
        assert set(functions) == {"fresnel_reflectance"}
    for refraction in ("heckbert", "bec"):
        functions = dielectric_behaviour(ErrorModel("", 24, refraction=refraction)).functions  # type: ignore[arg-type]  # one of both
        assert set(functions) == {"snell_discriminant", "refracted_direction"}
