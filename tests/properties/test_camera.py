from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.source.camera import camera_frame, primary_ray
from raytruth.scenes.features import Feature
from tests.properties.exact import Exact, dot, exact, gamma, minus, plus, times
from tests.properties.strategies import (
    SCALES,
    SMALL_FRACTIONS,
    Vector,
    directions,
    perpendiculars,
    rational_frames,
    vectors,
)
from tests.reference_tracer.kernels import EXACT, scene_data
from tests.reproduction import note_case

HALF_ANGLE_TANGENT = Fraction(3, 4)
SIZES = st.integers(1, 40)


@cache
def kernel_of(projection: str) -> Any:
    """With a known tangent, since an angle in degrees and its tangent are not both rational."""
    functions = {**EXACT.functions, "tan": lambda _: HALF_ANGLE_TANGENT}
    features = {Feature.PERSPECTIVE} if projection == "perspective" else set[Feature]()
    return make_kernel(replace(EXACT, functions=functions), features | {Feature.SPHERES})


def camera(position: Any, look_at: Any, up: Any, extent: Any, width: int, height: int) -> layout.SceneData:
    return scene_data(
        {
            layout.CAMERA_POSITION: [position],
            layout.CAMERA_LOOK_AT: [look_at],
            layout.CAMERA_UP: [up],
            layout.CAMERA_EXTENT: [extent],
            layout.CAMERA_SIZE: [width, height],
        }
    )


@pytest.mark.clause("CAM-2", "CAM-3", "CAM-4")
@given(
    rational_frames(),
    st.tuples(SMALL_FRACTIONS, SMALL_FRACTIONS, SMALL_FRACTIONS),
    st.sampled_from([Fraction(1), Fraction(1, 7), Fraction(1000)]),
    SMALL_FRACTIONS,
    st.tuples(SIZES, SIZES),
    st.sampled_from(["perspective", "orthographic"]),
)
def test_image_coordinates_are_those_of_the_image_plane(
    axes: tuple[Exact, Exact, Exact],
    position: Exact,
    distance: Fraction,
    tilt: Fraction,
    size: tuple[int, int],
    projection: str,
) -> None:
    forward, right, _ = axes
    down = (
        forward[1] * right[2] - forward[2] * right[1],
        forward[2] * right[0] - forward[0] * right[2],
        forward[0] * right[1] - forward[1] * right[0],
    )
    width, height = size
    up = plus(times(down, Fraction(-3)), times(forward, tilt))  # not perpendicular to the view
    extent = Fraction(5, 2)
    scene = camera(position, plus(position, times(forward, distance)), up, extent, width, height)
    kernel = kernel_of(projection)
    frame = kernel.camera_frame(scene)
    visible_height = 2 * HALF_ANGLE_TANGENT if projection == "perspective" else extent
    for x, y in (
        (Fraction(width, 2), Fraction(height, 2)),
        (Fraction(0), Fraction(0)),
        (Fraction(1, 2), Fraction(7, 3)),
    ):
        across = (x - Fraction(width, 2)) * visible_height / height
        below = (y - Fraction(height, 2)) * visible_height / height
        on_plane = plus(times(right, across), times(down, below))
        if projection == "orthographic":
            assert kernel.primary_ray(frame, x, y) == (plus(position, on_plane), forward)
            continue
        origin, corner, pixel_right, pixel_down, ahead = frame
        assert (origin, ahead) == (position, forward)
        assert plus(plus(corner, times(pixel_right, x)), times(pixel_down, y)) == plus(forward, on_plane)


@st.composite
def views(draw: st.DrawFn) -> tuple[layout.SceneData, int, int]:
    scale = draw(SCALES)
    position: Vector = draw(vectors(scale))
    forward = draw(directions())
    up = draw(perpendiculars(forward))
    look_at = (position[0] + scale * forward[0], position[1] + scale * forward[1], position[2] + scale * forward[2])
    width, height = draw(SIZES), draw(SIZES)
    angle = draw(st.sampled_from([40.0, 1e-3, 90.0, 179.0]))
    return camera(position, look_at, up, angle, width, height), width, height


@pytest.mark.clause("CAM-3")
@given(views(), st.floats(0, 1), st.floats(0, 1))
def test_directions_are_unit_vectors_and_start_at_the_camera(
    view: tuple[layout.SceneData, int, int], across: float, below: float
) -> None:
    scene, width, height = view
    note_case(camera=tuple(scene.numbers), width=width, height=height, across=across, below=below)
    origin, direction = primary_ray(camera_frame(scene), across * width, below * height)
    assert origin == layout.vector_of(scene, layout.CAMERA_POSITION, 0)
    # A sum of squares γ(3), halved by the root, the root and the quotient one each, one in the product: γ(5); squared.
    assert abs(dot(exact(direction), exact(direction)) - 1) <= gamma(10)


@pytest.mark.clause("CAM-1", "CAM-2")
@given(views(), st.floats(0, 1, exclude_max=True), st.floats(0, 1))
def test_rays_turn_right_and_down_as_the_coordinates_grow(
    view: tuple[layout.SceneData, int, int], x: float, y: float
) -> None:
    scene, _, _ = view
    frame = camera_frame(scene)
    note_case(camera=tuple(scene.numbers), x=x, y=y)
    _, _, pixel_right, pixel_down, _ = map(exact, frame)
    here, right, below = (exact(primary_ray(frame, *point)[1]) for point in ((x, y), (x + 1, y), (x, y + 1)))
    assert dot(minus(right, here), pixel_right) > 0
    assert dot(minus(below, here), pixel_down) > 0
