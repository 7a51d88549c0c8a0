"""The tracer with a fault of the catalogue: what it computes for some pixels, and all that it may."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.shortcuts import without_shortcuts
from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.feasible_sets.declared_outcomes import bounds_of
from raytruth.comparisons.feasible_sets.pixel_outcomes import PixelOutcomes
from raytruth.comparisons.grading.global_mistakes import rays_of, rendered_scene
from raytruth.comparisons.kills.kill_matrix import ERRORS, LONGEST_SECONDS
from raytruth.comparisons.processes.time_limit import cpu_seconds
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour, merged
from raytruth.reference_tracer.arithmetics.instantiation import functions_of
from raytruth.reference_tracer.rendering import prepare
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.grading.global_mistakes import Reading
    from raytruth.scenes.scene import Scene

Pixels = list[tuple[int, int]]
"""Columns and rows."""
Boxes = list[list[list[tuple[float, float]]]]
"""For each pixel its outcomes, for each of these the ends of three channels; no outcome where nothing is known."""

NOT_IN_BALLS = frozenset({"radiance", "radiance_at", "render_rows"})
"""Functions that feasible sets have no use for: feasible_pixel.py walks the ray tree itself, with forks."""


def _deeper(bounces: int) -> Callable[[Scene, ErrorModel], tuple[Scene, ErrorModel]]:
    return lambda scene, model: (
        scene.model_copy(update={"max_depth": max(0, scene.max_depth + bounces)}),
        model,
    )


IN_OTHER_WORDS: dict[str, Callable[[Scene, ErrorModel], tuple[Scene, ErrorModel]]] = {
    "one_bounce_too_few": _deeper(-1),
    "one_bounce_too_many": _deeper(1),
    "background_where_paths_end": lambda scene, model: (
        scene,
        replace(model, departures=replace(model.departures, end_of_depth="background")),
    ),
}
"""Faults of these functions that are a right tracer of another scene, or one that departs from the specification."""


@dataclass(frozen=True)
class FaultyTracer:
    """One or more faults of the tracer's functions, together."""

    faults: tuple[str, ...]

    @property
    def name(self) -> str:
        """The names of its faults."""
        return " + ".join(self.faults)

    def behaviour(self) -> Behaviour:
        """What they change. Raises ValueError where two change the same function."""
        return merged(*(Behaviour(all_faults()[fault].overrides, name=fault) for fault in self.faults))

    def applies_to(self, scene: Scene) -> bool:
        """Whether the scene's kernel holds any function that they change."""
        return not functions_of(required_features(scene)).isdisjoint(self.behaviour().functions)


def single_faults() -> list[FaultyTracer]:
    """A tracer for each fault of the catalogue that something can be proved of, in the catalogue's order."""
    in_functions = [it for it in all_faults().values() if it.overrides and it.gives == "image"]
    return [
        FaultyTracer((it.name,))
        for it in in_functions
        if it.numbers == "float64" and (NOT_IN_BALLS.isdisjoint(it.overrides) or it.name in IN_OTHER_WORDS)
    ]


def values_of(tracer: FaultyTracer, scene: Scene, reading: Reading, pixels: Pixels) -> NDArray[np.float64] | None:
    """What it computes in float64, shape (pixels, 3); None where its code breaks, or does not end."""
    try:
        behaviour = merged(tracer.behaviour(), rays_of(reading).behaviour())
        with cpu_seconds(LONGEST_SECONDS + len(pixels) * LONGEST_SECONDS / 10), np.errstate(all="ignore"):
            prepared = prepare(rendered_scene(reading, scene), FLOAT, behaviour)
            kernel, data = prepared.kernel, prepared.data
            frame = kernel.camera_frame(data)
            found = [kernel.radiance_at(data, frame, column + 0.5, row + 0.5) for column, row in pixels]
            values = np.array(found, dtype=np.float64).reshape(len(pixels), 3)
    except ERRORS:
        return None
    return None if np.isnan(values).any() else values


def outcomes_of(tracer: FaultyTracer, scene: Scene, reading: Reading, model: ErrorModel, pixels: Pixels) -> Boxes:
    """All that it may compute in an allowed arithmetic. Where a fault and a shortcut change the same function, without.

    Nothing bounds what a faulty tracer may bring, so that a pixel whose rays cannot all be followed has no outcome.
    """
    shown = rendered_scene(reading, scene)
    for fault in IN_OTHER_WORDS.keys() & set(tracer.faults):
        shown, model = IN_OTHER_WORDS[fault](shown, model)
    faulty = FaultyTracer(tuple(fault for fault in tracer.faults if fault not in IN_OTHER_WORDS)).behaviour()
    boxes: Boxes = []
    for allowed in dict.fromkeys((model, without_shortcuts(model))):
        try:
            evaluator = PixelOutcomes(shown, allowed, merged(faulty, rays_of(reading).behaviour()), None)
            colors, _ = evaluator.colors_and_hits(pixels, with_hits=False)
        except ERRORS:
            continue
        boxes = [[bounds_of(box) for box in color.boxes] if color else [] for color in colors]
        break
    return boxes or [[] for _ in pixels]
