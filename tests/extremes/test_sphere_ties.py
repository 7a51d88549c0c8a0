"""Exact ties of spheres: tangent rays, lights and cameras on a sphere. Worked out as test_ties.py has it."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.extremes.exact_pixels import cross, dot, exact_pixel, holds_root, sphere_hides_from_outside
from tests.extremes.placed_scenes import (
    AXES,
    GREY,
    PLACES,
    QUARTERS,
    ROUND_POINTS,
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

PIXELS = st.integers(0, SIDE - 1)


@pytest.mark.clause("SHAD-1", "SHAD-4", "SPH-1", "SPH-2")
@given(PLACES, st.sampled_from(ROUND_POINTS), QUARTERS, QUARTERS, PIXELS, PIXELS)
def test_a_light_on_a_sphere_is_hidden_if_the_sphere_stands_before_it(
    place: Place, round_point: tuple[Point, int], x: float, y: float, column: int, row: int
) -> None:
    offset, radius = round_point
    center = (x, y, radius + 1.0)
    light = tuple(c + o for c, o in zip(center, offset, strict=True))
    floor = [place(-9.0, -9.0, 0.0), place(9.0, -9.0, 0.0), place(9.0, 9.0, 0.0), place(-9.0, 9.0, 0.0)]
    objects = [
        {"shape": "mesh", "vertices": floor, "faces": ((0, 1, 2), (0, 2, 3)), "material": "grey"},
        {"shape": "sphere", "center": place(*center), "radius": radius * place.size, "material": "grey"},
    ]
    camera = looking_down(place, 0.0, 0.0, height=0.5)  # under the sphere
    pixel = exact_pixel(scene(camera, objects, {"grey": WHITE}, lights=[lamp(place(*light))]), column, row)
    point = seen_point(0.0, 0.0, column, row)
    hidden = sphere_hides_from_outside(center, Fraction(radius), point, light)
    note_case(place=place, center=center, radius=radius, light=light, point=point, hidden=hidden, pixel=pixel.middle)
    assert holds_root(pixel, Fraction(0) if hidden else lit_square(point, light))


@pytest.mark.clause("SHAD-1", "SHAD-4", "SPH-4")
@given(PLACES, st.sampled_from(ROUND_POINTS), st.sampled_from([40.0, 60.0, 90.0]), PIXELS, PIXELS)
def test_a_light_on_a_sphere_is_seen_from_everywhere_inside(
    place: Place, round_point: tuple[Point, int], angle: float, column: int, row: int
) -> None:
    light, radius = round_point
    ball = {"shape": "sphere", "center": (0.0, 0.0, 0.0), "radius": radius * place.size, "material": "grey"}
    camera = looking_down(place, 0.0, 0.0, height=0.0, perspective=True) | {"vertical_field_of_view": angle}
    pixel = exact_pixel(scene(camera, [ball], {"grey": WHITE}, lights=[lamp(place(*light))]), column, row)
    with mpmath.workprec(200):
        step = 2 * mpmath.tan(mpmath.radians(angle) / 2) / SIDE
        direction = ((column - SIDE // 2) * step, (SIDE // 2 - row) * step, mpmath.mpf(-1))
        length = mpmath.sqrt(sum(part * part for part in direction))
        chord = mpmath.sqrt(sum((li - radius * part / length) ** 2 for li, part in zip(light, direction, strict=True)))
        value = GREY * chord / (2 * radius)  # the cosine at either end of a chord
        note_case(place=place, light=light, angle=angle, column=column, row=row, pixel=pixel.middle, value=float(value))
        assert abs(value - pixel.middle[0]) <= pixel.radius[0] + mpmath.mpf(2) ** -190
        assert pixel.radius[0] <= 2.0**-53


@pytest.mark.clause("SPH-2")
@given(
    PLACES,
    st.sampled_from(TRIPLES),
    st.integers(1, 9),
    st.sampled_from([1, 2, 3, 7, -1, -5]),
    st.sampled_from([1.0, 1.0 - 2.0**-53, 1.0 + 2.0**-52]),
    st.booleans(),
)
def test_a_ray_exactly_tangent_to_a_sphere_hits_and_one_beside_it_misses(
    place: Place, triple: tuple[int, int, int], far: int, beside: int, factor: float, perspective: bool
) -> None:
    p, q, length = triple
    center = (far * p - beside * q, far * q + beside * p, 0)
    radius = abs(beside) * length * factor * place.size
    camera = looking_down(place, 0.0, 0.0, height=0.0, perspective=perspective)
    camera |= {"position": (0.0, 0.0, 0.0), "look_at": place(p, q, 0), "up": place(0, 0, 1)}
    ball = {"shape": "sphere", "center": place(*center), "radius": radius, "material": "shining"}
    pixel = exact_pixel(scene(camera, [ball], {"shining": SHINING}), SIDE // 2, SIDE // 2)
    note_case(place=place, triple=triple, center=center, radius=radius, pixel=pixel.middle)
    assert pixel.middle == (SKY if factor < 1 else SHINING["emission"]["radiance"])


@pytest.mark.clause("SPH-3")
@given(PLACES, st.sampled_from(ROUND_POINTS), st.sampled_from(ROUND_POINTS))
def test_a_camera_exactly_on_a_sphere_sees_the_far_side_or_nothing_of_it(
    place: Place, start: tuple[Point, int], toward: tuple[Point, int]
) -> None:
    offset, radius = start
    direction, _ = toward
    up = next(axis for axis in AXES if any(cross(axis, direction)))
    camera = looking_down(place, 0.0, 0.0) | {
        "position": place(*offset),
        "look_at": place(*(o + d for o, d in zip(offset, direction, strict=True))),
        "up": place(*up),
    }
    ball = {"shape": "sphere", "center": (0.0, 0.0, 0.0), "radius": radius * place.size, "material": "shining"}
    pixel = exact_pixel(scene(camera, [ball], {"shining": SHINING}), SIDE // 2, SIDE // 2)
    inward = dot(offset, direction) < 0
    note_case(place=place, offset=offset, direction=direction, pixel=pixel.middle)
    assert pixel.middle == (SHINING["emission"]["radiance"] if inward else SKY)
