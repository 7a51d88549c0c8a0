"""Exact ties: each pixel has the one value that the specification says, worked out here apart in fractions.

Scenes are drawn so that rays meet edges, corners, borders, critical angles and lights exactly, along all axes and on
all scales, in numbers that floats hold; those of spheres are in test_sphere_ties.py.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.extremes.exact_pixels import cross, exact_pixel, holds_root, minus, triangle_hides
from tests.extremes.placed_scenes import (
    PLACES,
    QUARTERS,
    SHINING,
    SIDE,
    SKY,
    TRIPLES,
    WHITE,
    lamp,
    lit_square,
    looking_down,
    scene,
    seen_point,
)
from tests.reproduction import note_case

if TYPE_CHECKING:
    from tests.extremes.placed_scenes import Place, Point


def tiled_floor(place: Place, diagonals: int) -> dict[str, Any]:
    """The square from -2 to 2, in sixteen squares of two triangles, with diagonals as the bits say."""
    vertices = [place(x - 2.0, y - 2.0, 0.0) for y in range(5) for x in range(5)]
    faces: list[tuple[int, int, int]] = []
    for cell in range(16):
        a = cell // 4 * 5 + cell % 4
        b, c, d = a + 1, a + 6, a + 5
        faces += [(a, b, c), (a, c, d)] if diagonals >> cell & 1 else [(a, b, d), (d, b, c)]
    return {"shape": "mesh", "vertices": vertices, "faces": faces, "material": "grey"}


FRACTIONS = st.sampled_from([0.0, 0.25, 0.5])
PIXELS = st.integers(0, SIDE - 1)


@pytest.mark.clause("TRI-1", "TRI-3", "SHAD-1", "SHAD-6", "ILL-9", "TRAV-5")
@given(
    PLACES,
    FRACTIONS,
    FRACTIONS,
    PIXELS,
    PIXELS,
    st.tuples(QUARTERS, QUARTERS, QUARTERS),
    st.integers(0, 2**16 - 1),
    st.booleans(),
)
def test_no_ray_passes_a_shared_edge_or_corner_and_no_coplanar_neighbour_hides_a_light(
    place: Place, x: float, y: float, column: int, row: int, light: Point, diagonals: int, perspective: bool
) -> None:
    camera = looking_down(place, x, y, perspective=perspective)
    pixel = exact_pixel(
        scene(camera, [tiled_floor(place, diagonals)], {"grey": WHITE}, lights=[lamp(place(*light))]), column, row
    )
    point = seen_point(x, y, column, row)
    note_case(place=place, point=point, light=light, diagonals=diagonals, perspective=perspective, pixel=pixel.middle)
    if max(abs(point[0]), abs(point[1])) > 2:
        assert pixel.middle == SKY
    else:
        assert holds_root(pixel, lit_square(point, light))


@pytest.mark.clause("TEX-1", "TEX-2")
@given(
    PLACES, FRACTIONS, FRACTIONS, PIXELS, PIXELS, st.sampled_from([0.5, 1.0, 1.5]), QUARTERS, QUARTERS, st.booleans()
)
def test_a_point_on_the_border_of_squares_belongs_to_that_of_larger_coordinate(
    place: Place, x: float, y: float, column: int, row: int, size: float, u: float, v: float, perspective: bool
) -> None:
    across = [axis for axis in range(3) if place.axes[2][axis] == 0]
    board = {
        "even": (1.0, 0.0, 0.0),
        "odd": (0.0, 1.0, 0.0),
        "size": size * place.size,
        "plane": "".join("xyz"[axis] for axis in across),
        "offset": (u * place.size, v * place.size),
    }
    material = {"emission": {"radiance": {"checkerboard": board}}}
    camera = looking_down(place, x, y, perspective=perspective)
    pixel = exact_pixel(scene(camera, [tiled_floor(place, 0)], {"grey": material}), column, row)
    point = seen_point(x, y, column, row)
    assume(max(abs(point[0]), abs(point[1])) <= 2)
    note_case(place=place, point=point, board=board, pixel=pixel.middle)
    world = [Fraction(part) / Fraction(place.size) for part in place(*point)]
    number = sum(
        ((world[axis] - Fraction(o)) / Fraction(size)).__floor__() for axis, o in zip(across, (u, v), strict=True)
    )
    assert pixel.middle == (board["odd"] if number % 2 else board["even"])


@pytest.mark.clause("SHAD-1", "SHAD-4", "TRI-1", "TRI-2")
@given(
    PLACES,
    st.lists(st.tuples(*[st.integers(-4, 4)] * 2, st.integers(1, 5)), min_size=4, max_size=4),
    st.sampled_from([0.0, 0.25, 0.5, 1.0]),
    st.sampled_from([0.0, 0.25, 0.5]),
    PIXELS,
    PIXELS,
)
def test_a_light_at_a_corner_on_an_edge_or_in_a_triangle_is_hidden_by_what_stands_before_it_alone(
    place: Place, corners: list[Point], u: float, v: float, column: int, row: int
) -> None:
    a, b, c, d = corners
    triangles = [(a, b, c), (b, a, d)]
    assume(u + v <= 1.0)
    assume(all(any(cross(minus(q, p), minus(r, p))) for p, q, r in triangles))
    light = tuple(p + u * (q - p) + v * (r - p) for p, q, r in zip(a, b, c, strict=True))
    floor = [(-9.0, -9.0, 0.0), (9.0, -9.0, 0.0), (9.0, 9.0, 0.0), (-9.0, 9.0, 0.0)]
    vertices = [place(*corner) for corner in (*floor, *corners)]
    faces = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (5, 4, 7)]
    mesh = {"shape": "mesh", "vertices": vertices, "faces": faces, "material": "grey"}
    camera = looking_down(place, 0.0, 0.0, height=0.5)  # under both triangles
    pixel = exact_pixel(scene(camera, [mesh], {"grey": WHITE}, lights=[lamp(place(*light))]), column, row)
    point = seen_point(0.0, 0.0, column, row)
    hidden = any(triangle_hides(triangle, point, light) for triangle in triangles)
    note_case(place=place, corners=corners, light=light, point=point, hidden=hidden, pixel=pixel.middle)
    assert holds_root(pixel, Fraction(0) if hidden else lit_square(point, light))


@pytest.mark.clause("TRI-2")
@given(PLACES, st.sampled_from(TRIPLES), st.sampled_from([40.0, 90.0]), PIXELS, st.booleans())
def test_a_ray_in_the_plane_of_a_triangle_misses_it(
    place: Place, triple: tuple[int, int, int], angle: float, column: int, perspective: bool
) -> None:
    p, q, _ = triple
    corners = [place(p * s, q * s, t) for s, t in ((-4, -8), (9, -7), (3, 40))]
    wall = {"shape": "triangle", "vertices": corners, "material": "shining"}
    camera = looking_down(place, 0.0, 0.0, perspective=perspective)
    camera |= {"position": place(-9 * p, -9 * q, 1), "look_at": place(0, 0, 1), "up": place(q, -p, 0)}
    if perspective:
        camera["vertical_field_of_view"] = angle
    pixel = exact_pixel(scene(camera, [wall], {"shining": SHINING}), column, SIDE // 2)
    note_case(place=place, triple=triple, angle=angle, column=column, perspective=perspective, pixel=pixel.middle)
    assert pixel.middle == SKY


@pytest.mark.clause("REFR-2", "REFR-5", "REFR-8")
@given(
    PLACES,
    st.sampled_from([(4, 3, 5), (8, 15, 17), (16, 63, 65), (32, 255, 257)]),
    st.sampled_from([1.0, 1.25, 2.0]),
    st.sampled_from(["whitted", "radiometric"]),
    PIXELS,
    PIXELS,
)
def test_at_exactly_the_critical_angle_all_light_is_reflected(
    place: Place, triple: tuple[int, int, int], outside: float, convention: str, column: int, row: int
) -> None:
    along, across, length = triple
    wide = 2.0**12
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    materials = {
        "water": {"dielectric": {"index_of_refraction": outside}},
        "glass": {"dielectric": {"index_of_refraction": outside * length / along, "outside": "water"}},
        "shining": SHINING,
    }
    objects = [
        {
            "shape": "mesh",
            "vertices": [place(wide * x, wide * y, z) for x, y in corners],
            "faces": ((0, 1, 2), (0, 2, 3)),
            "material": name,
        }
        for name, z in (("glass", 0.0), ("shining", -1024.0), ("water", 2048.0))
    ]
    camera = looking_down(place, 0.0, 0.0) | {
        "position": place(-along, 0.0, -across),
        "look_at": (0.0, 0.0, 0.0),
        "view_height": place.size,
        "inside": "glass",
    }
    pixel = exact_pixel(scene(camera, objects, materials, convention=convention, max_depth=2), column, row)
    note_case(place=place, triple=triple, outside=outside, convention=convention, pixel=pixel.middle)
    expected = SHINING["emission"]["radiance"]
    assert pixel.middle == expected
    assert max(pixel.radius) <= 2.0**-53
