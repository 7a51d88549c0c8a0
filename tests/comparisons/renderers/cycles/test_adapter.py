"""Cycles itself, end to end: closed forms, feasible sets, and faults planted in its input."""

from __future__ import annotations

import os
import sys
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet, feasible_set
from raytruth.comparisons.judgement.exact_test import judge_image
from raytruth.comparisons.processes.isolation import LOG_FILE
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.renderers.cycles import adapter
from raytruth.comparisons.renderers.cycles.adapter import Cycles
from raytruth.comparisons.renderers.cycles.job import RESULT_FILE, Job
from raytruth.comparisons.renderers.cycles.translation import job_of
from raytruth.reference_tracer.rendering import render as render_reference
from raytruth.scenes.library import open_scene
from tests.comparisons.renderers.sphere_scenes import (
    HEIGHT,
    LIGHTS,
    LOOK_AT,
    WIDTH,
    build,
    diffuse_sphere,
    point_light,
    primary_rays,
    sphere_depth,
    unit,
)

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rendering
    from raytruth.comparisons.records.results import Judgement
    from raytruth.scenes.scene import Scene

    Change = Callable[[dict[str, Any]], None]

pytestmark = pytest.mark.clause("REN-4")

# Set where every reference must be there (.ci/run). There is a wheel of Blender for one Python only.
REQUIRED = bool(os.environ.get("RAYTRUTH_REQUIRE_ALL")) and sys.version_info[:2] == (3, 11)
needs_cycles = pytest.mark.skipif(not REQUIRED and Cycles().version() is None, reason="bpy is not installed")

# Some 2^7 float32 roundings of values about 1.
BOUND = 2e-5
SMALL = (24, 18)


def render(scene: Scene, folder: Path, depth: int = 0) -> Rendering:
    return Cycles().render(scene, "path", depth, primary_rays(scene.camera.projection), folder)


@needs_cycles
@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_a_diffuse_sphere_is_the_closed_form_and_two_lights_add_up(projection: str, tmp_path: Path) -> None:
    scene = build(projection, lights=[point_light(LIGHTS[0], 9.0), point_light(LIGHTS[1], 5.0)])
    rendering = render(scene, tmp_path)
    rays = primary_rays(projection)
    expected = diffuse_sphere(rays, LIGHTS[0], 9.0) + diffuse_sphere(rays, LIGHTS[1], 5.0)
    assert rendering.image is not None
    assert expected.max() > 0.1
    assert np.abs(rendering.image - expected).max() < BOUND
    assert rendering.image.dtype == np.float32
    assert rendering.samples == 1
    assert rendering.batch_means is None
    assert rendering.seconds > 0
    assert {path.name for path in tmp_path.glob("*.blend")} == {"lamp-0.blend", "lamp-1.blend"}


@needs_cycles
def test_a_directional_light_gives_its_irradiance(tmp_path: Path) -> None:
    direction = np.array([-0.4, -1.0, -0.7])
    light = {"kind": "directional", "direction": tuple(direction), "irradiance": (2.0, 3.0, 4.0)}
    image = render(build(lights=[light]), tmp_path).image
    rays = primary_rays()
    depth = sphere_depth(rays, LOOK_AT, 1.2)
    with np.errstate(invalid="ignore"):
        normals = unit(rays.origins + depth[..., None] * rays.directions - LOOK_AT)
        cosine = np.where(np.isfinite(depth), np.maximum(0, normals @ -unit(direction)), 0)
    assert image is not None
    assert np.abs(image - cosine[..., None] * [1.6, 0.9, 0.4] / np.pi).max() < BOUND


