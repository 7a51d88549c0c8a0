from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given

from raytruth.reference_tracer.source import vector
from raytruth.reference_tracer.source.vector import normalize
from tests.properties.exact import Exact, cross, dot, exact, gamma, minus, plus, times
from tests.properties.strategies import Vector, rational_unit_vectors, vectors
from tests.reference_tracer.kernels import exact_kernel
from tests.reproduction import note_case


@pytest.mark.clause("ARI-1")
@given(vectors(), vectors())
def test_vectors_of_fractions_are_exact(a: Vector, b: Vector) -> None:
    p, q = exact(a), exact(b)
    factor = Fraction(2, 7)
    vector = exact_kernel()
    assert vector.add(p, q) == plus(p, q)
    assert vector.subtract(p, q) == minus(p, q)
    assert vector.negate(p) == times(p, Fraction(-1))
    assert vector.scale(p, factor) == times(p, factor)
    assert vector.multiply(p, q) == (p[0] * q[0], p[1] * q[1], p[2] * q[2])
    assert vector.dot(p, q) == dot(p, q)
    assert vector.cross(p, q) == cross(p, q)
    assert vector.along(p, q, factor) == plus(p, times(q, factor))


@pytest.mark.clause("CAM-1")
def test_the_axes_are_right_handed() -> None:
    assert vector.cross((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)) == (0.0, 0.0, 1.0)


@pytest.mark.clause("CAM-1")
@given(rational_unit_vectors())
def test_the_unit_vector_of_a_multiple_is_the_unit_vector(unit: Exact) -> None:
    assert exact_kernel().normalize(times(unit, Fraction(3, 11))) == unit


@pytest.mark.clause("CAM-3")
@given(vectors().filter(any))
def test_rounding_keeps_a_unit_vector_within_its_bound_of_unit_length(a: Vector) -> None:
    note_case(a=a)
    # γ(3) of the sum of squares, halved by the root; root, quotient and product one each: γ(5), and squared γ(10).
    assert abs(dot(exact(normalize(a)), exact(normalize(a))) - 1) <= gamma(10)


@pytest.mark.clause("NUM-1")
def test_a_zero_vector_has_no_direction() -> None:
    with pytest.raises(ZeroDivisionError):
        normalize((0.0, 0.0, 0.0))
