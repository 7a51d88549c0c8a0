from __future__ import annotations

from fractions import Fraction
from math import inf, isfinite, isnan
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, target
from hypothesis import strategies as st

from raytruth.reference_tracer.source.sphere import distance_to_other_side, sphere_distance, sphere_normal
from raytruth.reference_tracer.source.vector import along
from tests.properties.exact import dot, exact, gamma, length, minus, plus, root_above, times
from tests.properties.strategies import (
    AXIS_MAPS,
    SMALL_FRACTIONS,
    STRANGE,
    STRANGE_VECTORS,
    Ray,
    Sphere,
    Vector,
    mapped,
    rational_unit_vectors,
    rays_near_spheres,
)
from tests.reference_tracer.kernels import exact_kernel, numpy_kernel
from tests.reproduction import note_case


class Meeting:
    """The quadratic in exact arithmetic: f(t) = |o + t·d - c|² - r² = d²·(t - q)² - gap."""

    def __init__(self, ray: Ray, sphere: Sphere) -> None:
        direction = exact(ray.direction)
        to_origin = minus(exact(ray.origin), exact(sphere.center))
        radius = Fraction(sphere.radius)
        self.squared = dot(direction, direction)
        self.half_linear = dot(direction, to_origin)
        self.constant = dot(to_origin, to_origin) - radius**2
        self.gap = self.half_linear**2 / self.squared - self.constant
        self.size = length(to_origin) + radius
        self.radius = radius

    def residual(self, distance: float) -> Fraction:
        """f(t)."""
        t = Fraction(distance)
        return self.squared * t * t + 2 * self.half_linear * t + self.constant

    @property
    def doubt(self) -> Fraction:
        """What rounding can do to f, as a part of S² with S = |o-c| + r.

        The vector o-c is off by u·|o-c|, its foot towards the centre by γ(14)·|o-c|: the dot product γ(4), the quotient
        γ(5) more, then one product and one sum a component, on top of o-c itself. So gap is off by 2·14 + 5 units of
        S², and so is the residual of a root computed from it. Where the root is constant/larger, the constant is off by
        5 units, which the factor 2·√gap/larger <= 1 does not increase. The last operations, and q, shift t by
        γ(12)·(|t| + |o-c|/|d|), which makes 2·12·r·(2·|o-c| + r) <= 24·S² more. Sum: 62; 80 has room for all squares.
        """
        return gamma(80) * self.size**2

    def residual_doubt(self, distance: float) -> Fraction:
        """What rounding can do to f at the hit.

        Close to the sphere the constant is off by γ(2) of itself and γ(10)²·S², and q by γ(9)·|o-c|/|d|. A root t of
        t² - 2qt + k shifts so that its residual is d²·(2·t·(shift of q) + (shift of k)), 18 units of t·|d|·S and 7 of
        the constant; its own roundings, γ(4)·(t + |q|) and less than half of it in the root, are 12 units of either.
        """
        if self.constant > self.radius**2 / 2:
            return self.doubt
        arm = root_above(self.squared) * Fraction(distance) * self.size
        return gamma(40) * (arm + abs(self.constant)) + gamma(10) ** 2 * self.size**2

    @property
    def gap_doubt(self) -> Fraction:
        """What rounding can do to gap; as above, 2·9 units of |q|·|d|·|o-c| close to the sphere."""
        if self.constant > self.radius**2 / 2:
            return self.doubt
        arm = abs(self.half_linear) / root_above(self.squared) * self.size
        return gamma(40) * (arm + abs(self.constant)) + gamma(10) ** 2 * self.size**2

    @property
    def constant_doubt(self) -> Fraction:
        """What rounding can do to the constant's sign: less than to the constant."""
        return gamma(10) ** 2 * self.size**2

    def must_hit(self) -> bool:
        return self.gap >= 0 and (self.constant < 0 or self.half_linear < 0)

    def is_certain(self) -> bool:
        """Neither tangent nor on the surface within rounding."""
        return abs(self.gap) > self.gap_doubt and abs(self.constant) > self.constant_doubt


def distance_of(ray: Ray, sphere: Sphere) -> float:
    note_case(ray=ray, sphere=sphere)
    return sphere_distance(ray.origin, ray.direction, sphere.center, sphere.radius)


