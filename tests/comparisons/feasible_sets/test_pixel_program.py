"""The program that evaluates pixels: for which behaviours there is one, and how many are needed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.shortcuts import without_shortcuts
from raytruth.comparisons.feasible_sets.pixel_program import pixel_program
from raytruth.comparisons.feasible_sets.rounded_rays import PlainRays
from raytruth.comparisons.feasible_sets.set_arithmetics import DOUBLE_DOUBLES, FLOATS, set_arithmetic
from raytruth.comparisons.renderers.catalogue import all_renderers
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from raytruth.comparisons.feasible_sets.pixel_program import PixelProgram

pytestmark = pytest.mark.clause("ARI-12", "VER-2")

TRIANGLE = library_scene("single-triangle", 4, 3)


def program_for(model: ErrorModel, scene_name: str = "single-triangle") -> PixelProgram:
    balls = set_arithmetic(model.precision_bits)
    assert balls is not None, "all renderers have an arithmetic that compiled balls serve"
    return pixel_program(PlainRays(library_scene(scene_name, 4, 3), model).behaviour, balls)


def test_the_compiler_knows_what_every_renderer_declares() -> None:
    models = [model for renderer in all_renderers().values() for _, model in renderer.error_models]
    programs = {program_for(each) for model in models for each in (model, without_shortcuts(model), model.of_light())}
    for made in programs:
        assert "color_pixels" in made.program.ir_text()


def test_one_program_serves_all_scenes_and_all_numbers() -> None:
    near, far = (ErrorModel("", 24, RayOffset(absolute=length)) for length in (1e-4, 1e-2))
    assert program_for(near) is program_for(far) is program_for(near, "glass-sphere")
    assert program_for(near) is not program_for(ErrorModel("", 24))


def test_each_arithmetic_has_a_program_of_its_own() -> None:
    behaviour = PlainRays(TRIANGLE, ErrorModel("", 24)).behaviour
    assert pixel_program(behaviour, FLOATS) is not pixel_program(behaviour, DOUBLE_DOUBLES)
