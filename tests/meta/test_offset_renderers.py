"""Renderers with every policy of ray offsets, simulated: they pass by their own error model, and not by another.

Each is the tracer's source with the policy's overrides, run in plain float32 or float64, one rounding at a time.
"""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.ray_offsets import offset_behaviour
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import distances_in_tolerances
from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import merged
from raytruth.reference_tracer.rendering import prepare, render_prepared
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet

pytestmark = pytest.mark.clause("VER-2")

BITS = {"float32": 24, "float64": 53}
# Far above rounding in either format, and far enough to be seen in an image.
FAR = 2.0**-7
POLICIES = {
    "none": RayOffset(),
    "Mitsuba's": RayOffset(FAR, FAR),
    "absolute": RayOffset(absolute=FAR),
    "relative": RayOffset(relative=FAR),
    "absolute, tested": RayOffset(absolute=FAR, excludes_surface=False),
    "along the ray": RayOffset(absolute=FAR, along="direction", excludes_surface=False),
    "least distance": RayOffset(minimum_distance=FAR, excludes_surface=False),
}
# Shadows on spheres and triangles, a mirror seen from inside a sphere, glass with absorption.
SCENES = ("sphere-over-floor", "self-shadowing-ring", "concave-mirror", "tinted-glass")


def model_of(policy: RayOffset, numbers: str) -> ErrorModel:
    # One bit for the last place of the mathematical library.
    return ErrorModel("simulated", BITS[numbers] - 1, policy, 2.0**-8, output=OutputModel("float64"))


def rendered(scene_name: str, policy: RayOffset, numbers: str) -> NDArray[np.float64]:
    number: Any = np.dtype(numbers).type
    model = model_of(policy, numbers)
    functions = {"exp": np.exp, "floor": math.floor, "inf": number(math.inf), "pi": number(math.pi), "sqrt": np.sqrt}
    arithmetic = Arithmetic(numbers, number, {**functions, "tan": np.tan})
    behaviour = merged(HELPERS, offset_behaviour(model)).with_numbers(lambda ball: number(float(ball.mid())))
    with np.errstate(all="ignore"):
        prepared = prepare(library_scene(scene_name), arithmetic, behaviour)
        return np.asarray(render_prepared(prepared), dtype=np.float64)


# Only some rays are moved, by no more than a bound: whether all are, or none, is then feasible.
BOUND = RayOffset(absolute=FAR / 8, is_bound=True)


@pytest.mark.parametrize("policy", [RayOffset(), RayOffset(absolute=FAR / 8)], ids=RayOffset.in_words)
@pytest.mark.parametrize("scene_name", [name for name in SCENES if name != "concave-mirror"])
def test_who_moves_some_rays_lies_in_the_feasible_set_of_their_bound(scene_name: str, policy: RayOffset) -> None:
    image = rendered(scene_name, policy, "float32")
    distances = distances_in_tolerances(image, feasible(scene_name, BOUND, "float32"))
    assert np.argwhere(distances > 1).tolist() == []
    assert (distances >= 0).mean() > 0.9


@cache
def feasible(scene_name: str, policy: RayOffset, numbers: str) -> FeasibleSet:
    return feasible_set(library_scene(scene_name), model_of(policy, numbers))


@pytest.mark.parametrize("numbers", BITS)
@pytest.mark.parametrize("policy", POLICIES)
@pytest.mark.parametrize("scene_name", SCENES)
def test_a_renderer_with_this_policy_lies_in_its_feasible_set(scene_name: str, policy: str, numbers: str) -> None:
    image = rendered(scene_name, POLICIES[policy], numbers)
    distances = distances_in_tolerances(image, feasible(scene_name, POLICIES[policy], numbers))
    assert (distances >= 0).mean() > 0.9, "too many pixels could not be judged"
    wrong = np.argwhere(distances > 1).tolist()
    assert wrong == [], f"{scene_name}, {policy}, {numbers}: pixels (y, x) {wrong} of 12x9"


# Where an offset shows in an image of 12x9 pixels: in how much of the glass each ray goes through.
@pytest.mark.parametrize("policy", [name for name in POLICIES if name not in {"none", "least distance"}])
def test_a_policy_that_was_not_declared_is_noticed(policy: str) -> None:
    image = rendered("tinted-glass", POLICIES[policy], "float64")
    other = "relative" if policy in {"absolute", "absolute, tested"} else "absolute"
    for declared in ("none", other):
        distances = distances_in_tolerances(image, feasible("tinted-glass", POLICIES[declared], "float64"))
        assert (distances > 1).any(), f"{policy} passes for {declared}"


def test_the_acne_of_too_small_an_offset_is_feasible_for_who_declares_it_and_for_no_one_else() -> None:
    tiny = RayOffset(absolute=2.0**-30, excludes_surface=False)
    clean = RayOffset(absolute=2.0**-30)
    image = rendered("self-shadowing-ring", tiny, "float32")
    assert (distances_in_tolerances(image, feasible("self-shadowing-ring", clean, "float32")) > 1).any()
    assert (distances_in_tolerances(image, feasible("self-shadowing-ring", tiny, "float32")) <= 1).all()
