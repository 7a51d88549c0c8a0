from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import assume, given, target
from hypothesis import strategies as st

from raytruth.reference_tracer.source.triangle import triangle_distance, triangle_normal
from tests.properties.exact import Exact, bits, cross, dot, exact, gamma, minus, plus, size_of_dot, times
from tests.properties.strategies import (
    AXIS_MAPS,
    CLEAR_OF_EDGES,
    INSIDE,
    SMALL_FRACTIONS,
    STRANGE_VECTORS,
    Corners,
    Fan,
    Ray,
    mapped,
    rays_at_fans,
    rays_near_triangles,
    triangles,
)
from tests.reference_tracer.kernels import exact_kernel, numpy_kernel
from tests.reproduction import note_case

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.properties.strategies import Vector

RATIONAL_VECTORS = st.tuples(SMALL_FRACTIONS, SMALL_FRACTIONS, SMALL_FRACTIONS)


class Meeting:
    """The triangle as seen along the ray, in exact arithmetic, with bounds on what rounding does to each number.

    The areas u, v, w that the ray makes with the edges are turned positive together; t is t times their sum.
    """

    def __init__(self, ray: Ray, corners: Corners) -> None:
        direction, origin = exact(ray.direction), exact(ray.origin)
        last = max(range(3), key=lambda axis: (abs(direction[axis]), axis))
        axes = ((last + 1) % 3, (last + 2) % 3)
        places, doubts, self.depths = [], [], []
        for corner in corners:
            arm = minus(exact(corner), origin)
            moved = [direction[axis] / direction[last] * arm[last] for axis in axes]
            places.append([arm[axis] - part for axis, part in zip(axes, moved, strict=True)])
            # Roundings: the arm and the difference; and on the other side the slope and the product, too.
            doubts.append([gamma(2) * abs(arm[i]) + gamma(4) * abs(part) for i, part in zip(axes, moved, strict=True)])
            self.depths.append(arm[last] / direction[last])
        pairs = ((2, 1), (0, 2), (1, 0))
        areas = [places[i][0] * places[j][1] - places[i][1] * places[j][0] for i, j in pairs]
        self.doubts = [self.area_doubt(places, doubts, i, j) for i, j in pairs]
        sign = -1 if sum(areas) < 0 else 1
        self.u, self.v, self.w = (sign * area for area in areas)
        self.u_doubt = self.doubts[0]
        self.determinant = self.u + self.v + self.w
        self.t = sign * sum(area * depth for area, depth in zip(areas, self.depths, strict=True))
        # Both are computed from the normal, each of whose parts is off by γ(4) of its products' sizes. Seen along the
        # ray, areas are shorter by the direction's longest part.
        a, b, c = map(exact, corners)
        first, second = minus(b, a), minus(c, a)
        off = times(cross_sizes(first, second), gamma(4))
        sizes = plus(absolute(cross(first, second)), off)
        self.determinant_doubt = self.dot_doubt(direction, off, sizes) / abs(direction[last])
        self.t_doubt = self.dot_doubt(minus(a, origin), off, sizes) / abs(direction[last])

    @staticmethod
    def dot_doubt(a: Exact, off: Exact, sizes: Exact) -> Fraction:
        """Of the dot product with the normal; `a` may be a rounded difference."""
        return dot(absolute(a), plus(off, times(sizes, gamma(4))))

    @staticmethod
    def area_doubt(places: list[list[Fraction]], doubts: list[list[Fraction]], i: int, j: int) -> Fraction:
        """Of x·y' - y·x': what the doubts of its factors do to it, and two roundings of each product."""
        doubt = Fraction(0)
        for first, second in ((0, 1), (1, 0)):
            largest = (abs(places[i][first]) + doubts[i][first]) * (abs(places[j][second]) + doubts[j][second])
            doubt += largest * (1 + gamma(2)) - abs(places[i][first] * places[j][second])
        return doubt

    def must_hit(self) -> bool:
        return min(self.u, self.v, self.w) >= 0 and self.t > 0

    def is_certain(self) -> bool:
        """Neither parallel nor through an edge nor starting on the triangle, within rounding."""
        numbers = (self.u, self.v, self.w, self.determinant, self.t)
        doubts = (*self.doubts, self.determinant_doubt, self.t_doubt)
        return all(abs(number) > doubt for number, doubt in zip(numbers, doubts, strict=True))

    def must_miss(self) -> bool:
        """Beside the triangle, or before it, by more than rounding."""
        areas = list(zip((self.u, self.v, self.w), self.doubts, strict=True))
        beside = any(area > doubt for area, doubt in areas) and any(-area > doubt for area, doubt in areas)
        behind = -self.t > self.t_doubt and self.determinant > self.determinant_doubt
        # Signs of depths are not rounded, and the distance is held between the corners'.
        return beside or (behind and min(self.depths) <= 0) or max(self.depths) <= 0


