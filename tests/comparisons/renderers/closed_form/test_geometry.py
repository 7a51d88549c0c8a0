import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.records.renderings import Rays
from raytruth.comparisons.renderers.closed_form.geometry import intersect_plane, intersect_sphere, intersect_triangle

pytestmark = pytest.mark.clause("REN-6")

COORDINATES = st.tuples(*[st.floats(-4, 4)] * 3)
DIRECTIONS = COORDINATES.filter(lambda vector: np.linalg.norm(vector) > 0.1)
# Coordinates and distances are below 18; a result takes under 2^6 rounded operations.
ROUNDING = 18 * 2**6 * np.finfo(float).eps


def one_ray(origin, direction):
    return Rays(np.array(origin, dtype=float).reshape(1, 1, 3), np.array(direction, dtype=float).reshape(1, 1, 3))


@given(COORDINATES, DIRECTIONS, COORDINATES, st.floats(0.5, 4))
def test_a_sphere_is_hit_where_its_equation_holds_and_nowhere_before(origin, direction, center, radius):
    unit = np.array(direction) / np.linalg.norm(direction)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):  # as the renderer does
        hits = intersect_sphere(one_ray(origin, unit), np.array(center), radius)
    steps = np.linspace(0, 40, 400)  # no point of the sphere is farther than 18 from the origin
    height = np.linalg.norm(np.array(origin) + steps[:, None] * unit - center, axis=-1) - radius
    side = np.where(abs(height) <= ROUNDING, 0, np.sign(height))
    if not hits.is_hit[0, 0]:
        assert np.all(side >= 0)
        return
    distance, normal, outward = hits.distance[0, 0], hits.normal[0, 0], 1 if hits.is_front[0, 0] else -1
    assert distance > 0
    assert np.all(outward * side[steps < distance] >= 0)
    # The squares agree even where the ray grazes and the distance itself is badly conditioned.
    to_position = hits.position[0, 0] - center
    assert abs(to_position @ to_position - radius**2) < 10 * ROUNDING
    assert abs(np.linalg.norm(normal) - 1) < ROUNDING
    assert abs(normal @ to_position - radius) < 10 * ROUNDING
    assert outward * (normal @ unit) <= ROUNDING


@given(
    st.lists(st.tuples(*[st.integers(-8, 8)] * 3), min_size=3, max_size=3),
    st.tuples(*[st.integers(-8, 8)] * 3),
    st.tuples(*[st.integers(-8, 8)] * 3).filter(any),
)
def test_triangles_on_an_integer_grid_are_hit_exactly_where_barycentric_coordinates_say(vertices, origin, direction):
    # Directions are left unnormalised: in integers every sign is exact, ties on edges included.
    v0, v1, v2, start, ahead = (np.array(vector, dtype=np.int64) for vector in (*vertices, origin, direction))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):  # as the renderer does
        hits = intersect_triangle(one_ray(start, ahead), np.array(vertices, dtype=float))
    # Cramer's rule for start + t·ahead = v0 + b·(v1 - v0) + c·(v2 - v0), every term times the determinant.
    columns = (-ahead, v1 - v0, v2 - v0)

    def determinant(first, second, third):
        return int(first @ np.cross(second, third))

    whole = determinant(*columns)
    sign = 1 if whole > 0 else -1
    t = sign * determinant(start - v0, columns[1], columns[2])
    b = sign * determinant(columns[0], start - v0, columns[2])
    c = sign * determinant(columns[0], columns[1], start - v0)
    is_hit = whole != 0 and t > 0 and b >= 0 and c >= 0 and b + c <= abs(whole)
    assert hits.is_hit[0, 0] == is_hit
    if is_hit:
        np.testing.assert_array_max_ulp(hits.distance[0, 0], np.float64(t / abs(whole)), 1)
        assert hits.is_front[0, 0] == (ahead @ np.cross(v1 - v0, v2 - v0) < 0)


def test_a_triangle_without_area_is_never_hit():
    line = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [2.0, 2.0, 0.0]])
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):  # as the renderer does
        assert not intersect_triangle(one_ray((1, 1, 5), (0, 0, -1)), line).is_hit.any()


@given(
    st.tuples(*[st.integers(-8, 8)] * 3),
    st.tuples(*[st.integers(-8, 8)] * 3).filter(any),
    st.tuples(*[st.integers(-8, 8)] * 3),
    st.sampled_from([(0, 0, 2), (0, -4, 0), (3, 0, 4), (-2, 6, 3), (2, 3, -6)]),
)
def test_planes_are_hit_exactly_where_their_equation_says(origin, direction, point, normal):
    # Normals of whole length, so that only quotients round.
    start, ahead, place, across = (np.array(vector, dtype=np.int64) for vector in (origin, direction, point, normal))
    height, approach = int((place - start) @ across), int(ahead @ across)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):  # as the renderer does
        hits = intersect_plane(one_ray(start, ahead), place.astype(float), across.astype(float))
    if approach and abs(height) > 0:
        assert hits.is_hit[0, 0] == (height / approach > 0)
    if hits.is_hit[0, 0] and height:
        assert abs(hits.distance[0, 0] - height / approach) < ROUNDING * (1 + height / approach)
        assert hits.is_front[0, 0] == (approach < 0)
        np.testing.assert_allclose(hits.normal[0, 0], across / np.linalg.norm(across), rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("height", [-2.0, 0.0, 2.0])
def test_no_ray_along_a_plane_hits_it(height):
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):  # as the renderer does
        hits = intersect_plane(one_ray((1, height, 5), (3, 0, -4)), np.zeros(3), np.array([0.0, 2.0, 0.0]))
    assert not hits.is_hit.any()
