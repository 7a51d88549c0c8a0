from __future__ import annotations

from math import inf

import pytest

from raytruth.reference_tracer.source.triangle import longest_axis, triangle_distance, triangle_normal

A, B, C = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
DOWN = (0.0, 0.0, -1.0)


@pytest.mark.clause("TRI-1", "TRI-3")
@pytest.mark.parametrize(
    ("x", "y", "hits"),
    [
        (0.25, 0.25, True),
        (0.0, 0.0, True),  # corners and edges belong to the triangle
        (1.0, 0.0, True),
        (0.0, 1.0, True),
        (0.5, 0.0, True),
        (0.0, 0.5, True),
        (0.5, 0.5, True),
        (-(2.0**-50), 0.5, False),
        (0.5, -(2.0**-50), False),
        (0.5, 0.5 + 2.0**-50, False),
        (1.5, 0.5, False),
    ],
)
@pytest.mark.parametrize("corners", [(A, B, C), (A, C, B), (B, C, A), (C, B, A)])
def test_inside_and_edges_are_hit_from_both_sides(
    corners: tuple[tuple[float, float, float], ...], x: float, y: float, hits: bool
) -> None:
    a, b, c = corners
    assert triangle_distance((x, y, 2.0), DOWN, a, b, c) == (2.0 if hits else inf)
    assert triangle_distance((x, y, -2.0), (0.0, 0.0, 1.0), a, b, c) == (2.0 if hits else inf)


@pytest.mark.clause("TRI-1", "TRI-3")
@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_triangles_across_every_axis_are_hit_from_both_sides(axis: int, side: float) -> None:
    def turned(x: float, y: float, z: float) -> tuple[float, float, float]:
        return ((z, x, y), (y, z, x), (x, y, z))[axis]

    for b, c in ((B, C), (C, B)):
        corners = (turned(*A), turned(*b), turned(*c))
        assert triangle_distance(turned(0.25, 0.25, 2.0 * side), turned(0.0, 0.0, -side), *corners) == 2.0


@pytest.mark.clause("TRI-1")
@pytest.mark.parametrize(
    ("direction", "axis"),
    [
        ((-3.0, 1.0, 2.0), 0),
        ((1.0, -3.0, 2.0), 1),
        ((1.0, 2.0, -3.0), 2),
        ((1.0, -1.0, 0.0), 1),
        ((-1.0, 0.0, 1.0), 2),
        ((0.0, 1.0, -1.0), 2),
        ((1.0, 1.0, 1.0), 2),
    ],
)
def test_of_equally_long_axes_the_last_is_the_longest(direction: tuple[float, float, float], axis: int) -> None:
    assert longest_axis(direction) == axis


@pytest.mark.clause("TRI-1", "TRI-3")
def test_what_lies_behind_or_at_the_origin_is_not_hit() -> None:
    assert triangle_distance((0.25, 0.25, -2.0), DOWN, A, B, C) == inf
    assert triangle_distance((0.25, 0.25, 0.0), DOWN, A, B, C) == inf


@pytest.mark.clause("TRI-2")
def test_a_ray_in_the_plane_and_a_triangle_of_no_area_miss() -> None:
    assert triangle_distance((-1.0, 0.25, 0.0), (1.0, 0.0, 0.0), A, B, C) == inf
    assert triangle_distance((0.5, 0.0, 2.0), DOWN, A, B, (0.5, 0.0, 0.0)) == inf
    assert triangle_distance((0.0, 0.0, 2.0), DOWN, A, A, A) == inf


@pytest.mark.clause("TRAV-5")
@pytest.mark.parametrize("scale", [2.0**-60, 1.0, 2.0**60])
def test_no_scale_is_too_small(scale: float) -> None:
    b, c = (scale, 0.0, 0.0), (0.0, scale, 0.0)
    assert triangle_distance((scale / 4, scale / 4, scale), DOWN, A, b, c) == scale


@pytest.mark.clause("TRI-4")
def test_the_normal_points_to_where_the_corners_run_counterclockwise() -> None:
    assert triangle_normal(A, B, C) == (0.0, 0.0, 1.0)
    assert triangle_normal(A, C, B) == (0.0, 0.0, -1.0)
    assert triangle_normal(B, C, A) == (0.0, 0.0, 1.0)