def distance_of(ray: Ray, corners: Corners) -> float:
    note_case(ray=ray, corners=corners)
    return triangle_distance(ray.origin, ray.direction, *corners)


@pytest.mark.clause("TRI-1")
@given(rays_near_triangles(CLEAR_OF_EDGES))
def test_a_ray_hits_exactly_if_exact_barycentric_coordinates_say_so(case: tuple[Ray, Corners]) -> None:
    meeting = Meeting(*case)
    misses = meeting.must_miss()
    assume(misses or (meeting.is_certain() and meeting.must_hit()))
    assert (distance_of(*case) == inf) == misses


@pytest.mark.clause("TRI-1")
@given(rays_near_triangles(INSIDE))
def test_hit_points_lie_ahead_in_the_plane_and_between_the_corners(case: tuple[Ray, Corners]) -> None:
    distance = distance_of(*case)
    assume(distance < inf)
    assert distance > 0
    meeting = Meeting(*case)
    t = Fraction(distance)
    # A corner's depth is rounded twice: the difference and the quotient.
    assert t >= min(meeting.depths) - gamma(2) * abs(min(meeting.depths))
    assert t <= max(meeting.depths) + gamma(2) * abs(max(meeting.depths))
    if meeting.determinant <= meeting.determinant_doubt or not meeting.must_hit():
        return  # the plane may be met anywhere
    # With T' and D' computed, t = T'/D'·(1 + δ): |t - T/D|·|D'| <= |T' - T| + T/D·|D' - D| + u·|T'|. Held between the
    # rounded depths, t does not go away from T/D, which is between the depths, but for their γ(2).
    ideal = meeting.t / meeting.determinant
    doubt = meeting.t_doubt + ideal * meeting.determinant_doubt + gamma(1) * (meeting.t + meeting.t_doubt)
    allowed = doubt / (meeting.determinant - meeting.determinant_doubt) + gamma(2) * max(map(abs, meeting.depths))
    target(bits(abs(t - ideal), ideal))
    assert abs(t - ideal) <= allowed


@pytest.mark.clause("TRI-3")
@given(rays_near_triangles())
def test_both_windings_are_hit_at_the_same_distance(case: tuple[Ray, Corners]) -> None:
    # Every product, and the sum of two, only changes its sign, which does not round: so the same rays hit. Only where
    # the plane's determinant is 0 by rounding, sums of three numbers come in another order.
    ray, (a, b, c) = case
    distance, other = distance_of(ray, (a, b, c)), distance_of(ray, (a, c, b))
    if distance != other:
        # Both are means of the corners' depths with weights of one sign: γ(3) of the sum, γ(2) of the weights' sum and
        # the quotient, of depths that are off by γ(2).
        depths = Meeting(ray, (a, b, c)).depths
        assert abs(Fraction(distance) - Fraction(other)) <= 2 * gamma(8) * max(map(abs, depths))


@pytest.mark.clause("TRAV-5")
@given(rays_near_triangles(), AXIS_MAPS, st.sampled_from([-20, -3, 1, 20]))
def test_mirrored_and_scaled_scenes_give_the_same_bits(
    case: tuple[Ray, Corners], axis_map: tuple[tuple[int, ...], tuple[int, ...]], power: int
) -> None:
    ray, corners = case
    signs = ((0, 1, 2), axis_map[1])
    scale = 2.0**power
    points = [mapped((p[0] * scale, p[1] * scale, p[2] * scale), signs) for p in (ray.origin, *corners)]
    image = triangle_distance(points[0], mapped(ray.direction, signs), points[1], points[2], points[3])
    assert image == distance_of(ray, corners) * scale


@pytest.mark.clause("TRI-1")
@given(rays_near_triangles(), AXIS_MAPS)
def test_in_exact_arithmetic_turned_scenes_and_turned_corners_give_the_same_distance(
    case: tuple[Ray, Corners], axis_map: tuple[tuple[int, ...], tuple[int, ...]]
) -> None:
    ray, corners = case
    kernel = exact_kernel()
    a, b, c = map(exact, corners)
    origin, direction = exact(ray.origin), exact(ray.direction)
    distance = kernel.triangle_distance(origin, direction, a, b, c)
    meeting = Meeting(*case)
    assert (distance < inf) == (meeting.must_hit() and meeting.determinant > 0)
    for order in ((b, c, a), (c, a, b), (a, c, b)):
        assert kernel.triangle_distance(origin, direction, *order) == distance
    turned = [mapped(vector, axis_map) for vector in (origin, direction, a, b, c)]
    assert kernel.triangle_distance(*turned) == distance


