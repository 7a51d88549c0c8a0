"""Files for pbrt, read by the rules of its parser and given the meaning that its source gives them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.exporters.pbrt import export_pbrt
from raytruth.scenes.exporters.pbrt_limits import notes, refuses
from raytruth.scenes.exporters.pbrt_text import comment, numbers
from raytruth.scenes.exporters.triangle_soup import triangle_lists
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.materials import CheckerboardColor
from raytruth.scenes.shapes import Sphere
from tests.scenes.exporter_scenes import BALL, BOARD, FLOOR, GLASS, LAMP, MIRROR, POINT, RED, SUN, build
from tests.scenes.pbrt_grammar import Directive, parse

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.materials import Checkerboard
    from raytruth.scenes.scene import Scene

    Array = np.ndarray[Any, Any]

pytestmark = pytest.mark.clause("REN-2")

PBRT_SCENES = [name for name in library_names() if refuses(open_scene(name)) is None]
CAMERA = {"position": (0.3, 1.2, 5.1), "look_at": (-0.2, 0.1, 0.4), "up": (0.2, 1.0, 0.1)}
WIDE = CAMERA | {"projection": "perspective", "vertical_field_of_view": 41.0, "width": 9, "height": 5}
TALL = WIDE | {"width": 5, "height": 9}
PARALLEL = CAMERA | {"projection": "orthographic", "view_height": 2.3, "width": 12, "height": 7}
TILES = {"checkerboard": BOARD["checkerboard"] | {"even": (0.9, 0.1, 0.1), "plane": "yz"}}


def directives_of(scene: Scene, folder: Path) -> list[Directive]:
    return parse(export_pbrt(scene, folder).read_text(encoding="utf-8"))


def named(directives: list[Directive], *names: str) -> list[Directive]:
    return [directive for directive in directives if directive.name in names]


def camera_to_world(directives: list[Directive]) -> Array:
    """Of what stands before the camera: scene.cpp multiplies from the right; util/transform.cpp, LookAt."""
    world_to_camera = np.eye(4)
    for directive in named(directives, "Scale", "LookAt"):
        if directive.name == "Scale":
            world_to_camera = world_to_camera @ np.diag([*directive.numbers, 1.0])
            continue
        position, target, up = np.reshape(directive.numbers, (3, 3))
        forward = (target - position) / np.linalg.norm(target - position)
        side = np.cross(up / np.linalg.norm(up), forward)
        side /= np.linalg.norm(side)
        placed = np.eye(4)
        placed[:3] = np.column_stack([side, np.cross(forward, side), forward, position])
        world_to_camera = world_to_camera @ np.linalg.inv(placed)
    return np.linalg.inv(world_to_camera)


def rays_of(directives: list[Directive]) -> tuple[Array, Array]:
    """Through the pixels' centres, row 0 on top (cameras.h, ProjectiveCamera; cameras.cpp, GenerateRay)."""
    (film,), (camera,) = named(directives, "Film"), named(directives, "Camera")
    (width,), (height,) = film.parameters["integer xresolution"], film.parameters["integer yresolution"]
    left, right, bottom, top = camera.parameters["float screenwindow"]
    x = left + (np.arange(width) + 0.5) / width * (right - left)
    y = top + (np.arange(height) + 0.5) / height * (bottom - top)
    on_screen = np.stack([*np.meshgrid(x, y), np.zeros((height, width))], axis=-1)
    if camera.words == ["perspective"]:
        slope = math.tan(math.radians(camera.parameters["float fov"][0]) / 2)
        origins = np.zeros_like(on_screen)
        directions = on_screen * slope + [0.0, 0.0, 1.0]
    else:
        origins, directions = on_screen, np.broadcast_to([0.0, 0.0, 1.0], on_screen.shape)
    matrix = camera_to_world(directives)
    directions = directions @ matrix[:3, :3].T
    return origins @ matrix[:3, :3].T + matrix[:3, 3], directions / np.linalg.norm(directions, axis=-1, keepdims=True)


def assert_same_camera(directives: list[Directive], scene: Scene) -> None:
    for found, expected in zip(rays_of(directives), primary_rays(scene), strict=True):
        # A dozen roundings of coordinates of this size.
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14 * max(1.0, np.abs(expected).max()))


