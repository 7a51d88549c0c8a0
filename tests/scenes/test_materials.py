from __future__ import annotations

import pytest
from pydantic import ValidationError

from raytruth.scenes.materials import CheckerboardColor, Diffuse, Material

pytestmark = pytest.mark.clause("SCN-1")


def test_a_material_states_a_term_that_is_not_null() -> None:
    with pytest.raises(ValidationError, match="expected at least one term"):
        Material(diffuse=None)
    assert Material(diffuse=Diffuse(reflectance=(0.5, 0.5, 0.5))).mirror is None


def test_a_reflectance_is_a_color_or_a_checkerboard() -> None:
    board = {"checkerboard": {"even": [0, 0, 0], "odd": [1, 1, 1]}}
    assert Diffuse.model_validate({"reflectance": [1, 0, 0]}).reflectance == (1, 0, 0)
    assert isinstance(Diffuse.model_validate({"reflectance": board}).reflectance, CheckerboardColor)
