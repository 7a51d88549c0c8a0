from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.noise import pixel_areas
from raytruth.comparisons.noise.pixel_areas import area_means, enlarged, largest_displacement
from raytruth.reference_tracer.rendering import primary_rays, render
from tests.reference_tracer.small_scenes import library_scene, small_scene, sphere, square

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2")

LAMP = {"emission": {"radiance": (1.0, 0.5, 0.25)}}


def half_plane(edge: float) -> Scene:
    """One pixel of 4 x 4 units, of which everything left of `edge` shines."""
    board = square("lamp", 0.0)
    board["vertices"] = tuple((min(x, edge), y, z) for x, y, z in board["vertices"])
    return small_scene(width=3, height=3, extent=12.0, materials={"lamp": LAMP}, objects=[board])


@pytest.mark.parametrize("edge", [-1.7, -0.001, 0.0, 0.4, 1.9])
def test_the_interval_of_an_edge_holds_the_part_of_the_area_that_it_covers(edge: float) -> None:
    low, high = area_means(half_plane(edge))
    covered = (edge + 2) / 4
    for channel, radiance in enumerate(LAMP["emission"]["radiance"]):
        assert low[1, 1, channel] <= covered * radiance <= high[1, 1, channel]
        assert high[1, 1, channel] - low[1, 1, channel] < 0.01  # of a step of at most 1
    assert (low[1, 0] == high[1, 0]).all()
    assert not high[1, 2].any()


def test_the_interval_holds_the_mean_over_a_finer_grid_and_over_a_displaced_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(pixel_areas, "POINTS", 48 * 36 * 10**2)  # cells of a tenth of a pixel
    scene = library_scene("sphere-over-floor", 48, 36)
    low, high = area_means(scene)
    fine = render(scene, samples=40)
    assert ((low - 1e-12 <= fine) & (fine <= high + 1e-12)).all()
    assert (high - low).mean() < 0.1 * fine.mean()
    points = render(enlarged(scene, 40))
    moved = np.roll(points, 2, axis=1).reshape(36, 40, 48, 40, 3).mean(axis=(1, 3))  # by half a cell
    inner = np.s_[:, 1:]
    assert (np.abs(moved - fine).max(axis=2) > 0.001).any()
    assert ((low - 1e-12 <= moved) & (moved <= high + 1e-12))[inner].all()


def test_an_enlarged_scene_is_the_same_view() -> None:
    scene = library_scene("single-sphere", 4, 3)
    large = enlarged(scene, 3)
    assert (large.camera.width, large.camera.height) == (12, 9)
    # With an odd factor the middle one of the rays through a pixel is the one through its centre.
    np.testing.assert_allclose(primary_rays(large)[1][1::3, 1::3], primary_rays(scene)[1], atol=1e-15)


@pytest.mark.parametrize("size", [1e-4, 1e-2, 1.0, 1e4])
def test_an_offset_is_counted_in_half_cells_of_what_is_seen(size: float) -> None:
    scene = small_scene(
        projection="perspective",
        width=9,
        height=9,
        extent=20.0,
        camera={"position": (0.0, 0.0, 4 * size)},
        materials={"lamp": LAMP},
        objects=[sphere("lamp", radius=size)],
    )
    points_a_side = math.isqrt(pixel_areas.POINTS // 81)
    half_cell = 3 * size * math.tan(math.radians(10.0)) / (9 * points_a_side)
    absolute = largest_displacement(scene, RayOffset(absolute=half_cell))
    assert absolute == pytest.approx(1.0)  # at the nearest point, which the middle pixel sees
    assert largest_displacement(scene, RayOffset(relative=half_cell / size)) == pytest.approx(absolute)
    assert largest_displacement(scene, RayOffset(absolute=10 * half_cell)) == pytest.approx(10 * absolute)
    assert largest_displacement(scene, RayOffset()) == 0.0