def assert_same_lights(directives: list[Directive], scene: Scene) -> None:
    lights = [light for light in named(directives, "LightSource") if light.words != ["infinite"]]
    for found, light in zip(lights, scene.lights, strict=True):
        if light.kind == "point":
            expected = {"rgb I": light.intensity, "point3 from": light.position}
        else:
            expected = {"rgb L": light.irradiance, "point3 from": (0, 0, 0), "point3 to": light.direction}
        assert {key: tuple(values) for key, values in found.parameters.items()} == expected


def assert_same_objects(directives: list[Directive], scene: Scene) -> None:
    materials = {found.words[0]: found for found in named(directives, "MakeNamedMaterial")}
    moves = iter(named(directives, "Translate"))
    users = named(directives, "NamedMaterial")
    for found, user, shape in zip(named(directives, "Shape"), users, scene.objects, strict=True):
        if isinstance(shape, Sphere):
            assert tuple(next(moves).numbers) == shape.center
            assert found.parameters == {"float radius": [shape.radius]}
        else:
            vertices, faces = triangle_lists(shape)
            assert np.reshape(found.parameters["point3 P"], (-1, 3)).tolist() == np.array(vertices).tolist()
            assert np.reshape(found.parameters["integer indices"], (-1, 3)).tolist() == np.array(faces).tolist()
        diffuse = scene.materials[shape.material].diffuse
        written = materials[user.words[0]].parameters
        if diffuse and isinstance(diffuse.reflectance, tuple):
            assert tuple(written["rgb reflectance"]) == diffuse.reflectance


@pytest.mark.parametrize("name", PBRT_SCENES)
def test_a_reader_finds_the_same_camera_lights_and_objects(name: str, tmp_path: Path) -> None:
    scene = open_scene(name)
    directives = directives_of(scene, tmp_path)
    assert_same_camera(directives, scene)
    assert_same_lights(directives, scene)
    assert_same_objects(directives, scene)


@pytest.mark.parametrize("camera", [WIDE, TALL, PARALLEL])
def test_all_cameras_send_our_rays_whichever_side_is_longer(camera: dict[str, Any], tmp_path: Path) -> None:
    scene = build(camera=camera, lights=[POINT, SUN])
    directives = directives_of(scene, tmp_path)
    assert_same_camera(directives, scene)
    assert_same_lights(directives, scene)


@pytest.fixture(scope="module")
def tiles(tmp_path_factory: pytest.TempPathFactory) -> tuple[Checkerboard, Directive]:
    """A checkerboard and the texture that is written for it."""
    scene = build(materials={"m": {"diffuse": {"reflectance": TILES}}})
    (texture,) = named(directives_of(scene, tmp_path_factory.mktemp("tiles")), "Texture")
    diffuse = scene.materials["m"].diffuse
    assert diffuse is not None
    assert isinstance(diffuse.reflectance, CheckerboardColor)
    return diffuse.reflectance.checkerboard, texture


@given(point=st.tuples(*[st.floats(-20.0, 20.0)] * 3))
def test_a_checkerboard_has_our_squares(
    tiles: tuple[Checkerboard, Directive], point: tuple[float, float, float]
) -> None:
    board, texture = tiles
    along = [
        np.dot(point, texture.parameters[f"vector3 v{number}"]) + texture.parameters[f"float {axis}delta"][0]
        for number, axis in ((1, "u"), (2, "v"))
    ]
    ours = [(point["xyz".index(axis)] - offset) / board.size for axis, offset in zip("yz", board.offset, strict=True)]
    if min(abs(number - round(number)) for number in ours) < 1e-12:
        return  # on a border, where both squares are right
    even = sum(math.floor(number) for number in along) % 2 == 0
    assert even == (sum(math.floor(number) for number in ours) % 2 == 0)
    assert texture.parameters["rgb tex1" if even else "rgb tex2"] == list(board.even if even else board.odd)


def test_glass_states_its_index_relative_to_what_is_outside(tmp_path: Path) -> None:
    bubble = {"dielectric": {"index_of_refraction": 1.2, "outside": "m"}}
    inner = BALL | {"radius": 0.5, "material": "bubble"}
    scene = build(materials={"m": GLASS, "bubble": bubble}, objects=[BALL, inner], max_depth=4)
    outer, within = named(directives_of(scene, tmp_path), "MakeNamedMaterial")
    assert outer.parameters == {"string type": ["dielectric"], "float eta": [1.5]}
    assert within.parameters == {"string type": ["dielectric"], "float eta": [1.2 / 1.5]}


