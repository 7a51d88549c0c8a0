from __future__ import annotations

from functools import cache
from math import inf
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, make_kernel
from raytruth.reference_tracer.bounding_volume_tree import build_tree
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.scenes.features import Feature
from tests.properties.exact import exact
from tests.reference_tracer.kernels import EXACT, exact_kernel, float_kernel, fractions_of, scene_data
from tests.reproduction import note_case

NOTHING = -1


@cache
def linear_kernel(exactly: bool) -> Any:
    return make_kernel(EXACT if exactly else FLOAT, set(Feature) - {Feature.BOUNDING_VOLUMES})


def soup(seed: int, triangles: int, spheres: int) -> tuple[layout.SceneData, np.random.Generator]:
    """Small triangles and spheres anywhere in a cube; some triangles share corners, some lie in planes of the axes."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform(-1, 1, (triangles, 1, 3)) + rng.uniform(-0.4, 0.4, (triangles, 3, 3))
    corners[1::3, 0] = corners[::3, 0][: len(corners[1::3])]
    corners[::4, :, seed % 3] = np.round(corners[::4, :1, seed % 3], 1)
    tree = build_tree(corners)
    tables: dict[int, list[Any]] = {
        layout.SPHERE_CENTER: list(map(tuple, rng.uniform(-1, 1, (spheres, 3)).tolist())),
        layout.SPHERE_RADIUS: rng.uniform(0.05, 0.5, spheres).tolist(),
        layout.SPHERE_MATERIAL: [0] * spheres,
        layout.TRIANGLE_A: list(map(tuple, corners[:, 0].tolist())),
        layout.TRIANGLE_B: list(map(tuple, corners[:, 1].tolist())),
        layout.TRIANGLE_C: list(map(tuple, corners[:, 2].tolist())),
        layout.TRIANGLE_MATERIAL: [0] * triangles,
        layout.NODE_LOW: list(map(tuple, tree.low.tolist())),
        layout.NODE_HIGH: list(map(tuple, tree.high.tolist())),
        layout.NODE_END: tree.end.tolist(),
        layout.NODE_FIRST_TRIANGLE: tree.first.tolist(),
        layout.NODE_TRIANGLES: tree.count.tolist(),
        layout.NODE_ORDER: tree.order.tolist(),
    }
    return scene_data(tables), rng


def ray_through(rng: np.random.Generator, scene: layout.SceneData, triangle: int) -> tuple[Any, Any]:
    """Towards a corner, an edge or the inside of a triangle, or along an axis."""
    origin = rng.uniform(-2, 2, 3)
    weights = rng.choice([0.0, 0.5, 1.0], 3) + np.array([1e-3, 0.0, 0.0])
    table = (layout.TRIANGLE_A, layout.TRIANGLE_B, layout.TRIANGLE_C)
    target = sum(
        w * np.array(layout.vector_of(scene, t, triangle)) for w, t in zip(weights / weights.sum(), table, strict=True)
    )
    direction = target - origin
    if rng.random() < 0.25:
        direction = np.eye(3)[rng.integers(3)] * rng.choice([-1.0, 1.0])
        origin = target - 2 * direction
    return tuple(origin.tolist()), tuple(direction.tolist())


SEEDS = st.integers(0, 2**32)


@pytest.mark.clause("TRAV-4")
@given(SEEDS, st.integers(1, 40))
def test_the_tree_finds_in_exact_arithmetic_what_the_linear_scan_finds(seed: int, triangles: int) -> None:
    scene, rng = soup(seed, triangles, 0)
    numbers = layout.SceneData([exact_kernel().float(number) for number in scene.numbers], scene.integers)
    origin, direction = ray_through(rng, scene, int(rng.integers(triangles)))
    note_case(origin=origin, direction=direction)
    arguments = (numbers, exact(origin), exact(direction), NOTHING)
    distance, hit = exact_kernel().nearest_hit(*arguments)
    linear_distance, linear_hit = linear_kernel(True).nearest_hit(*arguments)
    assert distance == linear_distance
    if hit != linear_hit:  # two triangles at the same distance: a corner or an edge that they share
        assert exact_kernel().distance_to_triangle(numbers, *arguments[1:3], NOTHING, hit) == distance


@pytest.mark.clause("TRAV-1")
@given(SEEDS, st.integers(1, 40), st.integers(0, 4), st.booleans())
def test_the_nearest_of_all_distances_is_found_and_what_is_left_is_not(
    seed: int, triangles: int, spheres: int, starts_on_one: bool
) -> None:
    kernel = linear_kernel(False)
    scene, rng = soup(seed, triangles, spheres)
    origin, direction = ray_through(rng, scene, int(rng.integers(triangles)))
    left = int(rng.integers(spheres + triangles)) if starts_on_one else NOTHING
    note_case(origin=origin, direction=direction, left=left)
    distances = [kernel.distance_to_sphere(scene, origin, direction, left, sphere) for sphere in range(spheres)]
    distances += [kernel.distance_to_triangle(scene, origin, direction, left - spheres, i) for i in range(triangles)]
    nearest = min(distances)
    hit = distances.index(nearest) if nearest < inf else NOTHING
    assert kernel.nearest_hit(scene, origin, direction, left) == (nearest, hit)
    assert left < spheres or hit != left


@pytest.mark.clause("SHAD-1", "SHAD-2")
@given(SEEDS, st.integers(1, 40), st.integers(0, 4))
def test_something_occludes_exactly_if_something_is_nearer_than_the_end(
    seed: int, triangles: int, spheres: int
) -> None:
    kernel = float_kernel()
    scene, rng = soup(seed, triangles, spheres)
    origin, direction = ray_through(rng, scene, int(rng.integers(triangles)))
    note_case(origin=origin, direction=direction)
    nearest, hit = kernel.nearest_hit(scene, origin, direction, NOTHING)
    assert kernel.is_occluded(scene, origin, direction, NOTHING, inf) == (hit != NOTHING)
    assert not kernel.is_occluded(scene, origin, direction, NOTHING, nearest)
    if hit != NOTHING:
        assert kernel.is_occluded(scene, origin, direction, NOTHING, nearest * (1 + 2.0**-52))


@pytest.mark.clause("TRAV-4")
@given(SEEDS, st.integers(1, 40))
def test_the_tree_in_floats_loses_no_triangle_that_is_hit_exactly(seed: int, triangles: int) -> None:
    scene, rng = soup(seed, triangles, 0)
    origin, direction = ray_through(rng, scene, int(rng.integers(triangles)))
    note_case(origin=origin, direction=direction)
    with_tree, _ = float_kernel().nearest_hit(scene, origin, direction, NOTHING)
    linear, hit = linear_kernel(False).nearest_hit(scene, origin, direction, NOTHING)
    if with_tree != linear:
        corners = [layout.vector_of(scene, t, hit) for t in (layout.TRIANGLE_A, layout.TRIANGLE_B, layout.TRIANGLE_C)]
        assert linear < with_tree
        # Rounding made the linear scan hit a triangle that the ray passes by.
        assert exact_kernel().triangle_distance(exact(origin), exact(direction), *map(fractions_of, corners)) == inf
