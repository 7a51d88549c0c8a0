from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from flint import arb

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, make_kernel
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS, VARIANTS
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import ball_kernel, kept_precision
from tests.reference_tracer.small_scenes import library_scene

pytestmark = pytest.mark.clause("ARI-9")

# Scenes without contacts or extremes, that together use all that a variant replaces.
SCENES = ["whitted-1980", "glass-sphere", "total-reflection-prism", "trefoil-knot"]


@pytest.mark.parametrize("name", VARIANTS)
def test_a_variant_gives_the_same_pictures_of_benign_scenes(name: str) -> None:
    for scene_name in SCENES:
        scene = library_scene(scene_name, 16, 12)
        expected = render(scene, FLOAT).astype(float)
        image = render(scene, FLOAT, Behaviour(VARIANTS[name])).astype(float)
        # Rounding, 1e-16, grown by a path of a few bounces off curved surfaces: far below what any picture shows.
        np.testing.assert_allclose(image, expected, rtol=1e-11, atol=1e-12 * expected.max())


@pytest.mark.parametrize("name", VARIANTS)
def test_a_variant_is_not_the_default(name: str) -> None:
    variant = make_kernel(FLOAT, set(Feature), Behaviour(VARIANTS[name]))
    default = make_kernel(FLOAT, set(Feature))
    x: Any = np.random.default_rng(1)
    for _ in range(200):
        vectors = [tuple(x.uniform(-1, 1, 3).tolist()) for _ in range(5)]
        calls = {
            "sphere_distance": (*vectors[:3], 0.9),
            # At an edge the forms decide differently; elsewhere their bits may be the same.
            "triangle_distance": (vectors[0], toward_edge(vectors, float(x.uniform())), *vectors[2:]),
            "fresnel_reflectance": (0.7, 0.9 * abs(vectors[0][0]) + 0.1, 1.3),
            "refracted_direction": (vectors[0], vectors[1], 0.7, 1.1, 1.3),
            "snell_discriminant": (abs(vectors[0][0]), 1.0 + 1e-3 * abs(vectors[0][1])),
        }
        if any(getattr(variant, f)(*calls[f]) != getattr(default, f)(*calls[f]) for f in VARIANTS[name]):
            return
    raise AssertionError("the variant gives the same bits everywhere")


def toward_edge(vectors: list[tuple[float, ...]], part: float) -> tuple[float, ...]:
    """From the first vector to the edge between the third and the fourth."""
    origin, _, a, b, _ = vectors
    return tuple(p + part * (q - p) - o for o, p, q in zip(origin, a, b, strict=True))


def test_balls_use_the_plain_forms() -> None:
    for _ in kept_precision():
        kernel, decisions = ball_kernel(100)
        assert not {"square", "two_sum", "longest_axis"} & set(vars(kernel))
        assert set(PLAIN_FORMS) <= set(vars(kernel))
        # All three parts of the direction are equal within the ball: no choice of an axis is asked for.
        part = arb(1, 1e-20)
        corners = [tuple(map(arb, corner)) for corner in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
        assert kernel.triangle_distance((arb(0), arb(0), arb(0)), (part, part, part), *corners).contains(arb(1) / 3)
        assert decisions.answers == []
