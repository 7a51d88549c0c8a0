from __future__ import annotations

import math
import re
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, FLOAT32, FLOAT64, Arithmetic, make_kernel, over_zero
from raytruth.reference_tracer.arithmetics.balls import Decisions, ball_arithmetic, every_outcome
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.compilation import image_entry_points, kernel_program
from raytruth.reference_tracer.arithmetics.instantiation import COMPILED_ENTRY_POINTS, kernel_source
from raytruth.reference_tracer.rendering import first_hits, prepare, render
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import (
    EXACT,
    ball_kernel,
    balls_of,
    exact_kernel,
    float_kernel,
    fractions_of,
    holds,
    kept_precision,
    put_in_force,
)
from tests.reference_tracer.small_scenes import lamp, library_scene, small_scene

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from raytruth.reference_tracer.source.numbers import Scalar

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("ARI-1")]


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


ORIGIN, X, Z = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
# Dyadic numbers, and roots of squares only: all of these have rational values.
CALLS: dict[str, tuple[str, tuple[Any, ...]]] = {
    "sphere from outside": ("sphere_distance", ((-3.0, 0.75, 0.0), X, ORIGIN, 1.25)),
    "sphere from inside": ("sphere_distance", ((0.25, 0.75, 0.0), X, ORIGIN, 1.25)),
    "sphere with a long direction": ("sphere_distance", ((-3.0, 0.75, 0.0), (3.0, 0.0, 0.0), ORIGIN, 1.25)),
    "other side of a sphere": ("distance_to_other_side", ((-1.0, 0.5, 0.1), (0.3, -0.7, -0.2), ORIGIN)),
    "normal of a sphere": ("sphere_normal", ((0.1, 0.2, 0.7), (0.3, 0.5, 0.1), 0.7)),
    "triangle": ("triangle_distance", ((0.1, 0.2, 3.0), (0.01, 0.03, -0.7), ORIGIN, (1.1, 0.1, 0.2), (0.2, 0.9, -0.3))),
    "normal of a triangle": ("triangle_normal", (ORIGIN, (3.0, 0.0, 4.0), (0.0, 1.0, 0.0))),
    "mirror": ("mirror_direction", ((0.1, 0.2, -0.7), (0.3, -0.1, 0.9))),
    "Snell": ("snell_discriminant", (0.7, 1.3)),
    "refraction": ("refracted_direction", ((0.1, 0.2, -0.7), (0.3, -0.1, 0.9), 0.7, 1.1, 1.3)),
    "Fresnel": ("fresnel_reflectance", (0.7, 1.1, 1.3)),
    "Phong": ("phong", (Z, (0.1, 0.2, -0.9), (0.3, 0.1, 0.7), 7.0)),
    "Phong turned away": ("phong", (Z, (0.1, 0.2, -0.9), (0.0, 0.0, -1.0), 7.0)),
    "Blinn": ("blinn", ((0.1, 0.2, 0.9), (0.0, -4.0, -3.0), ORIGIN, 7.0)),
    "box": ("box_is_missed", ((-3.0, 0.1, 0.2), X, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), 9.0)),
}


@pytest.mark.parametrize("name", CALLS)
def test_floats_fractions_and_balls_agree_on_a_function(name: str) -> None:
    function, arguments = CALLS[name]
    exact = getattr(exact_kernel(), function)(*map(fractions_of, arguments))
    rounded = getattr(float_kernel(), function)(*arguments)
    kernel, decisions = ball_kernel(200)
    narrow = getattr(kernel, function)(*map(balls_of, arguments))
    assert decisions.answers == []
    # A ball of 48 bits allows each operation 32 times what rounding to 53 bits can do to it.
    kernel, decisions = ball_kernel(48)
    wide = getattr(kernel, function)(*map(balls_of, arguments))
    assert decisions.answers == []
    if isinstance(exact, bool):
        assert exact == rounded == narrow == wide
        return
    for value, number, ball, wide_ball in zip(*map(parts, (exact, rounded, narrow, wide)), strict=True):
        assert isinstance(value, Fraction)
        assert isinstance(number, float)
        assert holds(ball, value)
        assert ball.rad() < arb(2) ** -180
        assert wide_ball.contains(arb(number)), number.hex()
        assert holds(wide_ball, value)


def parts(value: Any) -> tuple[Any, ...]:
    return value if isinstance(value, tuple) else (value,)


GLASS = {"dielectric": {"index_of_refraction": 1.5, "reflectance": (0.5, 0.25, 0.1), "transmittance": (0.3, 0.7, 0.9)}}


def test_floats_fractions_and_balls_agree_on_a_whole_pixel() -> None:
    # Through a lens of glass, seen head on: diffuse, specular, and emitted light, both kinds of rays.
    gloss = {"reflectance": (0.1,) * 3, "exponent": 5.0, "model": "phong"}
    wall = {"diffuse": {"reflectance": (0.7, 0.3, 0.1)}, "specular": gloss}
    scene = small_scene(
        max_depth=4,
        materials={"glass": GLASS, "wall": wall},
        objects=[
            {"shape": "sphere", "center": ORIGIN, "radius": 1.0, "material": "glass"},
            {"shape": "triangle", "vertices": ((-9, -9, -2), (9, -9, -2), (0, 9, -2)), "material": "wall"},
        ],
        lights=[lamp((3.0, 0.0, 2.0), 1.1, "inverse_square")],
        background={"bottom": (0.1, 0.2, 0.3), "top": (0.4, 0.6, 0.9)},
    )
    exact = render(scene, EXACT)[0, 0]
    rounded = render(scene, FLOAT)[0, 0]
    for bits in (200, 48):
        decisions = Decisions()
        balls = render(scene, put_in_force(ball_arithmetic(bits, decisions)))[0, 0]
        assert decisions.answers == []
        for ball, value, number in zip(balls, exact, rounded, strict=True):
            assert holds(ball, value)
            assert bits > 53 or ball.contains(arb(number)), number.hex()