def test_what_shines_is_written_unscaled_and_on_both_sides(tmp_path: Path) -> None:
    directives = directives_of(build(materials={"m": LAMP}, background={"color": (0.1, 0.2, 0.3)}), tmp_path)
    (lamp,), (sky,) = named(directives, "AreaLightSource"), named(directives, "LightSource")
    assert lamp.parameters == {"rgb L": [2.0, 3.0, 4.0], "bool twosided": [True]}
    assert (sky.words, sky.parameters) == (["infinite"], {"rgb L": [0.1, 0.2, 0.3]})
    (material,) = named(directives, "MakeNamedMaterial")
    assert material.parameters["rgb reflectance"] == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("changes", "maxdepth", "different"),
    [
        ({"lights": [POINT]}, 1, False),
        ({"materials": {"m": LAMP}}, 0, False),
        ({"lights": [POINT], "background": {"color": (0.1, 0.2, 0.3)}}, 1, True),
        ({"lights": [POINT], "objects": [BALL, BALL | {"center": (3.0, 0.0, 0.0)}], "max_depth": 1}, 1, False),
        ({"materials": {"m": GLASS}, "background": {"color": (0.1, 0.2, 0.3)}, "max_depth": 3}, 3, False),
    ],
)
def test_the_depth_is_the_one_with_our_light_paths_or_a_note_tells_of_others(
    changes: dict[str, Any], maxdepth: int, different: bool, tmp_path: Path
) -> None:
    scene = build(**changes)
    (integrator,) = named(directives_of(scene, tmp_path), "Integrator")
    assert integrator.parameters["integer maxdepth"] == [maxdepth]
    assert any("light paths" in note for note in notes(scene)) == different


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"lights": [POINT | {"falloff": "none"}]}, "falls off"),
        (
            {"ambient_light": (1.0, 1.0, 1.0), "materials": {"m": {"ambient": {"reflectance": (1.0, 1.0, 1.0)}}}},
            "ambient",
        ),
        ({"materials": {"m": MIRROR}, "max_depth": 1}, "conductor"),
        ({"convention": "whitted", "lights": [POINT | {"falloff": "inverse_square"}]}, "π"),
        ({"convention": "whitted", "materials": {"m": GLASS}}, "refraction"),
        ({"materials": {"m": GLASS | RED}}, "beside"),
        (
            {"materials": {"m": {"dielectric": GLASS["dielectric"] | {"absorption": (0.1, 0.0, 0.0)}}}, "max_depth": 1},
            "absorbing",
        ),
        ({"materials": {"m": {"emission": {"radiance": BOARD}}}}, "checkerboard"),
        ({"materials": {"m": {"diffuse": {"reflectance": BOARD}}}}, "at most 1"),
        ({"materials": {"m": {"diffuse": {"reflectance": (0.0, 1.1, 0.0)}}}}, "at most 1"),
        ({"background": {"bottom": (0.0, 0.0, 0.0), "top": (1.0, 1.0, 1.0)}}, "gradient"),
    ],
)
def test_what_pbrt_cannot_say_is_refused(changes: dict[str, Any], word: str, tmp_path: Path) -> None:
    scene = build(**changes)
    assert word in (refuses(scene) or "")
    with pytest.raises(ValueError, match="because"):
        export_pbrt(scene, tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("model", ["phong", "blinn"])
def test_highlights_are_refused(model: str) -> None:
    highlight = {"specular": {"reflectance": (1.0, 1.0, 1.0), "exponent": 9.0, "model": model}}
    reason = refuses(build(convention="whitted", materials={"m": highlight}, lights=[SUN])) or ""
    assert f"no {model.capitalize()} highlight" in reason


@given(st.text())
def test_a_comment_is_one_line_whatever_the_text(text: str) -> None:
    assert parse(comment(text) + "WorldBegin")[0].name == "WorldBegin"


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=3, max_size=3))
def test_numbers_read_back_exactly(values: list[float]) -> None:
    assert parse(f"Scale {numbers(values)} WorldBegin")[0].numbers == values


def test_names_of_the_author_stay_in_comments(tmp_path: Path) -> None:
    name = 'x"\nOption "seed" 1 #'
    scene = build(purpose="A\nWorldEnd", materials={name: RED}, objects=[FLOOR | {"material": name}])
    assert len(named(directives_of(scene, tmp_path), "Option")) == 2
