from __future__ import annotations

from fractions import Fraction
from math import inf
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.source.plane import plane_distance, plane_normal
from tests.properties.exact import UNIT_ROUNDOFF, dot, exact, gamma, length, minus, size_of_dot
from tests.properties.strategies import (
    AXIS_MAPS,
    SCALES,
    SIGNS,
    STRANGE_VECTORS,
    Ray,
    Vector,
    combined,
    directions,
    mapped,
    perpendiculars,
    tidy_vectors,
    vectors,
)
from tests.reference_tracer.kernels import exact_kernel, numpy_kernel
from tests.reproduction import note_case


class Plane(NamedTuple):
    point: Vector
    normal: Vector


# Of ray and plane: across, grazing to any degree, parallel within rounding. Exactly parallel is tidy_rays_at_planes.
SINES = st.sampled_from([1.0, -1.0, 0.3, -0.3, 1e-3, -1e-3, 1e-9, -1e-9, 1e-15, -1e-15, 0.0])
HEIGHTS = st.sampled_from([1.0, -1.0, 1e-3, 1e3, -1e-9, 0.0])
AWAY = st.sampled_from([0.0, 1.0, 1e3, 1e6])
"""How far the stated point is from the ray's foot, along the plane."""


@st.composite
def rays_at_planes(draw: st.DrawFn) -> tuple[Ray, Plane]:
    scale = draw(SCALES)
    unit = draw(directions())
    along = draw(perpendiculars(unit))
    foot = draw(vectors(scale))
    origin = combined(foot, unit, draw(HEIGHTS) * scale)
    direction = combined(along, unit, draw(SINES))
    point = combined(foot, draw(perpendiculars(unit)), draw(AWAY) * scale)
    normal = combined((0.0, 0.0, 0.0), unit, draw(SIGNS) * draw(st.sampled_from([1.0, 0.125, 7.3, 1e-6, 1e6])))
    return Ray(origin, direction), Plane(point, normal)


@st.composite
def tidy_rays_at_planes(draw: st.DrawFn) -> tuple[Ray, Plane]:
    """With small whole coordinates: rays within the plane, parallel to it and from its points are frequent."""
    ray = Ray(draw(tidy_vectors()), draw(tidy_vectors().filter(any)))
    return ray, Plane(draw(tidy_vectors()), draw(tidy_vectors().filter(any)))


CASES = st.one_of(rays_at_planes(), tidy_rays_at_planes())


def exact_distance(ray: Ray, plane: Plane) -> tuple[Fraction, Fraction]:
    """The numerator and the denominator of t."""
    height = dot(minus(exact(plane.point), exact(ray.origin)), exact(plane.normal))
    return height, dot(exact(ray.direction), exact(plane.normal))


@pytest.mark.clause("PLANE-1", "PLANE-2", "PLANE-3")
@given(CASES)
def test_in_exact_arithmetic_the_plane_is_met_where_its_equation_holds(case: tuple[Ray, Plane]) -> None:
    ray, plane = case
    note_case(ray=ray, plane=plane)
    origin, direction, point, normal = map(exact, (*ray, *plane))
    found = exact_kernel().plane_distance(origin, direction, point, normal)
    height, approach = exact_distance(ray, plane)
    if approach == 0 or height / approach <= 0:
        assert found == inf
    else:
        at = tuple(o + found * d for o, d in zip(origin, direction, strict=True))
        assert found > 0
        assert dot(minus(at, point), normal) == 0  # type: ignore[arg-type] - three of them


@pytest.mark.clause("PLANE-1", "PLANE-2")
@given(CASES)
def test_the_distance_is_off_by_no_more_than_its_products_round(case: tuple[Ray, Plane]) -> None:
    ray, plane = case
    note_case(ray=ray, plane=plane)
    found = plane_distance(*ray, *plane)
    height, approach = exact_distance(ray, plane)
    # A difference, and a sum of three products.
    sizes = tuple(abs(Fraction(p) - Fraction(o)) for p, o in zip(plane.point, ray.origin, strict=True))
    doubt = gamma(4) * size_of_dot(sizes, exact(plane.normal))  # type: ignore[arg-type] - three of them
    doubt_of_approach = gamma(3) * size_of_dot(exact(ray.direction), exact(plane.normal))
    if abs(height) > doubt and abs(approach) > doubt_of_approach:
        if (height > 0) != (approach > 0):
            assert found == inf
            return
        smallest = (abs(height) - doubt) / (abs(approach) + doubt_of_approach)
        largest = (abs(height) + doubt) / (abs(approach) - doubt_of_approach)
        assert smallest * (1 - UNIT_ROUNDOFF) <= Fraction(found) <= largest * (1 + UNIT_ROUNDOFF)
    else:
        assert found > 0.0


@pytest.mark.clause("PLANE-1", "PLANE-3")
@given(CASES, AXIS_MAPS, SIGNS, st.integers(-30, 30))
def test_neither_the_length_nor_the_sign_of_the_normal_nor_the_axes_change_a_bit(
    case: tuple[Ray, Plane], axis_map: tuple[tuple[int, ...], tuple[int, ...]], sign: float, exponent: int
) -> None:
    (ray, plane), factor = case, sign * 2.0**exponent
    note_case(ray=ray, plane=plane)
    found = plane_distance(*ray, *plane)
    assert plane_distance(*ray, plane.point, combined((0.0, 0.0, 0.0), plane.normal, factor)) == found
    turned = plane_distance(*(mapped(vector, axis_map) for vector in (*ray, *plane)))
    if axis_map[0] == (0, 1, 2):  # in another order the sums of three round otherwise
        assert turned == found


@pytest.mark.clause("PLANE-4")
@given(vectors().filter(any), SCALES)
def test_the_normal_has_the_length_1_and_the_direction_that_is_stated(normal: Vector, scale: float) -> None:
    stated = combined((0.0, 0.0, 0.0), normal, scale)
    note_case(normal=stated)
    unit = exact(plane_normal(stated))
    size = length(exact(stated))
    # The dot product, its root, a reciprocal and a product: half of 3, and 3 more.
    for found, part in zip(unit, exact(stated), strict=True):
        assert abs(found - part / size) <= gamma(5) * abs(part / size) * (1 + UNIT_ROUNDOFF) + Fraction(1, 2**90)


@pytest.mark.clause("NUM-2")
@given(STRANGE_VECTORS, STRANGE_VECTORS, STRANGE_VECTORS, STRANGE_VECTORS, st.sampled_from([np.float64, np.float32]))
def test_a_distance_is_never_negative_whatever_the_numbers(
    origin: Vector, direction: Vector, point: Vector, normal: Vector, number: type[np.floating]
) -> None:
    note_case(origin=origin, direction=direction, point=point, normal=normal)
    with np.errstate(all="ignore"):
        vectors_of_numbers = [tuple(map(number, vector)) for vector in (origin, direction, point, normal)]
        assert not numpy_kernel(number).plane_distance(*vectors_of_numbers) < 0
