from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import inf, nan
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import assume, given, target
from hypothesis import strategies as st

from reference_tracer.triangle import triangle_distance, triangle_normal
from tests.properties.exact import Exact, bits, cross, dot, exact, gamma, minus, plus, size_of_dot, times
from tests.properties.strategies import (
    AXIS_MAPS,
    INSIDE,
    SMALL_FRACTIONS,
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
        places, doubts, depths = [], [], []
        for corner in corners:
            arm = minus(exact(corner), origin)
            moved = [direction[axis] / direction[last] * arm[last] for axis in axes]
            places.append([arm[axis] - part for axis, part in zip(axes, moved, strict=True)])
            # Roundings: the arm and the difference; and on the other side the slope and the product, too.
            doubts.append([gamma(2) * abs(arm[i]) + gamma(4) * abs(part) for i, part in zip(axes, moved, strict=True)])
            depths.append(arm[last])
        pairs = ((2, 1), (0, 2), (1, 0))
        areas = [places[i][0] * places[j][1] - places[i][1] * places[j][0] for i, j in pairs]
        self.doubts = [self.area_doubt(places, doubts, i, j) for i, j in pairs]
        sign = -1 if sum(areas) < 0 else 1
        self.u, self.v, self.w = (sign * area for area in areas)
        self.u_doubt = self.doubts[0]
        self.determinant = self.u + self.v + self.w
        self.t = sign * sum(area * depth for area, depth in zip(areas, depths, strict=True)) / direction[last]
        sizes = [abs(area) + doubt for area, doubt in zip(areas, self.doubts, strict=True)]
        self.determinant_doubt = sum(self.doubts) + gamma(2) * sum(sizes)
        # A depth and its product are rounded, the sum twice, the last quotient once.
        self.t_doubt = sum(
            (doubt + gamma(5) * size) * abs(depth)
            for doubt, size, depth in zip(self.doubts, sizes, depths, strict=True)
        ) / abs(direction[last])

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


def distance_of(ray: Ray, corners: Corners) -> float:
    note_case(ray=ray, corners=corners)
    return triangle_distance(ray.origin, ray.direction, *corners)


@given(rays_near_triangles())
def test_a_ray_hits_exactly_if_exact_barycentric_coordinates_say_so(case: tuple[Ray, Corners]) -> None:
    meeting = Meeting(*case)
    assume(meeting.is_certain())
    assert (distance_of(*case) < inf) == meeting.must_hit()


@given(rays_near_triangles(INSIDE))
def test_hit_points_lie_ahead_in_the_plane(case: tuple[Ray, Corners]) -> None:
    distance = distance_of(*case)
    assume(distance < inf)
    assert distance > 0
    meeting = Meeting(*case)
    # t = T/D is rounded twice: |t·D - T| <= t·(doubt of D) + (doubt of T) + γ(2)·(|T| + its doubt).
    t = Fraction(distance)
    doubt = t * meeting.determinant_doubt + meeting.t_doubt + gamma(2) * (abs(meeting.t) + meeting.t_doubt)
    target(bits(abs(t * meeting.determinant - meeting.t), abs(meeting.t)))
    assert abs(t * meeting.determinant - meeting.t) <= doubt


@given(rays_near_triangles())
def test_both_windings_are_hit_alike(case: tuple[Ray, Corners]) -> None:
    ray, (a, b, c) = case
    meeting = Meeting(ray, (a, b, c))
    assume(meeting.is_certain())
    assert (distance_of(ray, (a, c, b)) < inf) == (distance_of(ray, (a, b, c)) < inf)


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


@given(rays_near_triangles(INSIDE))
def test_a_ray_reversed_behind_the_hit_meets_it_again_in_exact_arithmetic(case: tuple[Ray, Corners]) -> None:
    ray, corners = case
    kernel = exact_kernel()
    origin, direction = exact(ray.origin), exact(ray.direction)
    distance = kernel.triangle_distance(origin, direction, *map(exact, corners))
    assume(distance < inf)
    behind = plus(origin, times(direction, 3 * distance))
    assert kernel.triangle_distance(behind, times(direction, Fraction(-1)), *map(exact, corners)) == 2 * distance


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


def cross_sizes(a: Exact, b: Exact) -> Exact:
    (a0, a1, a2), (b0, b1, b2) = map(abs, a), map(abs, b)
    return a1 * b2 + a2 * b1, a2 * b0 + a0 * b2, a0 * b1 + a1 * b0


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


# With these, squares and products overflow, vanish or are no numbers.
STRANGE = st.sampled_from([0.0, -0.0, 1.0, -2.5, 5e-324, -1e-310, 1e-170, 1e170, -1.7e308, inf, -inf, nan])
STRANGE_VECTORS = st.tuples(STRANGE, STRANGE, STRANGE)


@given(STRANGE_VECTORS, STRANGE_VECTORS, st.tuples(STRANGE_VECTORS, STRANGE_VECTORS, STRANGE_VECTORS))
def test_whatever_the_numbers_are_the_distance_is_positive(origin: Vector, direction: Vector, corners: Corners) -> None:
    note_case(origin=origin, direction=direction, corners=corners)
    numbers = [tuple(map(np.float64, vector)) for vector in (origin, direction, *corners)]
    with np.errstate(all="ignore"):
        assert numpy_kernel(np.float64).triangle_distance(*numbers) > 0