@pytest.mark.clause("SPH-1", "SPH-2")
@given(rays_near_spheres())
def test_a_ray_hits_exactly_if_the_exact_discriminant_says_so(case: tuple[Ray, Sphere]) -> None:
    meeting = Meeting(*case)
    assume(meeting.is_certain())
    assert (distance_of(*case) < inf) == meeting.must_hit()


@pytest.mark.clause("SPH-1")
@given(rays_near_spheres())
def test_hit_points_lie_ahead_on_the_surface(case: tuple[Ray, Sphere]) -> None:
    meeting = Meeting(*case)
    distance = distance_of(*case)
    assume(distance < inf)
    assert distance > 0
    doubt = meeting.residual_doubt(distance)
    target(float(abs(meeting.residual(distance)) / doubt))
    assert abs(meeting.residual(distance)) <= doubt


@pytest.mark.clause("SPH-1", "SPH-3")
@given(rays_near_spheres())
def test_the_nearest_root_ahead_is_chosen(case: tuple[Ray, Sphere]) -> None:
    meeting = Meeting(*case)
    assume(meeting.is_certain())
    distance = distance_of(*case)
    assume(distance < inf)
    # f(t) is small against gap, so t is near one of the roots: before the foot from outside, behind it from inside.
    before_the_foot = meeting.half_linear + meeting.squared * Fraction(distance) < 0
    assert before_the_foot == (meeting.constant > 0)


@pytest.mark.clause("SPH-5")
@given(rays_near_spheres())
def test_normals_are_unit_vectors_that_point_outward(case: tuple[Ray, Sphere]) -> None:
    ray, sphere = case
    meeting = Meeting(*case)
    distance = distance_of(*case)
    assume(distance < inf)
    point = along(ray.origin, ray.direction, distance)
    normal = exact(sphere_normal(point, sphere.center, sphere.radius))
    radius = Fraction(sphere.radius)
    outward = minus(plus(exact(ray.origin), times(exact(ray.direction), Fraction(distance))), exact(sphere.center))
    # The point: a product and a sum a component; the normal: a difference, a quotient and a product.
    sizes = length(exact(ray.origin)) + 2 * length(times(exact(ray.direction), Fraction(distance)))
    error = (gamma(2) * sizes + gamma(3) * length(outward)) / radius
    assert length(minus(normal, times(outward, 1 / radius))) <= error * (1 + gamma(8))
    reach = 1 + error
    assert abs(dot(normal, normal) - 1) <= meeting.doubt / radius**2 + 2 * error * reach + gamma(8) * reach**2


@pytest.mark.clause("TRAV-5")
@given(rays_near_spheres(), AXIS_MAPS, st.sampled_from([-20, -3, 1, 20]))
def test_mirrored_and_scaled_scenes_give_the_same_bits(
    case: tuple[Ray, Sphere], axis_map: tuple[tuple[int, ...], tuple[int, ...]], power: int
) -> None:
    # Signs and powers of 2 do not round; the order of the axes is left alone, since sums depend on it.
    ray, sphere = case
    signs = ((0, 1, 2), axis_map[1])
    scale = 2.0**power
    bigger = [mapped((v[0] * scale, v[1] * scale, v[2] * scale), signs) for v in (ray.origin, sphere.center)]
    image = sphere_distance(bigger[0], mapped(ray.direction, signs), bigger[1], sphere.radius * scale)
    assert image == distance_of(ray, sphere) * scale


@pytest.mark.clause("SPH-1")
@given(rational_unit_vectors(), rational_unit_vectors(), SMALL_FRACTIONS, AXIS_MAPS)
def test_distances_along_a_rational_chord_are_exact_in_exact_arithmetic(
    first: tuple[Fraction, Fraction, Fraction],
    second: tuple[Fraction, Fraction, Fraction],
    start: Fraction,
    axis_map: tuple[tuple[int, ...], tuple[int, ...]],
) -> None:
    assume(first != second)
    chord = minus(second, first)
    origin = mapped(minus(first, times(chord, start)), axis_map)
    center = (Fraction(0), Fraction(0), Fraction(0))
    distance = exact_kernel().sphere_distance(origin, mapped(chord, axis_map), center, Fraction(1))
    roots = [root for root in (start, start + 1) if root > 0]
    assert distance == min(roots, default=inf)


