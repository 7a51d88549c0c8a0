"""The strategies of tests/properties reach the cases that their properties are about."""

from __future__ import annotations

from fractions import Fraction
from random import Random
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import Phase, find, settings
from hypothesis import strategies as st

from tests.properties import test_sphere, test_triangle
from tests.properties.exact import cross, dot, exact, minus
from tests.properties.strategies import (
    CUBE_SYMMETRIES,
    INSIDE,
    cosines_and_ratios,
    directions,
    rational_frames,
    rational_refractions,
    rational_unit_vectors,
    rays_at_fans,
    rays_near_spheres,
    rays_near_triangles,
    triangles,
    vectors,
)
from tests.properties.test_bounding_volume import rays_near_boxes, touches

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("PRJ-5")

# One example is enough, and need not be small.
SEARCH = settings(max_examples=3000, derandomize=False, database=None, phases=[Phase.generate])


def reaches(strategy: st.SearchStrategy[Any], is_the_case: Callable[[Any], bool]) -> None:
    """Raises NoSuchExample if the strategy does not; the seed makes every run the same."""
    find(strategy, is_the_case, settings=SEARCH, random=Random(1))


OCTANTS = [(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)]


@pytest.mark.parametrize("octant", OCTANTS)
@pytest.mark.parametrize(
    "strategy", [vectors(), directions(), rational_unit_vectors()], ids=["vector", "unit", "exact"]
)
def test_vectors_reach_every_octant(strategy: st.SearchStrategy[Any], octant: tuple[int, ...]) -> None:
    reaches(strategy, lambda v: all(part * sign > 0 for part, sign in zip(v, octant, strict=True)))


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [1, -1])
def test_directions_lie_along_every_axis(axis: int, sign: int) -> None:
    reaches(directions(), lambda v: v[axis] * sign == 1)


def test_axis_maps_are_all_symmetries_of_the_cube() -> None:
    assert len(set(CUBE_SYMMETRIES)) == 48


def sphere_meeting(case: Any) -> test_sphere.Meeting:
    return test_sphere.Meeting(*case)


@pytest.mark.parametrize(
    "is_the_case",
    [
        pytest.param(lambda m: m.is_certain() and m.must_hit() and m.constant > 0, id="hit from outside"),
        pytest.param(lambda m: m.is_certain() and m.constant < 0, id="hit from inside"),
        pytest.param(lambda m: m.is_certain() and m.gap < 0, id="miss"),
        pytest.param(lambda m: m.is_certain() and m.gap > 0 and not m.must_hit(), id="sphere behind"),
        pytest.param(lambda m: m.gap == 0 and m.half_linear < 0, id="exactly tangent"),
        pytest.param(lambda m: 0 < m.gap < m.doubt, id="tangent within rounding, hit"),
        pytest.param(lambda m: 0 > m.gap > -m.doubt, id="tangent within rounding, missed"),
        pytest.param(lambda m: m.constant == 0 and m.half_linear < 0, id="starts on the surface, goes in"),
        pytest.param(lambda m: m.half_linear == 0 and m.constant < 0, id="starts at the foot"),
        pytest.param(lambda m: m.size > 10**6, id="large"),
        pytest.param(lambda m: m.size < Fraction(1, 10**5), id="small"),
        pytest.param(lambda m: 0 < m.constant < m.radius * 3 and m.radius == 10**7, id="just above a huge sphere"),
        pytest.param(lambda m: 0 > m.constant > -m.radius * 3 and m.radius == 10**7, id="just inside a huge sphere"),
        pytest.param(
            lambda m: 0 < abs(m.constant) < m.radius**2 * Fraction(1, 2**50), id="within some ulps of the surface"
        ),
        pytest.param(
            lambda m: m.is_certain() and abs(m.gap) < m.doubt and m.must_hit(), id="nearly tangent, yet certain"
        ),
    ],
)
def test_rays_near_spheres_reach(is_the_case: Callable[[test_sphere.Meeting], bool]) -> None:
    reaches(rays_near_spheres(), lambda case: is_the_case(sphere_meeting(case)))


