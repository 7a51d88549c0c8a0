"""What scenes say, and which pairs of sayings none says."""

from __future__ import annotations

from itertools import combinations

import pytest

from raytruth.scenes.coverage import said_by, sayings
from raytruth.scenes.families.language import CHOICES, goes_together, language, pairs, rows
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.pair_coverage import coverage, measured, why_not_together
from raytruth.scenes.scene import Scene
from raytruth.scenes.schema import json_schema

pytestmark = pytest.mark.clause("SCN-9")

SPHERE = {"shape": "sphere", "center": (0.0, 0.0, 0.0), "radius": 1.0, "material": "m"}
CAMERA = {"projection": "perspective", "position": (0.0, 0.0, 5.0), "look_at": (0.0, 0.0, 0.0)}
SIZE = {"width": 4, "height": 3, "vertical_field_of_view": 40.0}


def scene(**changes: object) -> Scene:
    stated = {"purpose": "A test.", "convention": "radiometric", "camera": {**CAMERA, **SIZE}, "objects": [SPHERE]}
    return Scene.model_validate(stated | {"materials": {"m": {"emission": {"radiance": (1.0, 1.0, 1.0)}}}} | changes)


def test_every_key_of_the_schema_is_said_or_required() -> None:
    """The schema is made by pydantic, so that neither list is made from the other."""
    optional = {
        key
        for part in (json_schema(), *json_schema()["$defs"].values())
        for key in part.get("properties", {})
        if key not in part.get("required", [])
    }
    said = {saying.partition(" is ")[0].rpartition(".")[2].removesuffix("[]") for saying in sayings()}
    assert optional - said <= {"name", "$schema"}
    assert {"up", "inside", "plane", "offset", "file", "outside"} <= optional & said


def test_a_default_is_not_said_and_what_no_object_has_is_not_either() -> None:
    plain = said_by(scene())
    assert "max_depth" not in plain
    assert said_by(scene(max_depth=1)) - plain == {"max_depth"}
    unused = {"m": {"emission": {"radiance": (1.0, 1.0, 1.0)}}, "other": {"mirror": {"reflectance": (1.0, 1.0, 1.0)}}}
    assert said_by(scene(materials=unused)) == plain


def test_alternatives_are_told_apart() -> None:
    board = {"even": (1.0, 1.0, 1.0), "odd": (0.0, 0.0, 0.0), "plane": "yz"}
    said = said_by(scene(materials={"m": {"emission": {"radiance": {"checkerboard": board}}}}))
    assert "materials.*.emission.radiance is CheckerboardColor" in said
    assert "materials.*.emission.radiance.checkerboard.plane is yz" in said
    assert "materials.*.emission.radiance is a color" not in said


@pytest.mark.parametrize("name", library_names())
def test_scenes_say_only_what_can_be_said(name: str) -> None:
    assert said_by(open_scene(name)) <= set(sayings())


def test_nothing_is_a_hole() -> None:
    found = coverage()
    assert found.holes == ()
    assert found.pair_holes == ()


def test_what_only_one_scene_says_becomes_a_hole_without_it() -> None:
    said = [said_by(open_scene(name)) for name in library_names() if name != "corner-of-tiles"]
    assert "materials.*.diffuse.reflectance.checkerboard.plane is xy" in measured(said, []).holes
    assert len(measured(said, []).pair_holes) > len(measured([*said, frozenset(sayings())], []).pair_holes) == 0


def test_pairs_that_are_left_out_have_a_reason() -> None:
    reasons = {why_not_together(*pair) for pair in combinations(sayings(), 2)} - {None}
    assert len(reasons) == 3
    assert why_not_together("camera is perspective", "camera is orthographic")
    assert why_not_together("convention is radiometric", "materials.*.specular.model is blinn")
    assert why_not_together("lights[] is point", "lights[] is directional") is None


def test_rows_hold_every_pair_that_goes_together_and_no_other() -> None:
    held = {pair for row in rows() for pair in combinations(row.items(), 2)}
    assert held == {pair for pair in pairs() if goes_together(dict(pair))}
    assert all(goes_together(row) for row in rows())
    assert len(rows()) <= 175 < len(CHOICES["material"]) ** 2 + len(CHOICES["light"]) ** 2


@pytest.mark.parametrize("row", range(0, 175, 5))
def test_drawn_scenes_say_what_their_row_says(row: int) -> None:
    chosen, said = rows()[row], said_by(language(float(row), 1))
    assert ("camera.inside" in said) == (chosen["inside"] == "in water")
    assert ("ambient_light" in said) == chosen["ambient light"]
    assert f"camera is {chosen['projection']}" in said
    assert f"objects[] is {chosen['shape']}" in said