@pytest.mark.clause("SPH-4")
@given(rational_unit_vectors(), rational_unit_vectors())
def test_the_other_side_is_the_positive_root_of_the_quadratic_and_leads_back(
    first: tuple[Fraction, Fraction, Fraction], second: tuple[Fraction, Fraction, Fraction]
) -> None:
    assume(first != second)
    kernel = exact_kernel()
    chord = minus(second, first)
    center = (Fraction(0), Fraction(0), Fraction(0))
    assert kernel.distance_to_other_side(first, chord, center) == 1
    assert kernel.sphere_distance(first, chord, center, Fraction(1)) == 1
    assert kernel.distance_to_other_side(second, times(chord, Fraction(-1)), center) == 1
    assert kernel.distance_to_other_side(first, times(chord, Fraction(-1)), center) == inf


@pytest.mark.clause("SPH-4")
@given(rays_near_spheres())
def test_a_ray_reversed_at_the_other_side_comes_back_to_its_start(case: tuple[Ray, Sphere]) -> None:
    ray, sphere = case
    there = distance_to_other_side(ray.origin, ray.direction, sphere.center)
    assume(there < inf)
    note_case(ray=ray, sphere=sphere, there=there)
    point = along(ray.origin, ray.direction, there)
    back_direction = (-ray.direction[0], -ray.direction[1], -ray.direction[2])
    back = distance_to_other_side(point, back_direction, sphere.center)
    direction = exact(ray.direction)
    arm = length(minus(exact(ray.origin), exact(sphere.center)))
    # Each distance is -2·(d·(o-c))/d²: γ(4) of |d|·|o-c| in the dot product and γ(5) of the quotient; the point between
    # is off by γ(2)·(|o| + 2·|t·d|), and |o-c| is the same at both ends within that.
    moved = gamma(2) * (length(exact(ray.origin)) + 2 * length(times(direction, Fraction(there))))
    doubt = 2 * (2 * gamma(9) * (arm + moved) + moved) / length(direction) * (1 + gamma(9))
    if doubt < Fraction(there):  # else the way back may be taken for a ray that leaves
        assert abs(Fraction(back) - Fraction(there)) <= doubt


def strange(*vectors: Vector) -> tuple[Any, ...]:
    """In NumPy's numbers, which divide by zero without an error, as compiled ones do."""
    return tuple(tuple(map(np.float64, vector)) for vector in vectors)


@pytest.mark.clause("NUM-2")
@given(STRANGE_VECTORS, STRANGE_VECTORS, STRANGE_VECTORS, STRANGE)
def test_whatever_the_numbers_are_no_distance_is_negative_and_what_is_no_number_is_not_hit(
    origin: Vector, direction: Vector, center: Vector, radius: float
) -> None:
    note_case(origin=origin, direction=direction, center=center, radius=radius)
    numbers = strange(origin, direction, center)
    with np.errstate(all="ignore"):
        distance = numpy_kernel(np.float64).sphere_distance(*numbers, np.float64(radius))
        other_side = numpy_kernel(np.float64).distance_to_other_side(*numbers)
    assert not distance < 0
    assert not other_side < 0
    if not all(map(isfinite, (*origin, *direction, *center))):
        # Neither is less than the infinity of what has been met so far.
        assert not other_side < inf
        assert not distance < inf
    if not isfinite(radius):
        assert not distance < inf


@pytest.mark.clause("NUM-2")
@given(STRANGE_VECTORS, STRANGE_VECTORS, STRANGE.filter(bool))
def test_a_normal_of_what_is_not_a_number_is_none(point: Vector, center: Vector, radius: float) -> None:
    note_case(point=point, center=center, radius=radius)
    with np.errstate(all="ignore"):
        normal = numpy_kernel(np.float64).sphere_normal(*strange(point, center), np.float64(radius))
    for part, on_sphere, middle in zip(normal, point, center, strict=True):
        if any(map(isnan, (on_sphere, middle, radius))):
            assert isnan(part)
