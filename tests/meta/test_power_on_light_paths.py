"""What is seen of a fault in a renderer that traces light forward, with as many light paths as the adapter traces.

The renderers are simulated: how many paths end on a pixel has Poisson's law, each with the splat of the pixel's centre.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import numpy as np
import pytest

from comparisons.light_path_test import compare_light_paths
from comparisons.pixel_areas import area_means
from comparisons.renderers.mitsuba import LIGHT_PATHS
from comparisons.splat_bound import largest_splats
from comparisons.stochastic import SIGNIFICANCE
from reference_tracer.rendering import primary_rays
from scenes.library import open_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

# One seen from near and one from afar, the one with the most light on its way, and the one with the most edges.
SCENES = ["sphere-over-floor", "single-sphere", "cornell-box", "trefoil-knot"]


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


@pytest.mark.parametrize("name", SCENES)
def test_light_that_is_a_little_too_bright_or_dark_is_seen(name: str) -> None:
    for paths, bias in ((LIGHT_PATHS["llvm_ad_rgb"], 0.025), (LIGHT_PATHS["scalar_rgb"], 0.03)):
        assert p_value(name, paths, 1.0) > SIGNIFICANCE
        assert p_value(name, paths, 1 + bias) < SIGNIFICANCE
        assert p_value(name, paths, 1 - bias) < SIGNIFICANCE


@pytest.mark.parametrize("name", SCENES)
def test_a_missing_cosine_is_seen(name: str) -> None:
    scene = open_scene(name)
    axis = np.subtract(scene.camera.look_at, scene.camera.position)
    cosine = primary_rays(scene)[1] @ (axis / np.linalg.norm(axis))
    # That of the camera is the smallest fault of the three in the splats: it is 1 in the middle of the image.
    assert p_value(name, LIGHT_PATHS["scalar_rgb"], cosine[..., np.newaxis]) < SIGNIFICANCE
