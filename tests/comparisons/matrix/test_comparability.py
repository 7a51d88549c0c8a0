from __future__ import annotations

from typing import Any

import pytest

from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.renderers.closed_form.adapter import ClosedFormRenderer
from raytruth.comparisons.renderers.mitsuba.adapter import mitsuba_llvm
from raytruth.comparisons.renderers.own_tracer import ReferenceTracer
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.scenes.families.catalogue import family
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.lights import shines
from raytruth.scenes.planes import has_planes
from tests.comparisons.matrix.pretending import Pretender
from tests.scenes.exporter_scenes import BALL, GLASS, MIRROR, POINT, RED, build

pytestmark = pytest.mark.clause("VER-8")

DIRECT, PATH, FIRST_HITS, LIGHT_TRACER = mitsuba_llvm().integrators
GREY = {"color": (0.5, 0.5, 0.5)}


def mitsuba(integrator: Integrator, **changes: Any) -> int | str:
    return depth_or_reason(build(**changes), mitsuba_llvm(), integrator)


def test_the_depth_is_that_of_the_light_paths() -> None:
    assert mitsuba(DIRECT, lights=[POINT]) == 0
    assert mitsuba(PATH, lights=[POINT]) == 1
    assert mitsuba(PATH, materials={"m": MIRROR}, background=GREY, max_depth=3) == 1


def test_a_difference_of_light_paths_is_the_reason() -> None:
    assert "EDe" in str(mitsuba(DIRECT, lights=[POINT], background=GREY))


def test_light_traced_forward_needs_point_lights_on_diffuse_surfaces_before_a_perspective_camera() -> None:
    assert mitsuba(LIGHT_TRACER, lights=[POINT]) == 0
    for name in library_names():
        scene = open_scene(name)
        result = depth_or_reason(scene, mitsuba_llvm(), LIGHT_TRACER)
        only_diffuse = {tuple(material.model_dump(exclude_none=True)) for material in scene.materials.values()}
        comparable = scene.convention == "radiometric" and only_diffuse == {("diffuse",)}
        comparable &= all(light.kind == "point" for light in scene.lights) and not shines(scene.background)
        assert (result == 0) == (comparable and scene.camera.projection == "perspective"), (name, result)
    assert "which Whitted's equation sums" in str(
        mitsuba(LIGHT_TRACER, materials={"m": MIRROR}, background=GREY, max_depth=1)
    )
    directional = depth_or_reason(open_scene("directional-light"), mitsuba_llvm(), LIGHT_TRACER)
    parallel = depth_or_reason(open_scene("parallel-projection"), mitsuba_llvm(), LIGHT_TRACER)
    assert "point lights" in str(directional)
    assert "perspective camera" in str(parallel)


@pytest.mark.parametrize(("scale", "seed"), [(100.0, 153), (1e4, 159), (100.0, 168)])
def test_light_traced_forward_is_not_held_to_bounds_that_a_sliver_can_escape(scale: float, seed: int) -> None:
    assert "pixels wide" in str(depth_or_reason(family("drawn", scale, seed), mitsuba_llvm(), LIGHT_TRACER))


def test_what_a_renderer_refuses_comes_before_light_paths() -> None:
    two = build(lights=[POINT], background=GREY, objects=[BALL, BALL])
    assert "2 primitives" in str(depth_or_reason(two, ClosedFormRenderer(), ClosedFormRenderer.integrators[0]))


def test_first_hits_alone_need_shapes_and_a_camera_whatever_the_light_paths() -> None:
    assert mitsuba(FIRST_HITS, lights=[POINT], background=GREY, max_depth=2) == 0
    assert mitsuba(FIRST_HITS, lights=[{**POINT, "falloff": "none"}]) == 0
    first_hits = Integrator("first-hits", "E", gives="first hits")
    refused = depth_or_reason(build(objects=[BALL, BALL]), ClosedFormRenderer(), first_hits)
    assert "2 primitives" in str(refused)


def test_first_hits_that_come_with_an_image_are_not_asked_for_again() -> None:
    assert mitsuba(DIRECT, lights=[POINT]) == 0
    assert "beside its images" in str(mitsuba(FIRST_HITS, lights=[POINT]))
    scenes = {name: open_scene(name) for name in library_names()}
    for name in (name for name, scene in scenes.items() if not has_planes(scene)):  # which Mitsuba does not have at all
        scene = scenes[name]
        with_image = any(isinstance(depth_or_reason(scene, mitsuba_llvm(), known), int) for known in (DIRECT, PATH))
        assert (depth_or_reason(scene, mitsuba_llvm(), FIRST_HITS) == 0) != with_image, name


def test_noisy_scenes_need_a_bound() -> None:
    whitted = Pretender().integrators[0]
    amplifier = {"mirror": {"reflectance": (2.0, 2.0, 2.0)}}
    objects = [BALL, BALL | {"center": (5.0, 0.0, 0.0), "material": "other"}]
    for materials, is_comparable in [
        ({"m": GLASS, "other": MIRROR}, True),
        ({"m": GLASS, "other": amplifier}, False),
        ({"m": MIRROR, "other": amplifier}, True),  # nothing random, and no bound is needed
    ]:
        scene = build(materials=materials, objects=objects, background=GREY, max_depth=2)
        result = depth_or_reason(scene, Pretender(), whitted)
        assert (result == 2) if is_comparable else "no known bound" in str(result)


def test_the_reference_tracer_can_be_held_against_the_truth_of_every_scene() -> None:
    for name in library_names():
        scene = open_scene(name)
        depth = depth_or_reason(scene, ReferenceTracer(), ReferenceTracer.integrators[0])
        assert isinstance(depth, int), name
        assert depth <= scene.max_depth


def test_a_diffuse_surface_that_mirrors_is_not_what_path_tracers_compute() -> None:
    assert isinstance(
        mitsuba(PATH, materials={"m": RED | MIRROR}, objects=[BALL, BALL], lights=[POINT], max_depth=1), str
    )