@pytest.mark.clause("TRI-1")
@given(RATIONAL_VECTORS, RATIONAL_VECTORS, RATIONAL_VECTORS, RATIONAL_VECTORS, RATIONAL_VECTORS, st.data())
def test_in_exact_arithmetic_a_shared_edge_is_missed_by_no_triangle(
    a: Exact, b: Exact, left: Exact, right: Exact, origin: Exact, data: st.DataObject
) -> None:
    part = data.draw(st.sampled_from([Fraction(0), Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(1, 10**9)]))
    target = plus(a, times(minus(b, a), part))
    direction = minus(target, origin)
    kernel = exact_kernel()
    for corners in ((a, b, left), (b, a, right)):
        normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
        if dot(normal, direction) != 0:
            assert kernel.triangle_distance(origin, direction, *corners) == 1


@pytest.mark.clause("TRI-3")
@given(rays_near_triangles(INSIDE))
def test_a_ray_reversed_behind_the_hit_meets_it_again_in_exact_arithmetic(case: tuple[Ray, Corners]) -> None:
    ray, corners = case
    kernel = exact_kernel()
    origin, direction = exact(ray.origin), exact(ray.direction)
    distance = kernel.triangle_distance(origin, direction, *map(exact, corners))
    assume(distance < inf)
    behind = plus(origin, times(direction, 3 * distance))
    assert kernel.triangle_distance(behind, times(direction, Fraction(-1)), *map(exact, corners)) == 2 * distance


@pytest.mark.clause("TRI-4")
@given(triangles())
def test_normals_are_perpendicular_unit_vectors_on_the_counterclockwise_side(corners: Corners) -> None:
    a, b, c = map(exact, corners)
    area = cross(minus(b, a), minus(c, a))
    first, second = minus(b, a), minus(c, a)
    sizes = cross_sizes(first, second)
    # Each component of the cross product is off by γ(4) of the sizes of its two products; a thin triangle has more
    # error than area, and its normal means nothing.
    doubt = gamma(4) * max(sizes)
    assume(max(map(abs, area)) > 1000 * doubt)
    note_case(corners=corners)
    normal = exact(triangle_normal(*corners))
    # Normalizing: the dot product of positive terms γ(3), the root and the quotient γ(2), squared, and the scaling.
    assert abs(dot(normal, normal) - 1) <= gamma(9)
    assert dot(normal, area) > 0
    longest = max(map(abs, area))
    for edge in (first, second):
        # The rounded cross product c has |edge·c| <= doubt·Σ|edge_i|, and |c| >= longest - doubt.
        assert abs(dot(normal, edge)) <= doubt * sum(map(abs, edge)) / (longest - doubt) + gamma(3) * size_of_dot(
            normal, edge
        )


def absolute(a: Exact) -> Exact:
    return abs(a[0]), abs(a[1]), abs(a[2])


def cross_sizes(a: Exact, b: Exact) -> Exact:
    """The sizes of the two products of each part of a × b."""
    (a0, a1, a2), (b0, b1, b2) = map(abs, a), map(abs, b)
    return a1 * b2 + a2 * b1, a2 * b0 + a0 * b2, a0 * b1 + a1 * b0


@pytest.mark.clause("TRI-1")
@pytest.mark.parametrize("number", [np.float64, np.float32])
@given(case=rays_at_fans())
def test_no_ray_passes_between_triangles_that_share_an_edge_or_a_corner(
    number: Callable[[float], Any], case: tuple[Ray, Fan]
) -> None:
    ray, fan = case
    note_case(ray=ray, fan=fan)
    origin, direction, hub, *rim = (tuple(map(number, vector)) for vector in (*ray, *fan))
    kernel = numpy_kernel(number)
    distances = [kernel.triangle_distance(origin, direction, hub, one, other) for one, other in pairwise(rim)]
    assert min(distances) < inf


@pytest.mark.clause("NUM-2", "TRI-1")
@given(STRANGE_VECTORS, STRANGE_VECTORS, st.tuples(STRANGE_VECTORS, STRANGE_VECTORS, STRANGE_VECTORS))
def test_whatever_the_numbers_are_the_distance_is_positive(origin: Vector, direction: Vector, corners: Corners) -> None:
    note_case(origin=origin, direction=direction, corners=corners)
    numbers = [tuple(map(np.float64, vector)) for vector in (origin, direction, *corners)]
    with np.errstate(all="ignore"):
        assert numpy_kernel(np.float64).triangle_distance(*numbers) > 0
