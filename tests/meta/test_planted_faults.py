"""The suite can fail: each fault planted in the tracer makes a cell fail, and without it the same cell passes."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.verdict import Expectation, expectation_of
from raytruth.comparisons.matrix.cell import run_cell
from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.records.renderings import Rays
from raytruth.comparisons.records.results import Cell, Verdict
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.rendering import primary_rays, render
from raytruth.scenes.library import open_scene
from tests.comparisons.matrix.cell_places import place_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from raytruth.comparisons.records.renderings import Rendering
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-12")

CLOSED_FORM = ("closed_form", "local")
DIRECT = ("mitsuba", "direct")
PATH = ("mitsuba-llvm", "path")

# A fault of the catalogue, a scene where it shows, and the renderer that is right.
PLANTED = [
    ("mirrored_image", "self-shadowing-ring", DIRECT),
    ("half_a_pixel_off", "single-sphere", CLOSED_FORM),
    ("one_over_distance", "single-sphere", CLOSED_FORM),
    ("no_shadow_rays", "sphere-over-floor", DIRECT),
    ("missing_clamp", "single-sphere", CLOSED_FORM),
    ("every_ray_enters", "glass-sphere", PATH),
    ("inverted_index_ratio", "glass-sphere", PATH),
    ("no_total_internal_reflection", "total-reflection-prism", PATH),
    ("schlick", "total-reflection-prism", PATH),
    ("reflection_one_percent_too_dark", "mirror-icosahedron", ("mitsuba", "path")),
    ("horizontal_field_of_view", "sphere-over-floor", DIRECT),
    ("phong_for_blinn", "blinn-sphere", CLOSED_FORM),
]


@pytest.mark.parametrize(("fault", "scene_name", "judge"), PLANTED, ids=[fault for fault, *_ in PLANTED])
def test_a_planted_fault_makes_a_cell_fail_that_passes_without_it(
    fault: str, scene_name: str, judge: tuple[str, str], tmp_path: Path
) -> None:
    assert _judge(scene_name, judge, {}, tmp_path).verdict == Verdict.PASS
    cell = _judge(scene_name, judge, all_faults()[fault].overrides, tmp_path)
    assert cell.verdict == Verdict.FAIL, f"{fault} went unnoticed: {cell.reason}"


def test_brightness_off_by_one_part_in_ten_thousand_makes_a_cell_fail(tmp_path: Path) -> None:
    scene = _small("single-sphere")
    rendering = _rendered("single-sphere", DIRECT)
    expectation = _expectation(scene, all_renderers()["mitsuba"].error_model, {})
    brighter = _Prepared("mitsuba", rendering.__class__(rendering.image * np.float32(1 + 1e-4), 0.0))
    cell = run_cell(place_of(scene, brighter, DIRECT[1]), 1, expectation, tmp_path)
    assert cell.verdict == Verdict.FAIL


class _Prepared:
    """A renderer whose rendering exists already."""

    def __init__(self, name: str, rendering: Rendering) -> None:
        self.name = name
        self.rendering = rendering
        self.integrators = all_renderers()[name].integrators
        self.error_models = all_renderers()[name].error_models
        self.install = ""

    def version(self) -> str:
        return "1"

    def refuses(self, scene: Scene) -> None:
        return None

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:
        return self.rendering.batch_means is not None

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:
        return self.rendering


def _judge(scene_name: str, judge: tuple[str, str], overrides: Mapping[str, Callable[..., Any]], folder: Path) -> Cell:
    """The cell of a right renderer, with a truth that may have a fault."""
    scene = _small(scene_name)
    expectation = _expectation(scene, all_renderers()[judge[0]].error_model, overrides)
    renderer = _Prepared(judge[0], _rendered(scene_name, judge))
    return run_cell(place_of(scene, renderer, judge[1]), 1, expectation, folder)


def _expectation(scene: Scene, error_model: Any, overrides: Mapping[str, Callable[..., Any]]) -> Expectation:
    behaviour = Behaviour(overrides)
    truth = np.array(render(scene, FLOAT, behaviour), dtype=np.float64)
    return expectation_of(scene, truth, feasible_set(scene, error_model, behaviour))


@cache
def _rendered(scene_name: str, judge: tuple[str, str]) -> Rendering:
    """Without first hits, which would tell many faults before the picture does."""
    scene = _small(scene_name)
    renderer = all_renderers()[judge[0]]
    integrator = next(integrator for integrator in renderer.integrators if integrator.name == judge[1])
    depth = depth_or_reason(scene, renderer, integrator)
    assert isinstance(depth, int), depth
    rays = Rays(*primary_rays(scene))
    rendering = renderer.render(scene, judge[1], depth, rays, Path(mkdtemp(prefix="raytruth-")))
    return rendering.__class__(rendering.image, 0.0, None, rendering.samples, rendering.batch_means)


def _small(scene_name: str) -> Scene:
    """The scene with a third of the pixels a side, half for noisy ones: enough to show these faults."""
    scene = open_scene(scene_name)
    camera = scene.camera
    share = 2 if any(material.dielectric for material in scene.materials.values()) else 3
    return scene.resized(camera.width // share, camera.height // share)
