from __future__ import annotations

from fractions import Fraction
from math import ulp
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.source.compensated import sphere_constant
from tests.properties.exact import bits, dot, exact, gamma, length, minus
from tests.properties.strategies import Ray, Sphere, rays_close_to_spheres
from tests.reference_tracer.kernels import exact_kernel, float_kernel, fractions_of, numpy_kernel
from tests.reproduction import note_case

pytestmark = pytest.mark.clause("ARI-1")

NUMBERS = st.floats(-1e30, 1e30, allow_subnormal=False).filter(lambda x: x == 0 or abs(x) > 1e-30)
NUMBERS_32 = st.floats(-(2.0**40), 2.0**40, width=32, allow_subnormal=False).filter(
    lambda x: x == 0 or abs(x) > 2.0**-40
)


@given(NUMBERS, NUMBERS)
def test_a_sum_and_its_error_are_together_exact(a: float, b: float) -> None:
    note_case(a=a, b=b)
    total, error = float_kernel().two_sum(a, b)
    assert total == a + b
    assert Fraction(total) + Fraction(error) == Fraction(a) + Fraction(b)


@given(NUMBERS)
def test_a_square_and_its_error_are_together_exact(a: float) -> None:
    note_case(a=a)
    product, error = float_kernel().square(a)
    assert product == a * a
    assert Fraction(product) + Fraction(error) == Fraction(a) ** 2


@given(NUMBERS_32, NUMBERS_32)
def test_the_same_holds_in_float32(a: float, b: float) -> None:
    note_case(a=a, b=b)
    kernel = numpy_kernel(np.float32)
    for parts, expected in (
        (kernel.two_sum(np.float32(a), np.float32(b)), Fraction(a) + Fraction(b)),
        (kernel.square(np.float32(a)), Fraction(a) ** 2),
    ):
        assert all(type(part) is np.float32 for part in parts)
        assert sum(Fraction(float(part)) for part in parts) == expected


def test_a_square_next_to_one_is_split_without_a_bit_too_many() -> None:
    # Split by 2^12 instead of 2^12 + 1, the upper half of such a number would have 13 bits, whose square has 25.
    a = np.float32(float.fromhex("0x1.000802p+0"))
    product, error = numpy_kernel(np.float32).square(a)
    assert Fraction(float(product)) + Fraction(float(error)) == Fraction(float(a)) ** 2


def test_in_exact_arithmetic_there_is_no_error() -> None:
    assert exact_kernel().two_sum(Fraction(1, 3), Fraction(1, 7)) == (Fraction(10, 21), 0)
    assert exact_kernel().square(Fraction(1, 3)) == (Fraction(1, 9), 0)
    origin, center = ((0.1, 0.2, 0.3), (0.3, -0.1, 0.7))
    constant = dot(minus(exact(origin), exact(center)), minus(exact(origin), exact(center))) - Fraction(0.5) ** 2
    assert exact_kernel().sphere_constant(fractions_of(origin), fractions_of(center), Fraction(0.5)) == constant


@pytest.mark.clause("SPH-1")
@pytest.mark.parametrize(("number", "bits_of_type"), [(np.float64, 53), (np.float32, 24)])
@given(case=rays_close_to_spheres())
def test_the_constant_of_a_huge_sphere_keeps_its_bits_close_to_the_surface(
    number: Any, bits_of_type: int, case: tuple[Ray, Sphere]
) -> None:
    ray, sphere = case
    origin, center, radius = (
        tuple(map(number, ray.origin)),
        tuple(map(number, sphere.center)),
        number(sphere.radius),
    )
    note_case(origin=ray.origin, center=sphere.center, radius=sphere.radius)
    arm = minus(exact(tuple(map(float, origin))), exact(tuple(map(float, center))))
    ideal = dot(arm, arm) - Fraction(float(radius)) ** 2
    constant = numpy_kernel(number).sphere_constant(origin, center, radius)
    # γ(n) is given for 53 bits. The last sum rounds once; the corrections, γ(2) of the squares, are rounded ten times.
    wider = 2 ** (53 - bits_of_type)
    size = (length(arm) + Fraction(float(radius))) ** 2
    doubt = 2 * wider * gamma(1) * abs(ideal) + (wider * gamma(10)) ** 2 * size
    assert abs(Fraction(float(constant)) - ideal) <= doubt


@pytest.mark.clause("SPH-1")
def test_a_camera_one_metre_above_the_earth_loses_no_bit() -> None:
    origin, radius = (0.6 * 6371001.0, 0.0, 0.8 * 6371001.0), 6371000.0
    ideal = dot(exact(origin), exact(origin)) - Fraction(radius) ** 2
    error = abs(Fraction(sphere_constant(origin, (0.0, 0.0, 0.0), radius)) - ideal)
    assert error <= Fraction(ulp(float(ideal)))
    plain = origin[0] ** 2 + origin[2] ** 2 - radius**2
    assert bits(abs(Fraction(plain) - ideal), abs(ideal)) > 15


COORDINATES = st.floats(-1.0, 1.0).filter(lambda x: x == 0 or abs(x) > 2.0**-20)


@pytest.mark.clause("SPH-1")
@given(st.tuples(COORDINATES, COORDINATES, COORDINATES), st.floats(0.25, 1.0))
def test_far_from_the_surface_only_the_last_sum_rounds(origin: tuple[float, float, float], radius: float) -> None:
    note_case(origin=origin, radius=radius)
    ideal = dot(exact(origin), exact(origin)) - Fraction(radius) ** 2
    error = abs(Fraction(sphere_constant(origin, (0.0, 0.0, 0.0), radius)) - ideal)
    # Half a unit in the last place, and the corrections' own roundings: ten at most of what is γ(2) of the squares.
    assert error <= gamma(1) * abs(ideal) + gamma(10) ** 2 * (length(exact(origin)) + Fraction(radius)) ** 2
