"""POV-Ray itself, end to end: what it renders lies in its feasible sets, and with a fault in the export it does not."""

from __future__ import annotations

import os
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet, feasible_set
from raytruth.comparisons.judgement.exact_test import judge_image
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.renderers import povray as adapter
from raytruth.comparisons.renderers.povray import PovRay
from raytruth.comparisons.renderers.protocol import why_unavailable
from raytruth.reference_tracer.rendering import render as render_reference
from raytruth.scenes.exporters.povray import export_povray
from raytruth.scenes.library import open_scene
from tests.comparisons.renderers.sphere_scenes import build, point_light, primary_rays

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Image
    from raytruth.comparisons.records.results import Judgement
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-4")

# Set where every reference must be there (.ci/run): a missing one then fails its tests instead of leaving them out.
REQUIRE_ALL = bool(os.environ.get("RAYTRUTH_REQUIRE_ALL"))
needs_povray = pytest.mark.skipif(PovRay().version() is None and not REQUIRE_ALL, reason="POV-Ray is not installed")

WIDTH, HEIGHT = 24, 18


def small(name: str) -> Scene:
    scene = open_scene(name)
    return scene.resized(WIDTH, HEIGHT)


@cache
def feasible(name: str) -> FeasibleSet:
    return feasible_set(small(name), PovRay.error_model)


def rendered(scene: Scene, folder: Path) -> Image:
    return PovRay().render(scene, "whitted", scene.max_depth, primary_rays(), folder).image


def judged(name: str, folder: Path) -> Judgement:
    scene = small(name)
    truth = np.asarray(render_reference(scene), dtype=np.float64)
    return judge_image(rendered(scene, folder), truth, feasible(name))[0]


# A scene, what is written, and what a fault would write instead.
FAULTS = [
    ("whitted-1980", "phong_size 97.0", "phong_size 96.0"),
    ("whitted-1980", "ior 1.31", "ior 1.3101"),
    ("whitted-1980", "max_trace_level 6", "max_trace_level 5"),
    ("whitted-1980", "adc_bailout 0", "adc_bailout 1/20"),
    ("whitted-1980", "conserve_energy", ""),
    ("whitted-1980", "no_image no_reflection", "no_image no_reflection no_shadow"),
    ("whitted-1980", "right rightward", "right -rightward"),
    ("whitted-1980", "radians(38.0/2)", "radians(38.01/2)"),
    ("whitted-1980", "x/unit - 0.31", "x/unit + 0.31"),
    ("whitted-1980", "ambient_light rgb <0.83,", "ambient_light rgb <0.831,"),
    ("whitted-1980", "translate -2*y", "translate -2.001*y"),
    ("whitted-1980", "0.83, 0.85, 0.89>/faint", "0.83, 0.85, 0.891>/faint"),
    ("constant-weight-glass", "fade_power 2", "fade_power 0.5"),
    ("tinted-glass", "0.89, 0.21, 0.61>/unit", "0.891, 0.21, 0.61>/unit"),
    ("blinn-sphere", "roughness 1/23.0", "roughness 1/23.1"),
    ("blinn-sphere", "specular 1/faint", "phong 1/faint phong_size 23"),
    ("directional-phong", "point_at (", "point_at 1.001*("),
    ("falloff-polynomial", "0.5/max(1, ", "0.5/max(1.01, "),
    ("falloff-inverse-square", "fade_power 2", "fade_power 1.99"),
    ("parallel-projection", "orthographic", "perspective"),
    ("total-reflection-prism", "interior_texture { material_0_inside }", ""),
    ("camera-under-water", "hollow no_shadow", "hollow no_shadow translate 0.01*unit*x"),
]


@needs_povray
@pytest.mark.parametrize("name", sorted({fault[0] for fault in FAULTS}))
def test_every_pixel_of_a_scene_lies_in_its_feasible_set(name: str, tmp_path: Path) -> None:
    judgement = judged(name, tmp_path)
    assert (judgement.failing, judgement.unjudged) == (0, 0), judgement.worst
    assert (tmp_path / "scene.pov").read_text(encoding="utf-8").count("#declare exposure = 1.0;") == 1


