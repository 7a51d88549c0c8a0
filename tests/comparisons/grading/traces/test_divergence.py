from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.grading.traces.divergence import compared
from raytruth.comparisons.matrix.quick_suite import small
from raytruth.reports.trace_text import WHAT, comparison_text
from raytruth.scenes.library import open_scene
from tests.comparisons.grading.traces.right_trees import MODELS, changed, right_tree

if TYPE_CHECKING:
    from raytruth.comparisons.grading.traces.ray_lines import RayLine
    from raytruth.comparisons.records.ray_tree_results import Comparison
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("GRD-9")

SCENES = ("glass-sphere", "tinted-glass", "concave-mirror", "total-reflection-prism", "two-lights")
GLASS = ("glass-sphere", 10, 7)


@cache
def scene_of(name: str) -> Scene:
    return small(open_scene(name))


@cache
def tree(name: str, column: int, row: int) -> dict[str, RayLine]:
    return right_tree(scene_of(name), column, row)


def of_glass(rays: dict[str, RayLine]) -> Comparison:
    name, column, row = GLASS
    return compared(scene_of(name), MODELS, column, row, rays)


@given(st.sampled_from(SCENES), st.floats(0, 0.99), st.floats(0, 0.99))
def test_a_right_tree_agrees_in_all_of_its_rays(name: str, across: float, down: float) -> None:
    camera = scene_of(name).camera
    column, row = int(across * camera.width), int(down * camera.height)
    rays = tree(name, column, row)
    found = compared(scene_of(name), MODELS, column, row, rays)
    assert found.divergence is None, found
    assert found.agreed == len(rays) or found.open_paths


OTHER_VALUES: dict[str, Any] = {
    "origin": (0.0, 0.0, 9.0),
    "direction": (0.0, 1.0, 0.0),
    "primitive": 99,
    "distance": 123.0,
    "normal": (0.0, 1.0, 0.0),
    "local": (7.0, 7.0, 7.0),
    "color": (7.0, 7.0, 7.0),
}


@pytest.mark.parametrize("what", OTHER_VALUES)
@pytest.mark.parametrize("path", ["", "T", "TR"])
def test_the_one_value_that_is_wrong_is_told_with_its_ray(path: str, what: str) -> None:
    found = of_glass(changed(tree(*GLASS), path, **{what: OTHER_VALUES[what]}))
    assert found.divergence is not None
    assert (found.divergence.path, found.divergence.what) == (path, what)
    assert WHAT[what] in comparison_text(found)


def test_a_little_more_than_rounding_is_a_difference_and_rounding_is_none() -> None:
    rays = tree(*GLASS)
    distance = rays["T"].distance
    assert distance is not None
    assert of_glass(changed(rays, "T", distance=distance * (1 + 1e-14))).divergence is None
    assert of_glass(changed(rays, "T", distance=distance * (1 + 1e-9))).divergence is not None


def test_a_ray_that_is_missing_or_too_much_is_told() -> None:
    rays = tree(*GLASS)
    found = of_glass({path: ray for path, ray in rays.items() if not path.startswith("TT")})
    assert found.divergence is not None
    assert (found.divergence.path, found.divergence.what) == ("TT", "missing")
    found = of_glass(rays | {"M": rays["R"].model_copy(update={"path": "M"})})
    assert found.divergence is not None
    assert (found.divergence.path, found.divergence.what) == ("M", "extra")


def test_what_is_not_printed_is_not_compared() -> None:
    bare = {path: type(ray)(path=path) for path, ray in tree(*GLASS).items()}
    assert of_glass(bare).divergence is None
    assert of_glass(bare).agreed == len(bare)


def test_the_first_wrong_ray_is_told_and_not_what_follows_from_it() -> None:
    rays = changed(tree(*GLASS), "TT", direction=(0.0, 1.0, 0.0))
    found = of_glass(changed(rays, "", color=(7.0, 7.0, 7.0)))
    assert found.divergence is not None
    assert found.divergence.path == "TT"
