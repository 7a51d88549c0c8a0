from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.scenes.scene_files import changed, problems, valid_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SCN-1")

MISSING = "expected this key, found nothing; add it."
OBJECT = {"shape": "sphere", "center": [0, 0, 0], "radius": 1, "material": "red"}


@pytest.mark.parametrize(
    ("place", "value", "sentence"),
    [
        (
            ("objects", 0),
            {"shape": "plane", "point": [0, 0, 0], "normal": [0, 0, 0], "material": "red"},
            "objects[0].normal: expected a vector that is not zero, since it gives a direction.",
        ),
        (
            ("objects", 0),
            {"shape": "plane", "point": [0, 0], "normal": [0, 1e-20, 0], "material": "red", "radius": 1},
            "objects[0].normal: expected a vector longer than 1e-18, since it gives a direction.",
        ),
        (("purpose",), "", "purpose: expected a text that is not empty, found ''."),
        (("convention",), "phong", "convention: expected 'whitted' or 'radiometric', found 'phong'."),
        (("max_depth",), -1, "max_depth: expected a number of at least 0, found -1."),
        (("max_depth",), 65, "max_depth: expected a number of at most 64, found 65."),
        (("camera",), 5, "camera: expected an object in braces, found 5."),
        (("camera", "width"), 0, "camera.width: expected a number of at least 1, found 0."),
        (("camera", "width"), 1.5, "camera.width: expected a whole number, found 1.5."),
        (("camera", "width"), True, "camera.width: expected a whole number, found true."),
        (("camera", "height"), 100_000, "camera.height: expected a number of at most 8192, found 100000."),
        (
            ("camera", "vertical_field_of_view"),
            180,
            "camera.vertical_field_of_view: expected a number below 180, found 180.",
        ),
        (("camera", "position", 2), 1e16, "camera.position[2]: expected a number of at most 1e+12, found 1e+16."),
        (("camera", "position"), [0, 1], "camera.position[2]: expected one more number, found nothing; add it."),
        (("camera", "position"), [0, 1, 2, 3], "camera.position: expected a list of 3, found a list of 4."),
        (("camera", "position"), "here", "camera.position: expected a list in square brackets, found 'here'."),
        (("camera", "up"), [0, 0, 0], "camera.up: expected a vector that is not zero, since it gives a direction."),
        (
            ("lights", 1, "direction"),
            [1e-30, 0, 0],
            "lights[1].direction: expected a vector longer than 1e-18, since it gives a direction.",
        ),
        (
            ("camera", "projection"),
            "fisheye",
            "camera: expected a key 'projection' with one of 'orthographic', 'perspective', found 'fisheye'.",
        ),
        (("background",), {"colour": [1, 1, 1]}, f"background.color: {MISSING}"),
        (("background",), {"top": [1, 1, 1]}, f"background.bottom: {MISSING}"),
        (("background",), 5, "background: expected an object in braces, found 5."),
        (
            ("lights", 0, "intensity", 0),
            -1e-9,
            "lights[0].intensity[0]: expected a number of at least 0, found -1e-09.",
        ),
        (("lights", 0, "intensity", 0), "1", "lights[0].intensity[0]: expected a number, found '1'."),
        (
            ("lights", 0, "falloff"),
            "linear",
            "lights[0].falloff: expected 'none' or 'inverse_square', found 'linear'.",
        ),
        (
            ("lights", 0, "falloff"),
            {"constant": 0, "linear": 0, "quadratic": 0},
            "lights[0].falloff: expected at least one of constant, linear and quadratic above 0.",
        ),
        (("lights", 0, "falloff"), {"constant": 1, "linear": 0}, f"lights[0].falloff.quadratic: {MISSING}"),
        (
            ("materials", "red", "diffuse", "reflectance", 2),
            -0.5,
            "materials.red.diffuse.reflectance[2]: expected a number of at least 0, found -0.5.",
        ),
        (
            ("materials", "board", "diffuse", "reflectance", "checkerboard", "size"),
            0,
            "materials.board.diffuse.reflectance.checkerboard.size: expected a number above 0, found 0.",
        ),
        (
            ("materials", "board", "diffuse", "reflectance", "checkerboard", "colour"),
            0,
            "materials.board.diffuse.reflectance.checkerboard.colour: expected no key 'colour' here; "
            "known are 'even', 'odd', 'offset', 'plane', 'size'.",
        ),
        (
            ("materials", "diffuse"),
            {"difuse": {"reflectance": [1, 1, 1]}},
            "materials.diffuse.difuse: expected no key 'difuse' here; did you mean 'diffuse'?",
        ),
        (
            ("materials", "red", "specular", "model"),
            "cook",
            "materials.red.specular.model: expected 'phong' or 'blinn', found 'cook'.",
        ),
        (
            ("materials", "glass", "dielectric", "index_of_refraction"),
            9e-7,
            "materials.glass.dielectric.index_of_refraction: expected a number of at least 1e-06, found 9e-07.",
        ),
        (
            ("materials", "glass", "dielectric", "reflectance"),
            [1, 1, 1],
            "materials.glass.dielectric: expected both reflectance and transmittance, or neither.",
        ),
        (
            ("materials", "two words"),
            {"mirror": {}},
            f"materials.'two words'.mirror.reflectance: {MISSING}",
        ),
        (
            ("materials", "new"),
            {"diffuse": None},
            "materials.new: expected at least one term: ambient, diffuse, specular, mirror, dielectric or emission.",
        ),
        (("objects",), [], "objects: expected at least one, found none."),
        (("objects",), ["sphere"], "objects[0]: expected an object in braces, found 'sphere'."),
        (("objects", 0, "radius"), -1, "objects[0].radius: expected a number above 0, found -1."),
        (("objects", 0, "radius"), None, "objects[0].radius: expected a number, found null."),
        (("objects", 0, "material"), 7, "objects[0].material: expected a text in quotes, found 7."),
        (
            ("objects", 0),
            OBJECT | {"radus": 2},
            "objects[0].radus: expected no key 'radus' here; did you mean 'radius'?",
        ),
        (
            ("objects", 0),
            {"center": [0, 0, 0]},
            "objects[0]: expected a key 'shape' with one of 'mesh', 'plane', 'sphere', 'triangle', found no such key.",
        ),
        (("objects", 2, "faces", 0, 1), -1, "objects[2].faces[0][1]: expected a number of at least 0, found -1."),
        (("objects", 2, "faces", 0, 1), 0.5, "objects[2].faces[0][1]: expected a whole number, found 0.5."),
        (("ambientlight",), 0, "ambientlight: expected no key 'ambientlight' here; did you mean 'ambient_light'?"),
    ],
)
def test_each_bad_value_gets_its_sentence(
    tmp_path: Path, place: tuple[str | int, ...], value: object, sentence: str
) -> None:
    assert sentence in problems(tmp_path, changed(place, value))


def test_one_bad_value_gives_one_problem(tmp_path: Path) -> None:
    for place, value in [
        (("materials", "red", "diffuse", "reflectance"), [1, 2]),
        (("lights", 0, "falloff"), 7),
        (("background",), []),
        (("objects", 0, "shape"), "cube"),
    ]:
        assert len(problems(tmp_path, changed(place, value))) == 1


@pytest.mark.parametrize("material", ["<color>", "point", "diffuse", "sphere"])
def test_a_material_may_have_any_name_without_confusing_the_places(tmp_path: Path, material: str) -> None:
    [problem] = problems(tmp_path, changed(("materials", material), {"mirror": {"reflectance": [1, 1, -1]}}))
    assert problem.endswith(".mirror.reflectance[2]: expected a number of at least 0, found -1.")
    assert material in problem


def test_each_key_that_is_not_optional_is_missed_by_its_place(tmp_path: Path) -> None:
    for key in ("purpose", "convention", "camera", "materials", "objects"):
        scene = valid_scene()
        del scene[key]
        assert f"{key}: {MISSING}" in problems(tmp_path, scene)