@pytest.mark.parametrize("name", ["whitted-1980", "tinted-glass", "trefoil-knot", "blinn-sphere"])
def test_interpreted_and_compiled_floats_give_the_same_bits(name: str) -> None:
    scene = library_scene(name, 24, 18)
    assert render(scene, FLOAT).tolist() == render(scene, FLOAT64).tolist()
    interpreted, compiled = (first_hits(prepare(scene, arithmetic)) for arithmetic in (FLOAT, FLOAT64))
    for one, other in zip(interpreted, compiled, strict=True):
        assert one.tolist() == other.tolist()


@pytest.mark.clause("ARI-4")
@pytest.mark.parametrize("name", ["whitted-1980", "tinted-glass"])
def test_some_outcome_in_balls_holds_the_floats_of_a_pixel(name: str) -> None:
    scene = library_scene(name, 8, 6)
    image = render(scene, FLOAT64)
    decisions = Decisions()
    prepared = prepare(scene, put_in_force(ball_arithmetic(48, decisions)))  # as above
    frame = prepared.kernel.camera_frame(prepared.data)
    for row, column in np.ndindex(image.shape[:2]):
        x, y = arb(column + 0.5), arb(row + 0.5)
        outcomes = every_outcome(
            lambda x=x, y=y: prepared.kernel.radiance_at(prepared.data, frame, x, y), decisions, 64
        )
        pixel = [arb(float(part)) for part in image[row, column]]
        held = [all(ball.contains(part) for ball, part in zip(o, pixel, strict=True)) for o in outcomes]
        assert any(held), (column, row)


def half_diffuse(scene, material, point):  # type: ignore[no-untyped-def]  # noqa: ARG001 - the signature of diffuse
    return (0.5, 0.5, 0.5)


def quarter_diffuse(scene, material, point):  # type: ignore[no-untyped-def]  # noqa: ARG001 - the signature of diffuse
    return (0.25, 0.25, 0.25)


@pytest.mark.clause("ARI-2")
def test_another_override_of_the_same_function_is_another_compiled_kernel(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path))
    scene = small_scene(lights=[lamp((0.0, 0.0, 3.0))])
    for override, value in ((half_diffuse, 0.5), (quarter_diffuse, 0.25), (half_diffuse, 0.5)):
        assert render(scene, FLOAT64, Behaviour({"diffuse": override}))[0, 0, 0] == value
    assert len(list((tmp_path / "kernels").glob("*.o"))) == 2


# Arithmetic on doubles, conversions to and from them, and calls of functions of them.
DOUBLE = re.compile(r"\b(f(add|sub|mul|div|neg|cmp|rem)( \w+)* double|fpext|fptrunc|(si|ui)tofp .* to double|f64)\b")


@pytest.mark.parametrize(
    "line",
    [
        "%.4 = fmul double %.2, %.3",
        "%.4 = fadd contract double %.2, %.3",
        "%.4 = fcmp oge double %.2, %.3",
        "%.4 = fpext float %.2 to double",
        "%.4 = sitofp i64 %.2 to double",
        "%.4 = call double @llvm.sqrt.f64(double %.2)",
    ],
)
def test_arithmetic_in_float64_would_be_noticed(line: str) -> None:
    assert DOUBLE.search(line)
    assert not DOUBLE.search(line.replace("double", "float").replace("f64", "f32").replace("fpext", "fneg"))


def test_a_kernel_in_float32_of_all_features_does_no_arithmetic_in_float64() -> None:
    lines, of_float64 = (all_features(arithmetic).splitlines() for arithmetic in (FLOAT32, FLOAT64))
    assert any("fmul float" in line for line in lines)
    assert [line for line in lines if DOUBLE.search(line)] == []
    assert any(DOUBLE.search(line) for line in of_float64)


def all_features(arithmetic: Arithmetic) -> str:
    source, literals = kernel_source(set(Feature), entry_points=COMPILED_ENTRY_POINTS)
    return kernel_program(source, literals, arithmetic, image_entry_points(arithmetic)).ir_text()


QUOTIENTS = [0.0, -0.0, 1.5, -2.0, math.inf, -math.inf, math.nan]


@pytest.mark.clause("ARI-1", "NUM-2")
@pytest.mark.parametrize("dividend", QUOTIENTS)
@pytest.mark.parametrize("divisor", QUOTIENTS)
def test_interpreted_floats_divide_by_zero_as_compiled_ones_do(dividend: float, divisor: float) -> None:
    def quotient_of_quotients(a: Scalar, b: Scalar) -> Scalar:
        return (a / b) / (b / a)

    with np.errstate(all="ignore"):
        expected = quotient_of_quotients(np.float64(dividend), np.float64(divisor))
        single = np.float64(dividend) / np.float64(divisor)
    kernel = make_kernel(FLOAT, set(Feature), Behaviour({"snell_discriminant": quotient_of_quotients}))
    np.testing.assert_equal(kernel.snell_discriminant(dividend, divisor), float(expected))
    if divisor == 0.0:
        np.testing.assert_equal(over_zero(dividend, divisor), float(single))