@needs_cycles
def test_a_mirror_shows_the_gradient_behind_the_camera_a_miss_the_one_ahead_and_without_depth_it_is_black(
    tmp_path: Path,
) -> None:
    bottom, top, reflectance = np.array([0.3, 0.2, 0.1]), np.array([0.1, 0.2, 0.9]), np.array([0.9, 0.8, 0.7])
    scene = build(
        materials={"red": {"mirror": {"reflectance": tuple(reflectance)}}},
        background={"bottom": tuple(bottom), "top": tuple(top)},
    )
    image, without = (render(scene, tmp_path, depth).image for depth in (1, 0))
    rays = primary_rays()
    depth = sphere_depth(rays, LOOK_AT, 1.2)
    with np.errstate(invalid="ignore"):
        normals = unit(rays.origins + depth[..., None] * rays.directions - LOOK_AT)
        mirrored = rays.directions - 2 * np.sum(rays.directions * normals, axis=-1, keepdims=True) * normals
    hit = np.isfinite(depth)[..., None]
    height = np.where(hit, mirrored, rays.directions)[..., 1:2]
    expected = np.where(hit, reflectance, 1.0) * ((top + bottom) / 2 + height * (top - bottom) / 2)
    assert image is not None
    assert without is not None
    assert np.abs(image - expected).max() < BOUND
    assert not without[hit[..., 0]].any()
    assert np.array_equal(without[~hit[..., 0]], image[~hit[..., 0]])


