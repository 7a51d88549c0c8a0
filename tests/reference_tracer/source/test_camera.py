from __future__ import annotations

from math import radians, tan
from typing import TYPE_CHECKING

import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import prepare
from tests.reference_tracer.small_scenes import small_scene

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene


def rays(scene: Scene) -> list[list[tuple[tuple[float, float, float], tuple[float, float, float]]]]:
    prepared = prepare(scene, FLOAT)
    frame = prepared.kernel.camera_frame(prepared.data)
    camera = scene.camera
    return [
        [prepared.kernel.primary_ray(frame, x + 0.5, y + 0.5) for x in range(camera.width)]
        for y in range(camera.height)
    ]


@pytest.mark.clause("CAM-3", "CAM-4")
@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_the_central_pixel_looks_at_the_point_that_is_looked_at(projection: str) -> None:
    origin, direction = rays(small_scene(projection=projection, width=3, height=5))[2][1]
    assert origin == (0.0, 0.0, 5.0)
    assert direction == (0.0, 0.0, -1.0)


@pytest.mark.clause("CAM-1", "CAM-2")
@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_x_grows_right_and_y_grows_down(projection: str) -> None:
    image = rays(small_scene(projection=projection, width=4, height=4))
    origin, direction = image[0][0]
    # The top left pixel, for a camera that looks along -z with +y up, sees -x and +y.
    reached = (origin[0] + direction[0], origin[1] + direction[1])
    assert reached[0] < 0 < reached[1]


@pytest.mark.clause("CAM-2", "CAM-3")
def test_the_field_of_view_is_the_vertical_one_and_pixels_are_square() -> None:
    image = rays(small_scene(projection="perspective", width=7, height=5, extent=60.0))
    slope = tan(radians(30)) * (
        1 - 1 / 5
    )  # of the top row's centres; 2^-48 is 32 roundings, twice what both sides have
    _, top = image[0][3]
    assert top[1] / -top[2] == pytest.approx(slope, rel=2**-48)
    _, side = image[2][3 + 2]
    assert side[0] / -side[2] == pytest.approx(slope, rel=2**-48)  # two pixels from the centre, as the top row is


@pytest.mark.clause("CAM-4")
def test_the_view_height_is_the_height_of_what_an_orthographic_camera_sees() -> None:
    image = rays(small_scene(projection="orthographic", width=2, height=4, extent=8.0))
    assert [row[0][0][1] for row in image] == [3.0, 1.0, -1.0, -3.0]
    assert [ray[0][0] for ray in image[0]] == [-1.0, 1.0]
    assert {ray[1] for row in image for ray in row} == {(0.0, 0.0, -1.0)}
