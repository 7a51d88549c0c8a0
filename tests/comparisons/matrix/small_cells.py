"""Cells of one small scene, lit or of glass, from a renderer that gives whatever a test answers for it."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.verdict import Expectation, expectation_of
from raytruth.comparisons.matrix.cell import run_cell
from raytruth.comparisons.noise.lobes import find_lobes
from raytruth.comparisons.records.renderings import Rendering
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from tests.comparisons.matrix.cell_places import place_of
from tests.comparisons.matrix.pretending import Pretender, truthful
from tests.reference_tracer.small_scenes import lamp, small_scene

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.records.results import Cell
    from raytruth.scenes.scene import Scene

    Answer = Callable[[Scene, Path], Rendering]

GLASS = {"white": {"dielectric": {"index_of_refraction": 1.5}}}
SIZE: dict[str, Any] = {"width": 6, "height": 4, "extent": 3.0}
# Brighter overhead than anything in the picture, so that right means are not at their bound.
SKY = {"bottom": (0.2, 0.2, 0.2), "top": (0.9, 0.9, 0.9)}


@cache
def expectation(kind: str = "lit") -> Expectation:
    kinds: dict[str, dict[str, Any]] = {
        "lit": {"lights": [lamp((1.0, 2.0, 3.0))]},
        "glass": {"materials": GLASS, "background": SKY, "max_depth": 2},
        "dark glass": {"materials": GLASS, "max_depth": 2},
    }
    scene = small_scene(**SIZE, **kinds[kind])
    truth = np.asarray(render(scene, FLOAT), dtype=np.float64)
    return expectation_of(scene, truth, feasible_set(scene, Pretender().error_model))


def cell_of(folder: Path, answer: Answer = truthful, kind: str = "lit", source: str = "small") -> Cell:
    return judged(Pretender(answer), expectation(kind), folder, source)


def judged(renderer: Pretender, by: Expectation, folder: Path, source: str = "small") -> Cell:
    return run_cell(place_of(by.scene, renderer, "whitted", source=source), 1, by, folder)


def noisy(offset: float, kind: str) -> Answer:
    """Batches of many samples of which the mean is off by a part of the truth."""

    def answer(_scene: Scene, _folder: Path) -> Rendering:
        mean = expectation(kind).truth * (1 + offset)
        noise = np.where(find_lobes(expectation(kind).scene).sees_directly(), 0.0, 0.01)[..., np.newaxis]
        batches = np.stack([mean * (1 + sign * noise) for sign in (-1, 1) * 8]).astype(np.float32)
        return Rendering(mean.astype(np.float32), 1.0, samples=16 * 10_000, batch_means=batches)

    return answer
