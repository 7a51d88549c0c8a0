"""What is seen of a fault in a renderer that traces light forward, with as many light paths as the adapter traces.

The renderers are simulated: how many paths end on a pixel has Poisson's law, each with the splat of the pixel's centre.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.feasible_sets.rounded_rays import first_hit
from raytruth.comparisons.noise.light_path_means import compare_light_paths
from raytruth.comparisons.noise.mean_test import SIGNIFICANCE
from raytruth.comparisons.noise.pixel_areas import area_means
from raytruth.comparisons.noise.splat_bound import largest_splats
from raytruth.comparisons.renderers.mitsuba.adapter import LIGHT_PATHS
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import prepare, primary_rays
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

pytestmark = pytest.mark.clause("VER-7")

# What is found of a fault in all light with the paths that compiled code traces. The knot has the most edges, where the
# truth's interval is wide.
SMALLEST_BIASES = {"sphere-over-floor": 0.02, "single-sphere": 0.02, "cornell-box": 0.02, "trefoil-knot": 0.04}
SCALAR_BIAS = 0.05
"""What is found in all of them with a quarter of these paths."""


@functools.cache
def scene_of(name: str) -> tuple[Array, Array, Array]:
    """The interval of the area means, and the largest splats."""
    scene = open_scene(name)
    return *area_means(scene), largest_splats(scene)


def p_value(name: str, paths: int, factor: Array | float) -> float:
    """Of a renderer that multiplies every splat by the factor."""
    low, high, splats = scene_of(name)
    truth = (low + high) / 2
    arriving = np.divide(truth, splats, out=np.zeros_like(truth), where=splats > 0)
    rng = np.random.default_rng(1)
    means = [rng.poisson(paths / 2 * arriving) * splats * factor / (paths / 2) for _ in range(2)]
    return compare_light_paths(low, high, np.stack(means), paths, splats).test.smallest_p_value


@pytest.mark.parametrize("name", SMALLEST_BIASES)
def test_light_that_is_a_little_too_bright_or_dark_is_seen(name: str) -> None:
    for paths, bias in ((LIGHT_PATHS["llvm_ad_rgb"], SMALLEST_BIASES[name]), (LIGHT_PATHS["scalar_rgb"], SCALAR_BIAS)):
        assert p_value(name, paths, 1.0) > SIGNIFICANCE
        assert p_value(name, paths, 1 + bias) < SIGNIFICANCE
        assert p_value(name, paths, 1 - bias) < SIGNIFICANCE


@pytest.mark.parametrize("name", SMALLEST_BIASES)
def test_a_missing_cosine_is_seen(name: str) -> None:
    assert p_value(name, LIGHT_PATHS["scalar_rgb"], 1 / cosines_at_the_surface(name)[..., np.newaxis]) < SIGNIFICANCE


def cosines_at_the_surface(name: str) -> Array:
    """Of each pixel's ray with the normal where it arrives, 1 where it sees nothing; shape (height, width)."""
    scene = open_scene(name)
    prepared = prepare(scene, FLOAT)
    origins, directions = primary_rays(scene)
    cosines = np.ones(directions.shape[:2])
    for place in np.ndindex(cosines.shape):
        primitive, values = first_hit(prepared, tuple(origins[place].tolist()), tuple(directions[place].tolist()))
        if primitive >= 0:
            cosines[place] = abs(np.dot(values[4:], directions[place]))
    return cosines
