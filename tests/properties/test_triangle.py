from __future__ import annotations

from fractions import Fraction
from math import inf

from hypothesis import assume, given
from hypothesis import strategies as st

from reference_tracer.triangle import triangle_distance, triangle_normal
from tests.properties.exact import Exact, cross, dot, exact, gamma, minus, permanent, plus, size_of_dot, times
from tests.properties.strategies import (
    AXIS_MAPS,
    INSIDE,
    SMALL_FRACTIONS,
    Corners,
    Ray,
    mapped,
    rays_near_triangles,
    triangles,
)
from tests.reference_tracer.kernels import exact_kernel
from tests.reproduction import note_case

RATIONAL_VECTORS = st.tuples(SMALL_FRACTIONS, SMALL_FRACTIONS, SMALL_FRACTIONS)


class Meeting:
    """Where a ray meets the plane of a triangle, exactly: t, u and v times the determinant, which is turned positive.

    Each is a·(b×c) of vectors that are given or differences of given ones; as many as three are differences, and with a
    product, a difference, a product and two sums there are up to eight roundings: γ(8) of the permanent, which is the
    same product without signs.
    """

    def __init__(self, ray: Ray, corners: Corners) -> None:
        a, b, c = map(exact, corners)
        direction = exact(ray.direction)
        first, second, arm = minus(b, a), minus(c, a), minus(exact(ray.origin), a)
        determinant = -dot(direction, cross(first, second))
        sign = -1 if determinant < 0 else 1
        self.determinant = sign * determinant
        self.u = sign * dot(second, cross(arm, direction))
        self.v = -sign * dot(first, cross(arm, direction))
        self.t = sign * dot(arm, cross(first, second))
        self.determinant_doubt = gamma(8) * permanent(direction, first, second)
        self.u_doubt = gamma(8) * permanent(second, arm, direction)
        self.v_doubt = gamma(8) * permanent(first, arm, direction)
        self.t_doubt = gamma(8) * permanent(arm, first, second)

    def must_hit(self) -> bool:
        return self.u >= 0 and self.v >= 0 and self.u + self.v <= self.determinant and self.t > 0

    def is_certain(self) -> bool:
        """Neither parallel nor through an edge nor starting on the triangle, within rounding."""
        rest = abs(self.determinant - self.u - self.v)
        return (
            self.determinant > self.determinant_doubt
            and abs(self.u) > self.u_doubt
            and abs(self.v) > self.v_doubt
            and abs(self.t) > self.t_doubt
            and rest > 2 * (self.u_doubt + self.v_doubt + self.determinant_doubt)
        )


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
    # t = T/D is rounded once: |t·D - T| <= |t|·(doubt of D) + (doubt of T) + u·(|T| + its doubt).
    t = Fraction(distance)
    permanent_of_t = meeting.t_doubt / gamma(8)
    assert abs(t * meeting.determinant - meeting.t) <= t * meeting.determinant_doubt + gamma(10) * permanent_of_t


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
