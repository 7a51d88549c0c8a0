from __future__ import annotations

from math import inf, nan

import pytest

from raytruth.reference_tracer.source.plane import plane_distance, plane_normal

FLOOR = ((7.0, 1.0, 7.0), (0.0, 2.0, 0.0))


@pytest.mark.clause("PLANE-1")
def test_the_worked_example_of_the_specification_holds() -> None:
    assert plane_distance((0.0, 3.0, 0.0), (0.0, -0.6, 0.8), *FLOOR) == pytest.approx(10 / 3, rel=2**-51)


@pytest.mark.clause("PLANE-1", "PLANE-3")
@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("length", [1.0, -1.0, 8.0, 2.0**-40])
def test_planes_across_every_axis_are_met_from_both_sides(axis: int, side: float, length: float) -> None:
    def turned(x: float, y: float, z: float) -> tuple[float, float, float]:
        return ((z, x, y), (y, z, x), (x, y, z))[axis]

    stated = (turned(5.0, -3.0, 1.0), turned(0.0, 0.0, length))
    assert plane_distance(turned(0.25, 0.5, 1.0 + 2.0 * side), turned(0.5, 0.5, -side), *stated) == 2.0
    assert plane_distance(turned(0.25, 0.5, 1.0 + 2.0 * side), turned(0.5, 0.5, side), *stated) == inf


@pytest.mark.clause("PLANE-2")
@pytest.mark.parametrize("height", [1.0, 0.0, -1.0])
def test_a_parallel_ray_misses_also_within_the_plane(height: float) -> None:
    for direction in ((1.0, 0.0, 0.0), (0.6, 0.0, -0.8), (-0.6, -0.0, 0.8)):
        assert plane_distance((0.0, 1.0 + height, 0.0), direction, *FLOOR) == inf


@pytest.mark.clause("PLANE-2")
@pytest.mark.parametrize("sine", [1e-3, 1e-15, 1e-150, -1e-150, -1e-15])
def test_a_ray_off_the_parallel_by_any_amount_meets_the_plane_if_it_goes_there(sine: float) -> None:
    expected = pytest.approx(3.0 / sine, rel=1e-15) if sine > 0.0 else inf
    assert plane_distance((0.0, 4.0, 0.0), (1.0, -sine, 0.0), *FLOOR) == expected


@pytest.mark.clause("PLANE-3")
@pytest.mark.parametrize("direction", [(0.0, 1.0, 0.0), (0.6, -0.8, 0.0), (1.0, 0.0, 0.0)])
def test_a_ray_that_starts_on_the_plane_does_not_meet_it(direction: tuple[float, float, float]) -> None:
    assert plane_distance((4.0, 1.0, -2.0), direction, *FLOOR) == inf


@pytest.mark.clause("TRAV-5")
@pytest.mark.parametrize("scale", [2.0**-300, 1.0, 2.0**300])
def test_no_scale_is_too_small(scale: float) -> None:
    assert plane_distance((0.0, scale, 0.0), (0.0, -1.0, 0.0), (scale, 0.0, 0.0), (0.0, 1.0, 0.0)) == scale


@pytest.mark.clause("NUM-2")
@pytest.mark.parametrize("place", range(12))
def test_what_is_not_a_number_is_never_met(place: int) -> None:
    numbers = [0.5, 3.0, 0.1, 0.2, -1.0, 0.1, 7.0, 1.0, 7.0, 0.3, 2.0, 0.1]
    numbers[place] = nan
    origin, direction, point, normal = (tuple(numbers[i : i + 3]) for i in range(0, 12, 3))
    assert plane_distance(origin, direction, point, normal) == inf  # type: ignore[arg-type] - they are three each


@pytest.mark.clause("PLANE-4")
def test_the_normal_is_the_stated_one_as_a_unit_vector() -> None:
    assert plane_normal((0.0, 2.0, 0.0)) == (0.0, 1.0, 0.0)
    assert plane_normal((0.0, 0.0, -(2.0**-30))) == (0.0, 0.0, -1.0)
    assert plane_normal((3.0, 0.0, 4.0)) == pytest.approx((0.6, 0.0, 0.8), rel=2**-51)
