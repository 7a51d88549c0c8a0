"""The library's scenes with random lobes, and renderers of them whose lobes are a little wrong."""

from __future__ import annotations

import functools
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.noise.lobes import Lobes, find_lobes
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.requirements import used_materials

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.scenes.scene import Scene


def has_random_lobes(scene: Scene) -> bool:
    """Whether a renderer that draws samples can be compared with the scene's truth, and has something to draw."""
    return radiance_bound(scene) is not None and any(material.dielectric for material in used_materials(scene))


GLASS_SCENES = tuple(name for name in library_names() if has_random_lobes(open_scene(name)))


@functools.cache
def lobes_of(name: str, side: int | None = None) -> Lobes:
    """Those of a library scene at its own size, or with `side` pixels on every side."""
    scene = open_scene(name)
    if side is None:
        return find_lobes(scene)
    return find_lobes(scene.resized(side, side))


def bound_of(name: str) -> float:
    """Above every sample, as comparisons/matrix/cell.py has it."""
    bound = radiance_bound(open_scene(name))
    assert bound is not None
    return bound.at_camera * (1 + 2.0**-20)


def stronger_reflections(lobes: Lobes, bias: float) -> Lobes:
    """Every dielectric multiplies what it reflects by 1 + bias."""
    return replace(lobes, value=lobes.value * ((1 + bias) ** lobes.reflections)[:, np.newaxis])


def stronger_transmissions(lobes: Lobes, bias: float) -> Lobes:
    """Every dielectric multiplies what it transmits by 1 + bias."""
    return replace(lobes, value=lobes.value * ((1 + bias) ** lobes.transmissions)[:, np.newaxis])


def more_reflections(lobes: Lobes, bias: float) -> Lobes:
    """Reflection is chosen with probability (1 + bias)·R, without a weight that makes up for it, to first order."""
    changed = np.maximum(lobes.probability * (1 + bias * lobes.split_score), 0.0)
    total = np.bincount(lobes.pixel, changed)
    return replace(lobes, probability=changed / total[lobes.pixel])


BIASES: dict[str, Callable[[Lobes, float], Lobes]] = {
    "reflections": stronger_reflections,
    "transmissions": stronger_transmissions,
    "choice": more_reflections,
}
