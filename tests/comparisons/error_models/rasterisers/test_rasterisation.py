"""A float32 rasteriser lies in the feasible sets of its model; one that does otherwise does not."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation
from raytruth.comparisons.feasible_sets.feasible_set import UNUSED, feasible_set
from raytruth.comparisons.judgement.first_hit_test import judge_first_hits
from raytruth.reference_tracer.rendering import first_hits, prepare
from tests.comparisons.drawn_triangles import ORTHOGRAPHIC, PERSPECTIVE, drawn, triangle_scene

if TYPE_CHECKING:
    from raytruth.comparisons.records.renderings import FirstHits

MODEL = ErrorModel("", 24, rasterisation=Rasterisation(subpixel_bits=8, depth_bits=24, light_bits=22))
PROJECTIONS = pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC], ids=["perspective", "orthographic"])
pytestmark = pytest.mark.clause("VER-2")


@PROJECTIONS
@pytest.mark.parametrize("seed", range(4))
def test_what_float32_draws_is_feasible_and_hardly_a_pixel_is_ambiguous(projection: dict[str, Any], seed: int) -> None:
    scene = triangle_scene(seed, projection)
    feasible = feasible_set(scene, MODEL)
    judged = judge_first_hits(drawn(scene), feasible)
    assert judged.failing == 0
    assert judged.compared == feasible.hit_primitives[..., 0].size
    assert judged.ambiguous < judged.compared / 20
    assert (feasible.hit_primitives >= 0).any(axis=2).sum() > judged.compared / 20


@PROJECTIONS
def test_the_truth_is_feasible(projection: dict[str, Any]) -> None:
    scene = triangle_scene(5, projection)
    distance, primitive = first_hits(prepare(scene))
    feasible = feasible_set(scene, MODEL)
    fits = (feasible.hit_primitives == primitive[..., np.newaxis]) & (
        (primitive[..., np.newaxis] < 0)
        | (
            (feasible.hit_low[..., 0] <= distance[..., np.newaxis])
            & (distance[..., np.newaxis] <= feasible.hit_high[..., 0])
        )
    )
    assert fits.any(axis=2).all()


def flipped(hits: FirstHits) -> FirstHits:
    return replace(hits, **{name: values[::-1] for name, values in vars(hits).items()})


def farther(hits: FirstHits) -> FirstHits:
    return replace(hits, depth=hits.depth * (1 + 2.0**-12))


def renumbered(hits: FirstHits) -> FirstHits:
    return replace(hits, primitive=np.where(hits.primitive < 0, -1, 15 - hits.primitive))


@pytest.mark.clause("VER-3")
@PROJECTIONS
@pytest.mark.parametrize("fault", [flipped, farther, renumbered])
def test_a_fault_fails(projection: dict[str, Any], fault: Any) -> None:
    scene = triangle_scene(1, projection)
    assert judge_first_hits(fault(drawn(scene)), feasible_set(scene, MODEL)).failing > 0


@pytest.mark.clause("VER-3")
@PROJECTIONS
def test_a_coarser_grid_than_declared_fails(projection: dict[str, Any]) -> None:
    scene = triangle_scene(2, projection)
    feasible = feasible_set(scene, MODEL)
    assert judge_first_hits(drawn(scene, subpixel_bits=3), feasible).primitive_mismatches > 0
    coarse = replace(MODEL, rasterisation=Rasterisation(subpixel_bits=3, depth_bits=24, light_bits=22))
    # What is drawn is covered, but depths of small triangles that reach so far beyond their edges are of no use.
    assert judge_first_hits(drawn(scene, subpixel_bits=3), feasible_set(scene, coarse)).primitive_mismatches == 0


@pytest.mark.clause("VER-3")
def test_one_wrong_pixel_inside_a_triangle_fails() -> None:
    scene = triangle_scene(3, PERSPECTIVE)
    hits, feasible = drawn(scene), feasible_set(scene, MODEL)
    certain = (feasible.hit_primitives != UNUSED).sum(axis=2) == 1
    y, x = np.argwhere(certain & (hits.primitive >= 0))[0]
    primitive = hits.primitive.copy()
    primitive[y, x] = (primitive[y, x] + 1) % 16
    judged = judge_first_hits(replace(hits, primitive=primitive), feasible)
    assert (judged.failing, judged.primitive_mismatches) == (1, 1)


def test_surfaces_nearer_to_each_other_than_the_buffer_resolves_may_hide_each_other() -> None:
    scene = triangle_scene(4, ORTHOGRAPHIC, triangles=1)
    (front,) = scene.objects
    forward = np.subtract(scene.camera.look_at, scene.camera.position)
    forward /= np.linalg.norm(forward)
    for gap, hidden in ((1e-7, False), (1e-2, True)):
        behind = front.model_copy(
            update={"vertices": tuple(tuple(np.add(corner, gap * forward)) for corner in front.vertices)}
        )
        feasible = feasible_set(scene.model_copy(update={"objects": (front, behind)}), MODEL)
        outcomes = (feasible.hit_primitives != UNUSED).sum(axis=2)
        inside = (feasible.hit_primitives == 0).any(axis=2) & ~(feasible.hit_primitives == -1).any(axis=2)
        assert inside.sum() > 5
        assert (np.median(outcomes[inside]) == 1) == hidden
