"""Meshes that lose a ray, surfaces that coincide, and scenes of any scale, with the tree of boxes and without it.

| fan of triangles | found by | lost by |
|---|---|---|
| some reach behind, float32 | first of 39 in 1,000,000 rays | a distance from the plane, not held between the corners |
| the same, float64 | first of 23 in 3,000,000 rays, 1e6 times as deep | the same |
| a ray that is nearly along an axis, float32 | first of 2 in 2,000,000 rays | boxes 4e-7 longer, not larger |

All rays were aimed at the hub of a fan of five triangles that surrounds it, or 2 ulp beside it.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic, make_kernel
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.scenes.features import Feature
from tests.properties.test_traversal import NOTHING, linear_kernel, ray_through, soup
from tests.reference_tracer.kernels import float_kernel, numpy_kernel, scene_data

if TYPE_CHECKING:
    from collections.abc import Callable

# Origin, direction, hub, and the rim.
LOST = {
    "seen edge on": (
        np.float32,
        """
0x1.87b4eep-11 0x1.77fa7ap-12 0x1.7263aap-12
-0x1.0p+0 0x1.8420d6p-3 -0x1.61876ap-2
-0x1.ff1aacp+2 0x1.8393c6p+0 -0x1.60e5f4p+1
-0x1.aa2da2p-4 0x1.4b8b12p-6 -0x1.2558b6p-5
-0x1.333cc2p-3 0x1.d373c0p-6 -0x1.a2d57cp-5
-0x1.4c48aep-2 0x1.f983b0p-5 -0x1.cc3360p-4
-0x1.5359c6p-1 0x1.6a0c5ap-2 -0x1.6fc744p-1
-0x1.31ee10p-2 0x1.062bf2p-4 -0x1.ab4ff4p-4
""",
    ),
    "seen edge on in double precision": (
        np.float64,
        """
0x0.0p+0 -0x0.0p+0 0x0.0p+0
0x1.72646c09b9889p-2 0x1.98f533687f97fp-1 -0x1.ffffffffffffep-1
0x1.f68af788b700dp+17 0x1.156f1acb5d834p+19 -0x1.5b564a334aa80p+19
0x1.76529f4002d27p-21 0x1.9d22902d57bc1p-20 -0x1.02931fb69fcd8p-19
0x1.2366c77e078c1p+18 0x1.43a01a1979cfep+19 -0x1.9285626c1e925p+19
0x1.7b5c1510759c2p-17 0x1.bc96ef52d5480p-16 -0x1.1506cf1a614b4p-15
0x1.0993b0311533ep-16 0x1.25368fe249a82p-15 -0x1.6f2812a8cc3cap-15
0x1.4eab256ac0ca9p-2 0x1.18f65918cf0eep-1 -0x1.8d14e5c22848dp-1
""",
    ),
    "nearly along an axis": (
        np.float32,
        """
