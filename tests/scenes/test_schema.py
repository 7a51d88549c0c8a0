from __future__ import annotations

import json
import math
import re
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest

from raytruth.scenes.consistency import LARGEST_PIXEL_COUNT, SMALLEST_SINE
from raytruth.scenes.library import LIBRARY_FOLDER, library_names
from raytruth.scenes.loading import LARGEST_SCENE_FILE, MOST_MESH_FILES
from raytruth.scenes.mesh_files import LARGEST_MESH_FILE
from raytruth.scenes.schema import json_schema
from raytruth.scenes.triangle_lists import LARGEST_FACE_COUNT
from tests.scenes.scene_files import changed, problems, valid_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SCN-4")

VALIDATOR = jsonschema.Draft202012Validator(json_schema())


def test_the_schema_obeys_its_own_draft_and_is_json() -> None:
    jsonschema.Draft202012Validator.check_schema(json_schema())
    assert json.loads(json.dumps(json_schema())) == json_schema()


@pytest.mark.parametrize("name", library_names())
def test_every_scene_of_the_library_obeys_the_schema(name: str) -> None:
    VALIDATOR.validate(json.loads((LIBRARY_FOLDER / f"{name}.json").read_text(encoding="utf-8")))


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (("objects", 0, "radius"), -1),
        (("objects", 0, "colour"), "red"),
        (("camera", "projection"), "fisheye"),
        (("name",), "red"),
        (("materials",), {}),
        (("lights", 0, "intensity"), [1, 1]),
        (("lights", 0, "falloff"), {"constant": 0, "linear": 0, "quadratic": 0}),
        (("lights", 1, "direction"), [0, 0, 0]),
        (("objects", 2, "file"), "tetrahedron.obj"),
        (("objects", 2, "vertices"), []),
        (("objects", 3, "faces"), [[0, 1, 2]]),
        (("objects", 3, "file"), None),
        (("objects",), [{"shape": "mesh", "file": "tetrahedron.obj", "material": "red"}] * (MOST_MESH_FILES + 1)),
    ],
)
def test_the_schema_refuses_what_loading_refuses(tmp_path: Path, place: tuple[str | int, ...], value: object) -> None:
    assert VALIDATOR.is_valid(valid_scene())
    assert not VALIDATOR.is_valid(changed(place, value))
    assert problems(tmp_path, changed(place, value))


LIMITS: list[tuple[tuple[str | int, ...], float, float]] = [
    (("camera", "position", 0), 1e12, math.nextafter(1e12, math.inf)),
    (("camera", "position", 0), -1e12, math.nextafter(-1e12, -math.inf)),
    (("camera", "vertical_field_of_view"), math.nextafter(180, 0), 180),
    (("camera", "vertical_field_of_view"), 1e-9, 0),
    (("camera", "width"), 8192, 8193),
    (("camera", "height"), 1, 0),
    (("max_depth",), 64, 65),
    (("ambient_light", 0), 1e12, math.nextafter(1e12, math.inf)),
    (("lights", 0, "intensity", 1), 0, -5e-324),
    (("lights", 1, "direction"), 1e-18, math.nextafter(1e-18, 0)),
    (("materials", "glass", "dielectric", "index_of_refraction"), 1e-6, math.nextafter(1e-6, 0)),
    (("materials", "glass", "dielectric", "index_of_refraction"), 1e6, math.nextafter(1e6, math.inf)),
    (("materials", "red", "specular", "exponent"), 1e12, math.nextafter(1e12, math.inf)),
    (("objects", 0, "radius"), 5e-324, 0),
    (("objects", 0, "radius"), 1e12, math.nextafter(1e12, math.inf)),
]


@pytest.mark.parametrize(("place", "last", "beyond"), LIMITS)
def test_the_schema_and_loading_have_the_same_limits(
    tmp_path: Path, place: tuple[str | int, ...], last: float, beyond: float
) -> None:
    for value, is_within in ((last, True), (beyond, False)):
        scene = changed(place, [0.0, -value, 0.0] if place[-1] == "direction" else value)
        assert VALIDATOR.is_valid(scene) == is_within
        assert (problems(tmp_path, scene) == []) == is_within


@pytest.mark.parametrize(
    ("place", "limit"),
    [
        (("$defs", "PerspectiveCamera", "properties", "up"), SMALLEST_SINE),
        (("$defs", "OrthographicCamera", "properties", "up"), SMALLEST_SINE),
        (("$defs", "PerspectiveCamera", "properties", "width"), LARGEST_PIXEL_COUNT),
        (("$defs", "OrthographicCamera", "properties", "height"), LARGEST_PIXEL_COUNT),
        (("$defs", "Mesh", "properties", "file"), LARGEST_MESH_FILE),
        (("properties", "objects"), LARGEST_FACE_COUNT),
        (("properties", "objects"), MOST_MESH_FILES),
        ((), LARGEST_SCENE_FILE),
    ],
)
def test_the_schema_tells_in_words_what_it_cannot_check(place: tuple[str, ...], limit: float) -> None:
    part: Any = json_schema()
    for step in place:
        part = part[step]
    numbers = re.findall(r"\d[\d.e-]*\d", part["description"])
    assert limit in map(float, numbers)
