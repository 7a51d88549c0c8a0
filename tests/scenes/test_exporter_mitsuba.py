"""What is written for Mitsuba, read back as XML, PLY and EXR; tests/comparisons shows that Mitsuba reads it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import numpy as np
import OpenImageIO
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.scenes.exporters.mitsuba import (
    GRADIENT_FILE,
    export_mitsuba,
    first_primitives_of,
    light_sources,
    shape_id,
)
from raytruth.scenes.exporters.mitsuba_elements import add_comment
from raytruth.scenes.exporters.mitsuba_files import GRADIENT_ROWS, checkerboard_coordinates
from raytruth.scenes.materials import Checkerboard
from raytruth.scenes.ply_file import read_ply
from tests.scenes.exporter_scenes import BALL, FLOOR, GLASS, LAMP, POINT, RED, SUN, build

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-2")


def export(scene: Scene, folder: Path, **options: Any) -> ElementTree.Element:
    return ElementTree.parse(export_mitsuba(scene, folder, max_depth=3, **options)).getroot()


def test_an_emissive_sphere_shines_to_the_side_of_the_camera(tmp_path: Path) -> None:
    around_camera = BALL | {"center": (0.0, 1.0, 5.0)}
    assert export(build(materials={"m": LAMP}), tmp_path).find("shape/boolean[@name='flip_normals']") is None
    turned = export(build(materials={"m": LAMP}, objects=[around_camera]), tmp_path)
    assert turned.find("shape/boolean[@name='flip_normals'][@value='true']") is not None


def test_each_source_of_light_can_be_exported_alone(tmp_path: Path) -> None:
    scene = build(materials={"m": RED | LAMP}, lights=[POINT, SUN], background={"color": (0.1, 0.2, 0.3)})

    def kinds(**options: Any) -> list[str]:
        return sorted(str(emitter.get("type")) for emitter in export(scene, tmp_path, **options).iter("emitter"))

    assert light_sources(scene) == [0, 1, "emission"]
    assert kinds() == ["area", "constant", "directional", "point"]
    assert kinds(only_source=0) == ["point"]
    assert kinds(only_source=1) == ["directional"]
    assert kinds(only_source="emission") == ["area", "constant"]


def test_primitives_are_numbered_spheres_first() -> None:
    mesh = {
        "shape": "mesh",
        "vertices": ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        "faces": ((0, 1, 2), (0, 2, 3)),
        "material": "m",
    }
    assert first_primitives_of(build(objects=[mesh, BALL, FLOOR, BALL])) == [2, 0, 4, 1]


coordinates = st.floats(-1e12, 1e12)


@given(st.tuples(coordinates, coordinates, coordinates), st.floats(1e-300, 1e12))
def test_numbers_read_back_exactly(tmp_path_factory: Any, center: tuple[float, float, float], radius: float) -> None:
    scene = build(objects=[BALL | {"center": center, "radius": radius}])
    shape = export(scene, tmp_path_factory.mktemp("scene")).find("shape")
    assert shape is not None
    point, number = shape.find("point"), shape.find("float")
    assert point is not None
    assert number is not None
    assert tuple(float(point.get(axis, "")) for axis in "xyz") == center
    assert float(number.get("value", "")) == radius


@given(st.text())
def test_any_text_makes_a_well_formed_comment(text: str) -> None:
    root = ElementTree.Element("scene")
    add_comment(root, text)
    ElementTree.fromstring(ElementTree.tostring(root, encoding="utf-8"))


def test_names_with_a_meaning_for_mitsuba_do_not_reach_its_attributes(tmp_path: Path) -> None:
    name = "a.b $width <--"
    root = export(build(materials={name: RED}, objects=[BALL | {"material": name}]), tmp_path)
    values = [value for element in root.iter() for value in element.attrib.values()]
    assert not any("$" in value or "<" in value for value in values)


def test_the_vertical_field_of_view_and_the_width_of_the_view_are_stated(tmp_path: Path) -> None:
    perspective = export(build(), tmp_path)
    assert perspective.find("sensor/string[@name='fov_axis'][@value='y']") is not None
    camera = {"projection": "orthographic", "position": (0.0, 1.0, 5.0), "look_at": (0.0, 0.0, 0.0)}
    orthographic = export(build(camera=camera | {"width": 32, "height": 24, "view_height": 3.0}), tmp_path)
    assert orthographic.find("sensor/transform/scale[@x='2.0'][@y='2.0']") is not None


def test_one_ray_goes_through_each_pixel_centre_unless_glass_makes_paths_random(tmp_path: Path) -> None:
    sampler = export(build(), tmp_path).find("sensor/sampler[@type='stratified']")
    assert sampler is not None
    assert sampler.find("integer[@name='sample_count'][@value='1']") is not None
    assert sampler.find("boolean[@name='jitter'][@value='false']") is not None
    assert export(build(materials={"m": GLASS}), tmp_path).find("sensor/sampler[@type='independent']") is not None


def test_both_indices_of_an_interface_are_stated(tmp_path: Path) -> None:
    bubble = {"dielectric": {"index_of_refraction": 1.0, "outside": "water"}}
    water = {"dielectric": {"index_of_refraction": 1.33}}
    bsdf = export(build(materials={"m": bubble, "water": water}), tmp_path).find("bsdf")
    assert bsdf is not None
    assert {number.get("name"): number.get("value") for number in bsdf} == {"int_ior": "1.0", "ext_ior": "1.33"}


def test_the_interpolated_gradient_is_the_gradient_within_float32(tmp_path: Path) -> None:
    bottom, top = np.array([0.3, 0.0, 0.1]), np.array([0.1, 0.2, 0.9])
    export(build(background={"bottom": tuple(bottom), "top": tuple(top)}), tmp_path)
    pixels = OpenImageIO.ImageBuf(str(tmp_path / GRADIENT_FILE)).get_pixels(OpenImageIO.FLOAT)
    assert pixels is not None
    angles = np.linspace(0.0, np.pi, 100_003)
    rows = np.linspace(0.0, np.pi, GRADIENT_ROWS)
    for channel in range(3):
        interpolated = np.interp(angles, rows, pixels[:, 0, channel])
        half_difference, mean = (top - bottom)[channel] / 2, (top + bottom)[channel] / 2
        # 3.7e-8 of the difference for the interpolation, 2^-24 of the value for float32.
        bound = 3.7e-8 * 2 * abs(half_difference) + 2.0**-24 * max(top[channel], bottom[channel])
        assert np.abs(interpolated - (mean + half_difference * np.cos(angles))).max() <= bound


@given(st.tuples(*[st.floats(-50, 50)] * 3), st.floats(0.1, 10), st.tuples(*[st.floats(-5, 5)] * 2))
def test_texture_coordinates_give_the_parity_of_the_squares(
    point: tuple[float, float, float], size: float, offset: tuple[float, float]
) -> None:
    board = Checkerboard(even=(1.0, 1.0, 1.0), odd=(0.0, 0.0, 0.0), size=size, plane="yz", offset=offset)
    squares = [(point[1] - offset[0]) / size, (point[2] - offset[1]) / size]
    mapped = checkerboard_coordinates(board, np.array([point]))[0]
    if min(abs(square - round(square)) for square in squares) < 1e-9:
        return  # on a border both colours are right
    upper_half = mapped - np.floor(mapped) > 0.5  # checkerboard.cpp: color0 where both or neither
    assert (upper_half[0] == upper_half[1]) == (sum(int(np.floor(square)) for square in squares) % 2 == 0)


def test_meshes_keep_their_faces_and_float32_vertices(tmp_path: Path) -> None:
    vertices = ((0.1, 1 / 3, 1e-9), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    faces = ((0, 1, 2), (0, 3, 2))
    export(build(objects=[BALL, {"shape": "mesh", "vertices": vertices, "faces": faces, "material": "m"}]), tmp_path)
    read_vertices, read_faces = read_ply((tmp_path / f"{shape_id(1)}.ply").read_bytes())
    assert np.array_equal(np.array(read_vertices), np.array(vertices, dtype=np.float32))
    assert read_faces == faces
