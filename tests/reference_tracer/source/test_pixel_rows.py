from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import first_hits, prepare, render
from tests.reference_tracer.kernels import EXACT
from tests.reference_tracer.small_scenes import small_scene, square

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

# A board of one-unit squares behind an orthographic window of 4 × 4 units.
BOARD = {"emission": {"radiance": {"checkerboard": {"even": (1.0,) * 3, "odd": (0.0,) * 3, "plane": "xy"}}}}


def board(width: int, height: int) -> Scene:
    return small_scene(
        width=width, height=height, extent=4.0, materials={"board": BOARD}, objects=[square("board", 0.0)]
    )


@pytest.mark.clause("IMG-1")
def test_rays_go_through_the_centres_of_pixels() -> None:
    image = render(board(4, 4), EXACT)[:, :, 0]
    columns, rows = np.meshgrid(np.arange(4), np.arange(4))
    # The top left square is x in [-2, -1], y in [1, 2]: floor(x) + floor(y) = -1, odd.
    assert (image == (columns + rows) % 2).all()


@pytest.mark.clause("IMG-2")
def test_a_pixel_is_the_mean_over_a_regular_grid_of_samples() -> None:
    one_pixel = board(1, 1)
    assert render(one_pixel, EXACT, samples=4)[0, 0, 0] == Fraction(1, 2)
    for samples in (2, 3):
        x = [Fraction(4 * (2 * i + 1), 2 * samples) - 2 for i in range(samples)]
        expected = Fraction(sum((u // 1 + v // 1) % 2 == 0 for u in x for v in x), samples**2)
        image = render(one_pixel, EXACT, samples=samples)
        assert image[0, 0, 0] == expected


@pytest.mark.clause("ARI-8")
def test_rows_that_are_not_asked_for_are_left_alone() -> None:
    prepared = prepare(board(3, 4), FLOAT)
    image = np.full((4, 3, 3), np.nan)
    prepared.kernel.render_rows(prepared.data, 1, 1, 3, image)
    assert np.isfinite(image[1:3]).all()
    assert np.isnan(image[[0, 3]]).all()


@pytest.mark.clause("IMG-4")
def test_first_hits_are_distances_and_numbers_of_primitives() -> None:
    scene = small_scene(width=3, height=1, extent=1.0, camera={"position": (0.5, 0.0, 5.0), "look_at": (0.5, 0.0, 0.0)})
    prepared = prepare(scene, FLOAT)
    depths, primitives = np.zeros((1, 3)), np.zeros((1, 3), dtype=np.int64)
    prepared.kernel.first_hit_rows(prepared.data, 0, 1, depths, primitives)
    assert primitives.tolist() == [[0, 0, -1]]  # the rays pass the centre at -0.5, 0.5 and 1.5
    assert depths[0, 0] == depths[0, 1]
    assert depths[0, 2] == np.inf


@pytest.mark.clause("IMG-4", "CAM-2")
def test_first_hits_are_those_of_rays_through_the_centres_of_pixels() -> None:
    # The plane z = x + 2y, on which every pixel of four columns and three rows has a distance of its own.
    corners = [(x, y, x + 2 * y) for x, y in ((-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0))]
    slope = {"shape": "mesh", "vertices": corners, "faces": ((0, 1, 2), (0, 2, 3)), "material": "white"}
    scene = small_scene(width=4, height=3, extent=3.0, camera={"position": (0.0, 0.0, 64.0)}, objects=[slope])
    depths, _ = first_hits(prepare(scene, EXACT))
    columns, rows = np.meshgrid(np.arange(4), np.arange(3))
    x, y = columns + Fraction(1, 2) - 2, Fraction(3, 2) - (rows + Fraction(1, 2))
    assert (depths == 64 - (x + 2 * y)).all()
