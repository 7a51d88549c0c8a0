"""Every feasible set holds the truth, and tells what is due from what a shortcut alone leads to."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.shortcuts import without_shortcuts
from raytruth.comparisons.feasible_sets.declared_outcomes import Outcomes, beside_what_is_due, with_truth
from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet, feasible_set
from raytruth.comparisons.measures.visibility import differs_visibly
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.reference_tracer.certification import Undecided
from raytruth.reference_tracer.certified_image import CertifiedImage, certified_image
from raytruth.scenes.families.catalogue import family
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2", "VER-14")

# Offsets that show: as large as the gaps between objects of these scenes.
COARSE = {
    "an offset along the normal": RayOffset(absolute=0.4),
    "an offset along the ray": RayOffset(absolute=0.4, along="direction", excludes_surface=False),
    "a least distance": RayOffset(minimum_distance=0.4, excludes_surface=False),
}
MODELS = {
    **{name: ErrorModel(name, 24, offset, output=OutputModel("float64")) for name, offset in COARSE.items()},
    **{name: renderer.error_models[0][1] for name, renderer in all_renderers().items() if name != "vtk"},
}
SCENES = ("coloured-mirrors", "concave-mirror", "self-shadowing-ring", "glass-sphere", "sphere-over-floor")
FAMILIES = (("scale", 1e-3), ("sphere-size", 1e-3), ("light-near-surface", 1e-6), ("camera-near-surface", 1e-6))


# Two kinds of names: scenes of the library, and families with a parameter.
Place = tuple[str, float | None]
PLACES: tuple[Place, ...] = (*((name, None) for name in SCENES), *FAMILIES)


@cache
def scene_of(place: Place) -> Scene:
    name, parameter = place
    return library_scene(name) if parameter is None else family(name, parameter).resized(12, 9)


@cache
def truth_of(place: Place) -> CertifiedImage:
    return certified_image(scene_of(place))


def holds_truth(feasible: FeasibleSet, truth: CertifiedImage) -> NDArray[np.bool_]:
    """Where an outcome that is due holds the enclosure of the truth, which float64 has rounded."""
    slack = 2.0**-52 * np.abs(truth.middle)
    low, high = truth.middle - truth.radius + slack, truth.middle + truth.radius - slack
    inside = (feasible.low <= np.minimum(low, high)[:, :, np.newaxis]) & (
        np.maximum(low, high)[:, :, np.newaxis] <= feasible.high
    )
    return np.asarray((inside.all(axis=3) & feasible.due).any(axis=2))


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("place", PLACES, ids=str)
def test_every_set_holds_the_truth_as_what_is_due(place: Place, model: str) -> None:
    truth = truth_of(place)
    exact = replace(MODELS[model], output=OutputModel("float64"))
    feasible = feasible_set(scene_of(place), exact, truth=truth)
    judged = truth.decided & (feasible.outcomes > 0)
    assert (feasible.due.any(axis=2) | (feasible.outcomes == 0)).all()
    wrong = np.argwhere(judged & ~holds_truth(feasible, truth)).tolist()
    assert wrong == [], f"{place}, {model}: pixels (row, column) {wrong}"
    assert (feasible.outcomes > 0).mean() > 0.5


@pytest.mark.parametrize("model", COARSE)
def test_the_truth_only_spares_work(model: str) -> None:
    place: Place = ("coloured-mirrors", None)
    quick = feasible_set(scene_of(place), MODELS[model], truth=truth_of(place))
    slow = feasible_set(scene_of(place), MODELS[model])
    low, high = slow.hull(due_only=True)
    quick_low, quick_high = quick.hull(due_only=True)
    # Where the quick one has not looked, all that is declared looks as is due. It may miss another outcome of an edge.
    on_edges = (slow.due & ~np.isnan(slow.low[..., 0])).sum(axis=2) > 1
    assert not differs_visibly(low, quick_low)[~on_edges].any()
    assert not differs_visibly(high, quick_high)[~on_edges].any()
    assert on_edges.mean() < 0.2


@pytest.mark.parametrize("model", COARSE)
def test_a_coarse_shortcut_shows_somewhere_and_no_shortcut_nowhere(model: str) -> None:
    sets = [
        [feasible_set(scene_of((name, None)), kind, truth=truth_of((name, None))) for name in SCENES]
        for kind in (MODELS[model], without_shortcuts(MODELS[model]))
    ]
    assert [any(not feasible.due.all() for feasible in of_kind) for of_kind in sets] == [True, False]


ENDS = st.tuples(st.floats(0, 1), st.floats(0, 1)).map(lambda ends: (min(ends), max(ends)))
BOXES = st.lists(st.tuples(ENDS, ENDS, ENDS).map(list), max_size=3)


@given(declared=BOXES, due=BOXES)
def test_nothing_feasible_is_lost_and_nothing_due_is_marked_otherwise(
    declared: list[list[tuple[float, float]]], due: list[list[tuple[float, float]]]
) -> None:
    both = beside_what_is_due(
        Outcomes(declared, [True] * len(declared), merged=False), Outcomes(due, [True] * len(due), merged=False)
    )
    if not due:
        assert both.boxes == declared
        return
    assert [box for box, is_due in zip(both.boxes, both.due, strict=True) if is_due] == due
    for box in declared:
        holders = [
            other for other in both.boxes if all(o[0] <= b[0] and b[1] <= o[1] for b, o in zip(box, other, strict=True))
        ]
        assert holders


@given(boxes=BOXES.filter(len), flags=st.lists(st.booleans(), min_size=3, max_size=3), value=st.floats(0, 1))
def test_the_truth_is_held_by_what_is_due_and_widens_no_box_that_looks_different(
    boxes: list[list[tuple[float, float]]], flags: list[bool], value: float
) -> None:
    truth = CertifiedImage(np.full((1, 1, 3), value), np.full((1, 1, 3), 2.0**-60), np.ones((1, 1), dtype=np.int64), {})
    before = Outcomes(boxes, [True, *flags[1 : len(boxes)]], merged=False)
    after = with_truth(before, (0, 0), truth)
    assert any(
        is_due and all(low <= value <= high for low, high in box)
        for box, is_due in zip(after.boxes, after.due, strict=True)
    )
    assert (after.due[: len(boxes)], after.merged) == (before.due, before.merged)
    for old, new in zip(boxes, after.boxes, strict=False):
        assert all(n[0] <= o[0] and o[1] <= n[1] for o, n in zip(old, new, strict=True))
        assert not differs_visibly(old, new).any()
    unknown = replace(truth, undecided={(0, 0): Undecided((0.0,) * 3, (0.0,) * 3, (), "a tie")})
    assert with_truth(before, (0, 0), unknown) == before
    assert with_truth(before, (0, 0), None) == before
