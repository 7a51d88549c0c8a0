from __future__ import annotations

import pytest
from hypothesis import given

from raytruth.reference_tracer.source.reflection import mirror_direction
from tests.properties.exact import Exact, cross, dot, exact, gamma, length, minus
from tests.properties.strategies import Vector, directions, rational_unit_vectors, vectors
from tests.reference_tracer.kernels import exact_kernel
from tests.reproduction import note_case

pytestmark = pytest.mark.clause("REFL-1")


@given(rational_unit_vectors(), rational_unit_vectors())
def test_reflection_is_an_involution_that_keeps_length_angle_and_plane(direction: Exact, normal: Exact) -> None:
    mirror = exact_kernel().mirror_direction
    mirrored = mirror(direction, normal)
    assert dot(mirrored, mirrored) == 1
    assert dot(mirrored, normal) == -dot(direction, normal)
    assert cross(mirrored, normal) == cross(direction, normal)
    assert mirror(mirrored, normal) == direction


@given(rational_unit_vectors(), rational_unit_vectors())
def test_the_side_of_the_normal_does_not_matter(direction: Exact, normal: Exact) -> None:
    mirror = exact_kernel().mirror_direction
    assert mirror(direction, normal) == mirror(direction, (-normal[0], -normal[1], -normal[2]))


@given(rational_unit_vectors(), rational_unit_vectors())
def test_a_reflected_ray_reversed_reflects_into_the_reversed_ray(direction: Exact, normal: Exact) -> None:
    mirror = exact_kernel().mirror_direction
    mirrored = mirror(direction, normal)
    back = mirror((-mirrored[0], -mirrored[1], -mirrored[2]), normal)
    assert back == (-direction[0], -direction[1], -direction[2])


@given(vectors().filter(any), directions())
def test_rounding_moves_a_mirrored_direction_by_less_than_derived(direction: Vector, normal: Vector) -> None:
    note_case(direction=direction, normal=normal)
    d, n = exact(direction), exact(normal)
    factor = -2 * dot(d, n)
    ideal = (d[0] + factor * n[0], d[1] + factor * n[1], d[2] + factor * n[2])
    # The factor is off by γ(3)·2·|d||n|, its product with n by one rounding more, the sum by another, on all of it.
    reach = length(d) + 2 * length(d) * length(n) ** 2
    error = length(minus(exact(mirror_direction(direction, normal)), ideal))
    assert error <= gamma(5) * reach