0x1.c5211ep+4 0x1.385786p+4 0x1.c0830ap+3
-0x1.0p-149 -0x1.000a00p+0 -0x1.0p-148
0x1.c5211ep+4 0x1.382cf4p+4 0x1.c0830ap+3
0x1.bc0f0cp+4 -0x1.365660p-1 0x1.e3dbd6p+3
0x1.c575ccp+4 -0x1.d60162p+4 0x1.c21ffap+3
0x1.ca94bap+4 -0x1.9c7df6p-2 0x1.bb9334p+3
0x1.c5673cp+4 0x1.3559bcp+4 0x1.be5d32p+3
0x1.c5228ep+4 -0x1.76ac3ep+1 0x1.c083dcp+3
""",
    ),
}


@cache
def numpy_kernel_without_tree(number: Callable[[float], Any]) -> Any:
    arithmetic = Arithmetic(f"interpreted {number}", number, {"sqrt": np.sqrt, "inf": number(inf)})
    return make_kernel(arithmetic, {Feature.SPHERES, Feature.TRIANGLES})


def mesh(triangles: list[Any]) -> dict[int, list[Any]]:
    """The tables of a mesh; each triangle in a box of its own, which is all that protects it."""
    numbers = list(range(len(triangles)))
    first, second, third = zip(*triangles, strict=True)
    return {
        layout.TRIANGLE_A: list(first),
        layout.TRIANGLE_B: list(second),
        layout.TRIANGLE_C: list(third),
        layout.TRIANGLE_MATERIAL: [0] * len(triangles),
        layout.NODE_LOW: [tuple(map(min, *corners)) for corners in triangles],
        layout.NODE_HIGH: [tuple(map(max, *corners)) for corners in triangles],
        layout.NODE_END: [number + 1 for number in numbers],
        layout.NODE_FIRST_TRIANGLE: numbers,
        layout.NODE_TRIANGLES: [1] * len(triangles),
        layout.NODE_ORDER: numbers,
    }


@pytest.mark.clause("TRI-1", "TRAV-4")
@pytest.mark.parametrize("name", LOST)
def test_a_ray_that_was_lost_in_a_fan_of_triangles_is_found_with_and_without_a_tree(name: str) -> None:
    number, text = LOST[name]
    rows = [tuple(number(float.fromhex(part)) for part in line.split()) for line in text.split("\n") if line]
    origin, direction, hub, *rim = rows
    scene = scene_data(mesh([(hub, one, other) for one, other in pairwise([*rim, rim[0]])]))
    with np.errstate(over="ignore"):  # a distance along a subnormal part may be infinite
        linear, _ = numpy_kernel_without_tree(number).nearest_hit(scene, origin, direction, NOTHING)
        with_tree, _ = numpy_kernel(number).nearest_hit(scene, origin, direction, NOTHING)
    assert 0 < with_tree < inf
    assert linear < inf


SCALES = [2.0**power for power in (0, -100, 100)]
"""About 1e-30 to 1e30."""


@pytest.mark.clause("TRAV-5")
@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("seed", range(20))
def test_scale_changes_no_hit_and_no_bit_of_a_distance(seed: int, scale: float) -> None:
    scene, rng = soup(seed, 20, 3)
    scaled = layout.SceneData([part * scale for part in scene.numbers], scene.integers)
    for triangle in range(20):
        origin, direction = ray_through(rng, scene, triangle)
        far = tuple(part * scale for part in origin)
        for kernel in (float_kernel(), linear_kernel(False)):
            distance, hit = kernel.nearest_hit(scene, origin, direction, NOTHING)
            assert kernel.nearest_hit(scaled, far, direction, NOTHING) == (distance * scale, hit)
            for end in (distance, distance * 2.0):
                occluded = kernel.is_occluded(scene, origin, direction, NOTHING, end)
                assert kernel.is_occluded(scaled, far, direction, NOTHING, end * scale) == occluded


DOWN = (0.0, 0.0, -1.0)


@pytest.mark.clause("TRAV-3")
@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("kernel", [float_kernel, lambda: linear_kernel(False)], ids=["tree", "no tree"])
def test_of_coincident_spheres_and_triangles_the_first_sphere_is_seen(kernel: Any, scale: float) -> None:
    triangle = ((-scale, -scale, scale), (scale, -scale, scale), (0.0, scale, scale))
    scene = scene_data(mesh([triangle] * 6))
    spheres = {
        layout.SPHERE_CENTER: [(0.0, 0.0, 9 * scale), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)],
        layout.SPHERE_RADIUS: [scale, scale, scale],
        layout.SPHERE_MATERIAL: [0, 0, 0],
    }
    above = (0.0, 0.0, 3 * scale)
    # All touch at (0, 0, scale); the first sphere is behind the camera.
    with_spheres = scene_data({**spheres, **mesh([triangle] * 6)})
    assert kernel().nearest_hit(with_spheres, above, DOWN, NOTHING) == (2 * scale, 1)
    distance, hit = kernel().nearest_hit(scene, above, DOWN, NOTHING)
    assert distance == 2 * scale
    assert 0 <= hit < 6
    # A ray that leaves one of them meets another of those in the same place at no distance, which is no hit.
    on_it = (0.0, 0.0, scale)
    assert kernel().nearest_hit(scene, on_it, (0.0, 0.0, 1.0), hit) == (inf, NOTHING)