@needs_cycles
def test_the_mean_over_a_glass_slab_is_the_known_one_and_batches_and_pixels_are_independent(tmp_path: Path) -> None:
    """Straight on, a slab of index n reflects R = 2r/(1+r), r = ((n-1)/(n+1))², all orders of reflection summed."""
    index = 1.9
    r = ((index - 1) / (index + 1)) ** 2
    reflected = 2 * r / (1 + r)
    x, y, z = 60.0, 50.0, 1.0
    corners = [(sx * x, sy * y, -1.0 + sz * z) for sx in (-1, 1) for sy in (-1, 1) for sz in (0, 1)]
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6)]
    faces += [(0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    camera = {"projection": "orthographic", "position": (0.1, 0.2, 4.0), "look_at": (0.1, 0.2, 0.0)}
    scene = build(
        "orthographic",
        camera=camera | {"width": WIDTH, "height": HEIGHT, "view_height": 3.0},
        materials={
            "glass": {"dielectric": {"index_of_refraction": index}},
            "far": {"emission": {"radiance": (1.0, 0.0, 0.25)}},
        },
        objects=[
            {"shape": "mesh", "vertices": corners, "faces": faces, "material": "glass"},
            {"shape": "sphere", "center": (0.0, 0.0, -80.0), "radius": 20.0, "material": "far"},
        ],
    )
    assert Cycles().refuses(scene) is None
    assert Cycles().is_stochastic(scene, "path")
    rendering = render(scene, tmp_path, 40)  # r^40 is nothing
    means = rendering.batch_means
    assert means is not None
    assert rendering.image is not None
    assert means.shape == (adapter.BATCHES, HEIGHT, WIDTH, 3)
    assert np.abs(means.mean(axis=0, dtype=np.float64) - rendering.image).max() < 1e-6
    # Hoeffding 1963, theorem 2: P(|mean - truth| >= t) <= 2·exp(-2·N·t²) for samples in [0, 1].
    count = rendering.samples * WIDTH * HEIGHT
    error = rendering.image.mean(axis=(0, 1), dtype=np.float64) / [1.0, 1.0, 0.25] - [1 - reflected, 0, 1 - reflected]
    assert np.abs(error).max() < np.sqrt(np.log(2e6) / 2 / count)
    # Means of batches of independent samples vary as they must: chi-squared with 128 degrees of freedom, of which 65.8
    # and 218.9 are the quantiles 1e-6 and 1 - 1e-6. A path brings all of the light or none.
    variance = reflected * (1 - reflected) / (adapter.BATCH_SAMPLES * WIDTH * HEIGHT)
    assert adapter.BATCHES == 128
    errors = means[..., 0].mean(axis=(1, 2), dtype=np.float64) - (1 - reflected)
    assert 65.8 < np.sum(errors**2) / variance < 218.9


def small(name: str) -> Scene:
    scene = open_scene(name)
    return scene.resized(*SMALL)


@cache
def feasible(name: str) -> FeasibleSet:
    return feasible_set(small(name), Cycles.error_model)


def judged(name: str, folder: Path) -> Judgement:
    scene = small(name)
    image = render(scene, folder, scene.max_depth).image
    assert image is not None
    return judge_image(image, np.asarray(render_reference(scene), dtype=np.float64), feasible(name))[0]


def scale(change: dict[str, Any], key: str, factor: float) -> None:
    value = change[key]
    change[key] = value * factor if isinstance(value, float) else [number * factor for number in value]


def lamp_of(job: dict[str, Any]) -> dict[str, Any]:
    lamp: dict[str, Any] = job["parts"][0]["lamps"][0]
    return lamp


def closures_of(job: dict[str, Any], kind: str) -> list[dict[str, Any]]:
    materials = [material for part in job["parts"] for material in part["materials"]]
    return [closure for material in materials for closure in material if closure["kind"] == kind]


def swap_squares(job: dict[str, Any]) -> None:
    for closure in closures_of(job, "diffuse"):
        color = closure["color"]
        if color["odd"]:
            color["even"], color["odd"] = color["odd"], color["even"]


def more_bounces(job: dict[str, Any]) -> None:
    job["parts"][-1]["bounces"] += 1


def swap_background(job: dict[str, Any]) -> None:
    job["parts"][-1]["background"] = job["parts"][-1]["background"][::-1]


FAULTS: dict[str, tuple[str, Change]] = {
    "1 % more light": ("sphere-over-floor", lambda job: scale(lamp_of(job), "strength", 1.01)),
    "a light that is moved": ("sphere-over-floor", lambda job: scale(lamp_of(job), "vector", 1.001)),
    "a larger sphere": ("self-shadowing-ring", lambda job: scale(job["objects"][0], "radius", 1.005)),
    "a wider view": ("sphere-over-floor", lambda job: scale(job["camera"], "tangent", 1.001)),
    "a larger picture": ("parallel-projection", lambda job: scale(job["camera"], "view_height", 1.001)),
    "a near end of the world": ("sphere-over-floor", lambda job: scale(job["camera"], "far", 0.2)),
    "a sun that is turned": ("sun-over-tiles", lambda job: lamp_of(job).update(vector=[-0.5, -0.7, -0.5])),
    "squares swapped": ("checkerboard-floor", swap_squares),
    "one bounce more": ("facing-mirrors-depth-2", more_bounces),
    "a gradient upside down": ("convex-mirror", swap_background),
    "a brighter mirror": (
        "coloured-mirrors",
        lambda job: scale(closures_of(job, "mirror")[0]["color"], "even", 1.002),
    ),
}


@needs_cycles
@pytest.mark.parametrize("name", sorted({name for name, _ in FAULTS.values()}))
def test_every_pixel_of_a_scene_lies_in_its_feasible_set(name: str, tmp_path: Path) -> None:
    judgement = judged(name, tmp_path)
    assert judgement.failing == 0, judgement.worst
    assert judgement.unjudged <= 1  # of 432


@needs_cycles
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_in_its_input_is_found(fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    name, change = FAULTS[fault]

    def wrong_job(*arguments: Any) -> Job:
        job = job_of(*arguments).model_dump(mode="json")
        change(job)
        return Job.model_validate(job)

    monkeypatch.setattr(adapter, "job_of", wrong_job)
    assert judged(name, tmp_path).failing > 0


@pytest.mark.clause("REN-5")
def test_without_blender_it_is_missing_and_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter.sys, "executable", "/bin/false")
    adapter._trial.cache_clear()
    assert Cycles().version() is None
    adapter._trial.cache_clear()
    assert "bpy" in Cycles().install


@pytest.mark.clause("REN-1")
def test_a_worker_that_fails_is_one_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter.sys, "executable", "/bin/false")
    with pytest.raises(RendererError, match="exit status 1"):
        render(build(), tmp_path)
    assert (tmp_path / LOG_FILE).exists()


def test_a_worker_that_writes_nothing_is_an_error_even_over_an_old_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / RESULT_FILE).write_bytes(b"old")
    monkeypatch.setattr(adapter, "run_isolated", lambda *_, **__: None)
    with pytest.raises(RendererError, match=r"Cycles's result\.npz cannot be read"):
        render(build(), tmp_path)


def test_the_parent_process_never_loads_blender() -> None:
    Cycles().version()
    assert "bpy" not in sys.modules