@pytest.mark.parametrize(
    "is_the_case",
    [
        pytest.param(lambda m: m.is_certain() and m.must_hit(), id="hit"),
        pytest.param(lambda m: m.is_certain() and m.u < 0, id="beside the first edge"),
        pytest.param(lambda m: m.is_certain() and m.v < 0, id="beside the second edge"),
        pytest.param(
            lambda m: m.is_certain() and min(m.u, m.v) > 0 and m.u + m.v > m.determinant, id="beside the third"
        ),
        pytest.param(lambda m: m.is_certain() and m.t < 0, id="triangle behind"),
        pytest.param(lambda m: m.determinant == 0, id="parallel or without area"),
        pytest.param(lambda m: m.determinant > 0 and m.u == 0 and m.must_hit(), id="exactly on an edge"),
        pytest.param(lambda m: m.must_hit() and (m.u, m.v, m.w).count(0) == 2, id="exactly at a corner"),
        pytest.param(lambda m: m.determinant > 0 and 0 < -m.u < m.u_doubt, id="outside within rounding"),
    ],
)
def test_rays_near_triangles_reach(is_the_case: Callable[[test_triangle.Meeting], bool]) -> None:
    reaches(rays_near_triangles(), lambda case: is_the_case(test_triangle.Meeting(*case)))


def test_rays_at_fans_reach_the_hub_the_spokes_and_what_is_just_beside_them() -> None:
    def areas(case: Any) -> test_triangle.Meeting:
        ray, (hub, one, other, *_) = case
        return test_triangle.Meeting(ray, (hub, one, other))

    reaches(rays_at_fans(), lambda case: areas(case).v == areas(case).w == 0)
    reaches(rays_at_fans(), lambda case: areas(case).w == 0 < areas(case).v)
    reaches(rays_at_fans(), lambda case: 0 < abs(areas(case).w) < areas(case).doubts[2])


@pytest.mark.parametrize("sign", [1, -1])
def test_triangles_are_met_from_both_sides(sign: int) -> None:
    def side(case: Any) -> bool:
        ray, (a, b, c) = case
        normal = cross(minus(exact(b), exact(a)), minus(exact(c), exact(a)))
        return bool(sign * dot(exact(ray.direction), normal) > 0)

    reaches(rays_near_triangles(INSIDE), side)


def test_some_triangles_are_flat_and_most_are_not() -> None:
    def has_no_area(corners: Any) -> bool:
        a, b, c = map(exact, corners)
        return not any(cross(minus(b, a), minus(c, a)))

    reaches(triangles(), has_no_area)
    reaches(triangles(), lambda corners: not has_no_area(corners))


@pytest.mark.parametrize(
    "is_the_case",
    [
        pytest.param(lambda excess, squared: excess + squared < 0, id="total reflection"),
        pytest.param(
            lambda excess, squared: excess < 0 < excess + squared, id="no total reflection into thinner media"
        ),
        pytest.param(lambda excess, _: excess > 0, id="into denser media"),
        pytest.param(lambda excess, _: excess == 0, id="equal indices"),
        pytest.param(lambda excess, _: 0 < abs(excess) < Fraction(1, 10**9), id="nearly equal indices"),
        pytest.param(
            lambda excess, squared: excess < 0 and abs(excess + squared) < squared / 10**9, id="near the critical angle"
        ),
        pytest.param(lambda _, squared: squared == 1, id="head on"),
        pytest.param(lambda _, squared: squared < Fraction(1, 10**10), id="grazing"),
    ],
)
def test_cosines_and_ratios_reach(is_the_case: Callable[[Fraction, Fraction], bool]) -> None:
    reaches(cosines_and_ratios(), lambda case: is_the_case(Fraction(case[1]) ** 2 - 1, Fraction(case[0]) ** 2))


def test_rational_refractions_reach_thinner_and_denser_media_and_grazing() -> None:
    reaches(rational_refractions(), lambda case: case.ratio < 1)
    reaches(rational_refractions(), lambda case: case.ratio > 1)
    reaches(rational_refractions(), lambda case: case.ratio == 1)
    reaches(rational_refractions(), lambda case: case.cosine == 0)
    reaches(rational_refractions(), lambda case: case.g == 0 and case.cosine != 0)


def test_rational_frames_are_right_handed_and_reach_more_than_the_axes() -> None:
    reaches(rational_frames(), lambda frame: all(part not in {0, 1, -1} for axis in frame for part in axis))
    reaches(rational_frames(), lambda frame: cross(frame[0], frame[1]) == frame[2])


@pytest.mark.parametrize(
    "is_the_case",
    [
        pytest.param(lambda ray, box: touches(ray, box, 1e9), id="touched"),
        pytest.param(lambda ray, box: not touches(ray, box, 1e9), id="missed"),
        pytest.param(lambda ray, box: touches(ray, box, 1e9) and not touches(ray, box, 1.0), id="touched later"),
        pytest.param(lambda ray, _: 0.0 in ray.direction, id="parallel to a face"),
        pytest.param(lambda ray, box: touches(ray, box, 1e9) and box[0][1] == box[1][1], id="flat box touched"),
    ],
)
def test_rays_near_boxes_reach(is_the_case: Callable[[Any, Any], bool]) -> None:
    reaches(rays_near_boxes(), lambda case: is_the_case(*case))
