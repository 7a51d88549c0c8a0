"""Where no light is said to be hidden none is; what surely hides none is not said to."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.scenes.hidden_lights import MOST_TRIANGLES, may_be_hidden
from raytruth.scenes.library import open_scene
from tests.reference_tracer.kernels import float_kernel
from tests.scenes.exporter_scenes import LAMP, RED, build

pytestmark = pytest.mark.clause("SHAD-1", "SHAD-2", "REN-4")

CAMERA = {
    "projection": "perspective",
    "vertical_field_of_view": 40.0,
    "position": (0.3, 1.2, 5.0),
    "look_at": (0.0, 0.1, 0.0),
    "width": 4,
    "height": 3,
}
PARALLEL = {name: value for name, value in CAMERA.items() if name != "vertical_field_of_view"} | {
    "projection": "orthographic",
    "view_height": 3.0,
}
FLOOR = ((-2.0, -1.0, -2.0), (0.0, -1.0, 2.0), (2.0, -1.0, -2.0))
ROOF = ((-0.7, 0.4, 0.3), (0.8, 0.6, 0.1), (0.1, 0.5, -0.9))
# Points of a triangle, to its edges and corners.
WEIGHTS = [(i / 6, j / 6, (6 - i - j) / 6) for i in range(7) for j in range(7 - i)]

# Few numbers, so that planes often go through lights, corners and the camera.
small = st.integers(-2, 2).map(float)
corner = st.tuples(small, small, small)


def triangle(vertices: Any, material: str = "m") -> dict[str, Any]:
    return {"shape": "triangle", "vertices": vertices, "material": material}


def point(*position: float) -> dict[str, Any]:
    return {"kind": "point", "position": position, "intensity": (1.0, 1.0, 1.0), "falloff": "none"}


def sun(*direction: float) -> dict[str, Any]:
    return {"kind": "directional", "direction": direction, "irradiance": (1.0, 1.0, 1.0)}


def lit(triangles: Any, light: Any, camera: Any = CAMERA) -> Any:
    return build(
        convention="whitted", objects=[triangle(vertices) for vertices in triangles], lights=[light], camera=camera
    )


def shadowed_points(scene: Any) -> int:
    """How many points of triangles are lit on the side that is seen, but for another triangle that is in between."""
    kernel = float_kernel()
    (light,) = scene.lights
    triangles = [np.array(shape.vertices) for shape in scene.objects]
    camera = scene.camera
    backward = np.subtract(camera.position, camera.look_at)
    count = 0
    for receiver, (a, b, c) in enumerate(triangles):
        normal = np.cross(b - a, c - a)
        for weights in WEIGHTS:
            q = weights[0] * a + weights[1] * b + weights[2] * c
            toward = -np.array(light.direction) if light.kind == "directional" else light.position - q
            end = np.inf if light.kind == "directional" else 1 - 1e-9
            viewer = np.subtract(camera.position, q) if camera.projection == "perspective" else backward
            if (normal @ toward) * (normal @ viewer) <= 1e-9:
                continue
            # What meets the light's ray where it starts does not hide it.
            count += sum(
                1e-9 < kernel.triangle_distance(tuple(q), tuple(toward), *map(tuple, other)) < end
                for number, other in enumerate(triangles)
                if number != receiver
            )
    return count


@given(st.lists(st.tuples(corner, corner, corner), min_size=2, max_size=3), corner, st.booleans(), st.booleans())
def test_what_is_proved_is_so(triangles: Any, light: Any, is_sun: bool, is_parallel: bool) -> None:
    if is_sun and light == (0.0, 0.0, 0.0):
        light = (0.0, 1.0, 0.0)
    scene = lit(triangles, sun(*light) if is_sun else point(*light), PARALLEL if is_parallel else CAMERA)
    if may_be_hidden(scene) is None:
        assert shadowed_points(scene) == 0


def test_a_roof_hides_a_light_above_it_from_the_floor_and_no_other() -> None:
    assert may_be_hidden(lit([FLOOR, ROOF], point(0.1, 3.0, 0.0))) == "triangle 1 may hide light 0 from triangle 0"
    assert may_be_hidden(lit([FLOOR, ROOF], point(0.1, 0.2, 0.0))) is None  # between them
    assert may_be_hidden(lit([FLOOR, ROOF], point(9.0, 0.3, 0.0))) is None  # beside
    assert may_be_hidden(lit([FLOOR, ROOF], point(0.1, -3.0, 0.0))) is None  # the floor is not lit where it is seen
    assert may_be_hidden(lit([FLOOR, ROOF], sun(0.1, -1.0, 0.1))) is not None
    assert may_be_hidden(lit([FLOOR, ROOF], sun(1.0, -0.1, 0.1))) is None
    assert may_be_hidden(lit([FLOOR, ROOF], sun(0.0, -1.0, 0.0), PARALLEL)) is not None


def test_a_plate_that_stands_on_a_floor_hides_none_of_a_light_in_its_own_plane() -> None:
    wall = ((0.0, -1.0, -1.0), (0.0, -1.0, 1.0), (0.0, 1.0, 0.0))
    beside = ((0.5, -1.0, -1.0), (0.5, -1.0, 1.0), (2.0, -1.0, 0.0))
    assert may_be_hidden(lit([beside, wall], point(0.0, 3.0, 0.0))) is None
    assert may_be_hidden(lit([beside, wall], point(-1.0, 3.0, 0.0))) is not None


def test_a_corner_of_a_room_is_lit_everywhere_and_so_is_a_convex_body() -> None:
    room = [
        ((0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 0.0, 4.0)),
        ((0.0, 0.0, 0.0), (0.0, 4.0, 0.0), (0.0, 0.0, 4.0)),
        ((0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)),
    ]
    inside = CAMERA | {"position": (1.0, 1.1, 5.0)}
    assert may_be_hidden(lit(room, point(0.5, 0.7, 0.9), inside)) is None
    outside = CAMERA | {"position": (-2.0, -2.1, -5.0)}
    assert may_be_hidden(lit(room, point(-0.5, -0.7, -0.9), outside)) is None


def test_a_light_at_the_camera_is_hidden_from_nothing_that_is_seen() -> None:
    above = CAMERA | {"position": (0.1, 3.0, 0.1)}
    assert may_be_hidden(lit([FLOOR, ROOF], point(0.1, 3.0, 0.1), above)) is None
    assert may_be_hidden(lit([FLOOR, ROOF], point(0.1, 3.1, 0.1), above)) is not None
    # What is behind the camera throws shadows, too.
    toward = np.subtract(CAMERA["look_at"], CAMERA["position"])
    behind = [tuple(np.array(vertex) - 3 * toward + (0.0, 1.0, 0.0)) for vertex in FLOOR]
    assert may_be_hidden(lit([ROOF, behind], sun(*toward), PARALLEL)) is not None


def test_only_lit_surfaces_count_and_all_that_throw_shadows() -> None:
    objects = [triangle(FLOOR, "lamp"), triangle(ROOF)]
    materials = {"m": RED, "lamp": LAMP}
    assert may_be_hidden(build(objects=objects, materials=materials, lights=[point(0.1, 3.0, 0.0)])) is None
    objects = [triangle(FLOOR), triangle(ROOF, "lamp")]
    assert may_be_hidden(build(objects=objects, materials=materials, lights=[point(0.1, 3.0, 0.0)])) is not None
    assert may_be_hidden(build(objects=objects, materials=materials, lights=[])) is None


def test_nothing_hides_by_a_triangle_without_area() -> None:
    line = ((-1.0, 0.5, 0.0), (0.0, 0.5, 0.0), (1.0, 0.5, 0.0))
    assert may_be_hidden(lit([FLOOR, line], point(0.1, 3.0, 0.0))) is None


def test_of_too_many_triangles_nothing_is_proved() -> None:
    assert f"more than {MOST_TRIANGLES}" in str(may_be_hidden(open_scene("trefoil-knot")))
    assert may_be_hidden(open_scene("cornell-box")) is not None


def test_nothing_is_proved_of_planes() -> None:
    plane = {"shape": "plane", "point": (0.0, -1.0, 0.0), "normal": (0.0, 1.0, 0.0), "material": "m"}
    told = may_be_hidden(build(convention="whitted", objects=[triangle(FLOOR), plane], lights=[point(0.0, 3.0, 0.0)]))
    assert told is not None
    assert "planes" in told