@needs_povray
@pytest.mark.parametrize(("name", "right", "wrong"), FAULTS)
def test_a_fault_in_the_export_is_found(
    name: str, right: str, wrong: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def export_wrongly(scene: Scene, folder: Path, **options: Any) -> Path:
        path = export_povray(scene, folder, **options)
        text = path.read_text(encoding="utf-8")
        assert right in text
        path.write_text(text.replace(right, wrong), encoding="utf-8")
        return path

    monkeypatch.setattr(adapter, "export_povray", export_wrongly)
    assert judged(name, tmp_path).failing > 0


@needs_povray
def test_what_is_brighter_than_one_is_read_from_a_darker_picture(tmp_path: Path) -> None:
    radiance = (37.5, 0.3, 1.0)
    scene = build(materials={"red": {"emission": {"radiance": radiance}}})
    image = rendered(scene, tmp_path)
    center = image[image.shape[0] // 2, image.shape[1] // 2]
    low, high = PovRay.error_model.output.interval_read(np.array(radiance), np.array(radiance))
    assert ((low <= center) & (center <= high)).all()
    assert (high - low < 4 * np.array([64, 1, 2]) / 65535).all()


@needs_povray
@pytest.mark.parametrize("radius", [1e3, 1e5])
def test_a_ground_sphere_lies_in_its_feasible_set_whatever_the_unit(radius: float, tmp_path: Path) -> None:
    ball = small("single-sphere").objects[0].model_copy(update={"center": (0.0, 1.0, 0.0), "radius": 1.0})
    ground = ball.model_copy(update={"center": (0.0, -radius, 0.0), "radius": radius})
    scene = small("single-sphere").model_copy(update={"objects": (ball, ground)})
    truth = np.asarray(render_reference(scene), dtype=np.float64)
    judgement, *_ = judge_image(
        rendered(scene, tmp_path), truth, feasible_set(scene, PovRay.error_model.in_scene(scene))
    )
    assert (judgement.failing, judgement.unjudged) == (0, 0), judgement.worst


@needs_povray
def test_the_depth_that_is_asked_for_is_rendered(tmp_path: Path) -> None:
    scene = small("facing-mirrors-depth-2")
    deep = PovRay().render(scene, "whitted", 2, primary_rays(), tmp_path).image
    flat = PovRay().render(scene, "whitted", 0, primary_rays(), tmp_path).image
    assert (deep != flat).any()
    truth = np.asarray(render_reference(scene.model_copy(update={"max_depth": 0})))
    assert np.abs(flat - truth).max() < 2 / 65535


@needs_povray
def test_the_program_is_of_the_version_that_the_error_model_is_of() -> None:
    assert str(PovRay().version()).startswith("POV-Ray 3.7")


def pretend(monkeypatch: pytest.MonkeyPatch, folder: Path, script: str) -> None:
    """Put a script in the program's place."""
    folder.mkdir()
    program = folder / "povray"
    program.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")


@pytest.mark.parametrize(
    ("script", "message"),
    [
        ("echo no light here >&2; exit 3", "exit status 3; its log ends: no light here"),
        ("true", "cannot be read"),
        ("head -c 100 /dev/zero > picture.png", "cannot be read"),
        ("kill -ABRT $$", "SIGABRT"),
    ],
)
def test_a_program_that_fails_gives_a_renderer_error(
    script: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pretend(monkeypatch, tmp_path / "bin", script)
    with pytest.raises(RendererError, match=message):
        rendered(build(lights=[point_light(np.array([1.0, 2.0, 3.0]), 2.0)]), tmp_path)


@pytest.mark.parametrize("told", ["exit 1", "echo Povray the game, POV-Ray 3.7.0.10", "echo POV-Ray of my own"])
def test_another_program_of_that_name_counts_as_none(
    told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pretend(monkeypatch, tmp_path / "bin", told)
    adapter._version.cache_clear()
    assert PovRay().version() is None
    monkeypatch.undo()
    adapter._version.cache_clear()


@pytest.mark.clause("REN-7")
@pytest.mark.parametrize(
    ("version", "is_judged"), [("3.7.0.8", True), ("3.6.1", False), ("3.7.1-beta", False), ("3.8.0-beta.2", False)]
)
def test_another_version_is_told_and_not_judged(
    version: str, is_judged: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pretend(monkeypatch, tmp_path / "bin", f"echo POV-Ray {version}")
    adapter._version.cache_clear()
    assert PovRay().version() == f"POV-Ray {version}"
    assert (why_unavailable(PovRay(), PovRay().version()) is None) == is_judged
    monkeypatch.undo()
    adapter._version.cache_clear()


def test_no_program_counts_as_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    adapter._version.cache_clear()
    assert PovRay().version() is None
    monkeypatch.undo()
    adapter._version.cache_clear()
