from __future__ import annotations

import pytest
from pydantic import ValidationError

from raytruth.scenes.materials import CheckerboardColor, Diffuse, Material, colors_of

pytestmark = pytest.mark.clause("SCN-1")


def test_a_material_states_a_term_that_is_not_null() -> None:
    with pytest.raises(ValidationError, match="expected at least one term"):
        Material(diffuse=None)
    assert Material(diffuse=Diffuse(reflectance=(0.5, 0.5, 0.5))).mirror is None


def test_a_reflectance_is_a_color_or_a_checkerboard() -> None:
    board = {"checkerboard": {"even": [0, 0, 0], "odd": [1, 1, 1]}}
    assert Diffuse.model_validate({"reflectance": [1, 0, 0]}).reflectance == (1, 0, 0)
    assert isinstance(Diffuse.model_validate({"reflectance": board}).reflectance, CheckerboardColor)


def test_a_texture_shows_its_one_colour_or_both_of_its_checkerboard() -> None:
    board = {"checkerboard": {"even": (0, 0, 0), "odd": (1, 1, 1)}}
    assert colors_of((1.0, 0.0, 0.0)) == ((1.0, 0.0, 0.0),)
    assert colors_of(CheckerboardColor.model_validate(board)) == ((0, 0, 0), (1, 1, 1))
