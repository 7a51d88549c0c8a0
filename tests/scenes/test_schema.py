from __future__ import annotations

import json

import jsonschema
import pytest

from raytruth.scenes.library import LIBRARY_FOLDER, library_names
from raytruth.scenes.schema import json_schema
from tests.scenes.scene_files import changed, valid_scene

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
    ],
)
def test_the_schema_refuses_what_loading_refuses(place: tuple[str | int, ...], value: object) -> None:
    assert VALIDATOR.is_valid(valid_scene())
    assert not VALIDATOR.is_valid(changed(place, value))
