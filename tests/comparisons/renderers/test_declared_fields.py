"""Fields of error models where they decide: right renderers pass with what they declare, and not without it."""

from __future__ import annotations

import os
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import distances_in_tolerances
from raytruth.comparisons.judgement.first_hit_test import judge_first_hits
from raytruth.comparisons.records.renderings import Rays
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.comparisons.renderers.protocol import shown_error_model
from raytruth.reference_tracer.rendering import primary_rays
from tests.comparisons import deciding_scenes as scenes

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene

    Change = Callable[[ErrorModel], ErrorModel]

pytestmark = [pytest.mark.clause("REN-4"), pytest.mark.clause("VER-2")]

# Set where every reference must be there (.ci/run): a missing one then fails its tests instead of leaving them out.
REQUIRE_ALL = bool(os.environ.get("RAYTRUTH_REQUIRE_ALL"))
MITSUBA = ("mitsuba", "mitsuba-llvm")


def without(**fields: Any) -> Change:
    return lambda model: replace(model, **fields)


def quarter_offset(model: ErrorModel) -> ErrorModel:
    offset = model.ray_offset
    return replace(model, ray_offset=replace(offset, absolute=offset.absolute / 4, relative=offset.relative / 4))


def no_least_distance(model: ErrorModel) -> ErrorModel:
    return replace(model, ray_offset=replace(model.ray_offset, minimum_distance=0.0), shadow_tolerance=0.0)


# What decides, by the names of renderers: the scene, and the error model that the renderer does not have.
ALONG_THE_RAY = {"triangle_points": "along the ray", "sphere_points": "normalised"}
DECIDING: list[tuple[tuple[str, ...], str, Scene, Change]] = [
    (MITSUBA, "points on triangles", scenes.large_floor(), without(**ALONG_THE_RAY)),
    (MITSUBA, "points on triangles far away", scenes.far_floor(), without(**ALONG_THE_RAY)),
    (MITSUBA, "test of spheres", scenes.far_sphere(), without(sphere_test="accurate")),
    (MITSUBA, "points on spheres", scenes.far_sphere(), without(sphere_points="along the ray")),
    (MITSUBA, "offset", scenes.beside_a_wall(8e-5), quarter_offset),
    (MITSUBA, "end of shadow rays", scenes.lamp_behind_a_plate(), without(shadow_shortening=0.0)),
    (MITSUBA, "precision", scenes.large_floor(), without(precision_bits=30)),
    (("embree",), "offset", scenes.beside_a_wall(8e-5), quarter_offset),
    (("embree", "embree-robust"), "precision", scenes.single_triangle(), without(precision_bits=30)),
    (("povray",), "least distance", scenes.beside_a_wall(8e-8), no_least_distance),
    (("povray",), "farthest", scenes.far_plane(), without(farthest=inf)),
    (("povray",), "output", scenes.single_triangle(), without(output=OutputModel("float32"))),
]
CASES = [
    pytest.param(name, scene, change, id=f"{name}: {field}")
    for names, field, scene, change in DECIDING
    for name in names
    if REQUIRE_ALL or all_renderers()[name].version()
]


def infeasible(renderer: Renderer, scene: Scene, models: list[ErrorModel], folder: Path) -> list[int]:
    """How many pixels and first hits of one rendering no outcome of each model allows."""
    integrator = next(each for each in renderer.integrators if each.name in ("direct", "whitted", "first-hits"))
    if len(renderer.integrators) > 1:
        integrator = next(each for each in renderer.integrators if each.name in ("direct", "whitted"))
    rendering = renderer.render(scene, integrator.name, 0, Rays(*primary_rays(scene)), folder)
    counts = []
    for model in models:
        feasible = feasible_set(scene, model, with_colors=rendering.image is not None)
        count = 0 if rendering.image is None else int((distances_in_tolerances(rendering.image, feasible) > 1).sum())
        hits = rendering.first_hits
        counts.append(count if hits is None else count + judge_first_hits(hits, feasible).failing)
    return counts


@pytest.mark.parametrize(("name", "scene", "change"), CASES)
def test_a_right_renderer_needs_the_field(name: str, scene: Scene, change: Change, tmp_path: Path) -> None:
    renderer = all_renderers()[name]
    declared = shown_error_model(renderer, renderer.version())
    with_it, without_it = infeasible(renderer, scene, [declared, change(declared)], tmp_path)
    assert with_it == 0
    assert without_it > 0


PLAIN = {
    "a large tilted floor": scenes.tilted_floor(),
    "a ball as the ground": scenes.ball_as_ground(),
    "a ball from afar": scenes.ball_from_afar(),
}


@pytest.mark.parametrize("name", [name for name in MITSUBA if REQUIRE_ALL or all_renderers()[name].version()])
@pytest.mark.parametrize("scene", PLAIN.values(), ids=PLAIN.keys())
def test_where_the_offset_is_lost_to_rounding_the_surface_may_shadow_itself(
    scene: Scene, name: str, tmp_path: Path
) -> None:
    renderer = all_renderers()[name]
    assert infeasible(renderer, scene, [shown_error_model(renderer, renderer.version())], tmp_path) == [0]
