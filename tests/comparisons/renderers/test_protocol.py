from __future__ import annotations

import re
from pathlib import Path

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.comparisons.renderers.protocol import (
    error_model_of,
    shown_error_model,
    versions_in_words,
    why_unavailable,
)
from tests.comparisons.matrix.pretending import Pretender

pytestmark = pytest.mark.clause("REN-7")

CONSTRAINTS = Path(__file__).parents[3] / "constraints.txt"
# What each tells of the packages whose versions stand in CONSTRAINTS.
TOLD = {
    "mitsuba": "mitsuba {mitsuba}",
    "mitsuba-llvm": "mitsuba {mitsuba}",
    "cycles": "bpy {bpy}",
    "embree": "embreex {embreex}",
    "embree-robust": "embreex {embreex}",
    "vtk": "pyvista {pyvista}, VTK {vtk}, Mesa 22.3.6",
    "closed_form": "NumPy {numpy}",
}


@pytest.mark.parametrize("name", TOLD)
def test_the_versions_that_are_tested_with_have_an_error_model(name: str) -> None:
    pinned = dict(re.findall(r"^([\w.-]+)==(\S+)$", CONSTRAINTS.read_text(encoding="utf-8"), re.MULTILINE))
    assert why_unavailable(all_renderers()[name], TOLD[name].format_map(pinned)) is None


@pytest.mark.parametrize(
    ("name", "version"),
    [
        ("mitsuba", "mitsuba 3.9.2"),
        ("mitsuba-llvm", "mitsuba 3.10.0"),
        ("mitsuba", "mitsuba 3.9.10"),
        ("cycles", "bpy 5.1.0"),
        ("embree", "embreex 2.17.7"),
        ("vtk", "pyvista 0.49.1, VTK 9.6.0, Mesa 22.3.6"),
        ("povray", "POV-Ray 3.8.0"),
    ],
)
def test_versions_whose_source_nobody_read_are_not_judged(name: str, version: str) -> None:
    renderer = all_renderers()[name]
    assert error_model_of(renderer, version) is None
    reason = str(why_unavailable(renderer, version))
    assert f"{version} is installed" in reason
    assert versions_in_words(renderer) in reason
    assert "\n" not in reason


@pytest.mark.parametrize("name", all_renderers())
def test_an_error_model_is_shown_where_the_renderer_is_missing_too(name: str) -> None:
    renderer = all_renderers()[name]
    assert why_unavailable(renderer, None) == f"not installed: {renderer.install}"
    assert shown_error_model(renderer, None) == renderer.error_models[-1][1]


def test_our_own_code_needs_no_version() -> None:
    assert versions_in_words(all_renderers()["raytruth"]) == "any version"
    assert why_unavailable(all_renderers()["raytruth"], "raytruth 7.0") is None


def test_of_several_error_models_the_first_that_fits_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    one, other = (ErrorModel(name, precision_bits=24) for name in ("one", "other"))
    monkeypatch.setattr(Pretender, "error_models", (("it 1.*", one), ("it *", other)))
    assert (error_model_of(Pretender(), "it 1.2"), error_model_of(Pretender(), "it 2.1")) == (one, other)
    assert versions_in_words(Pretender()) == "it 1.* or it *"
