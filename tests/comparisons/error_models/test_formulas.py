"""The list of formulas that people are shown."""

from __future__ import annotations

from pathlib import Path
from typing import get_args, get_type_hints

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.formulas import FORMULAS

pytestmark = pytest.mark.clause("VER-1")

OF_REFERENCES = {"from the foot", "from the foot, accurate for shadows", "put back"}
"""Which nobody has but Mitsuba."""


def test_every_value_that_can_be_declared_has_a_line_of_code_and_no_other() -> None:
    shown = {(formula.field, formula.value) for formula in FORMULAS}
    assert len(shown) == len(FORMULAS)
    types = get_type_hints(ErrorModel)
    fields = {field for field, _ in shown}
    values = {(field, value) for field in fields for value in get_args(types[field])}
    assert values - shown == {(field, value) for field, value in values if value in OF_REFERENCES}
    assert shown <= values
    assert all(formula.code for formula in FORMULAS)


def test_the_words_of_an_error_model_tell_the_code() -> None:
    words = ErrorModel("", 24, sphere_test="quadratic", refraction="bec", sphere_points="normalised").in_words()
    assert words["spheres"] == "quadratic: t = (-b - sqrt(b*b - 4*a*c)) / (2*a), c = dot(o-C, o-C) - r*r"
    assert words["points on spheres"] == "normalised: n = normalize(p - C)"
    assert words["refraction"].startswith("bec: w = e*c1;")
    assert ErrorModel("", 24, sphere_test="from the foot").in_words()["spheres"] == "from the foot"


def test_the_documents_table_is_this_list() -> None:
    text = (Path(__file__).parents[3] / "docs" / "error-models.md").read_text(encoding="utf-8")
    told = [line.replace("\\|", "|") for line in text.splitlines() if line.startswith("| `")]
    for formula in FORMULAS:
        assert f"| `{formula.field}` | {formula.value} | `{formula.code}` |" in told
