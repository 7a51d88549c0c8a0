"""What a scene's pixels may be for a program that an assignment allows, also if it has made a global mistake."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.feasible_sets.kept_feasible_sets import kept_feasible_set
from raytruth.comparisons.grading.global_mistakes import (
    AS_IT_IS,
    corrected,
    output_of,
    rays_of,
    rendered_scene,
    written_values,
)
from raytruth.comparisons.judgement.declared_pixels import as_declared
from raytruth.comparisons.judgement.exact_test import nearest_outcomes
from raytruth.comparisons.judgement.judged_truth import judged_truth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.comparisons.grading.global_mistakes import Reading
    from raytruth.reference_tracer.camera_rays import CameraRays
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True, eq=False)
class PixelFit:
    """Which pixels of a picture are right; arrays of shape (height, width)."""

    right: NDArray[np.bool_]
    """Whether one of the allowed models may give this value."""
    unjudged: NDArray[np.bool_]
    """Whether a pixel that no model explains cannot be held against the program: one model leaves it open."""
    declared: NDArray[np.bool_]
    """Of the right ones those that are so only by an epsilon or a departure, and visibly not the truth."""
    counted: NDArray[np.bool_]
    """Whether partial credit is given for the pixel: something is seen there, and a black picture would be wrong."""

    @property
    def wrong(self) -> NDArray[np.bool_]:
        """The pixels that no right program could have given."""
        return ~self.right & ~self.unjudged


class SceneExpectations:
    """One scene with all that pictures of it are held to, each feasible set found once."""

    def __init__(self, scene: Scene, models: Sequence[ErrorModel]) -> None:
        self.scene = scene
        self.models = tuple(model.in_scene(scene) for model in models)
        self._found: dict[tuple[str, CameraRays], tuple[NDArray[np.float64], list[FeasibleSet]]] = {}

    def fit(
        self,
        image: NDArray[np.float64],
        declared: OutputModel,
        reading: Reading = AS_IT_IS,
        *,
        is_corrected: bool = False,
    ) -> PixelFit:
        """Which pixels of a picture, shape (height, width, 3), are right, if it is taken to have these mistakes.

        `is_corrected`: pixels and numbers have been put right already.
        """
        output = output_of(reading, declared)
        assert output is not None, "readings are made of mistakes that go together"
        values = image if is_corrected else corrected(reading, image)
        truth, sets = self._expected(reading)
        finite = np.isfinite(values).all(axis=2)
        right, is_open, due, black = (np.zeros(finite.shape, dtype=bool) for _ in range(4))
        for feasible in sets:
            written = _as_written(feasible, reading, output)
            nearest = nearest_outcomes(values, written)
            distances = nearest.in_tolerances()
            unjudged = written.outcomes == 0
            fits = finite & ~unjudged & (distances <= 1)
            right |= fits
            due |= fits & nearest.is_due
            is_open |= unjudged
            black |= nearest_outcomes(np.zeros_like(values), written).in_tolerances() <= 1
        shown = written_values(reading, truth)
        shown = np.clip(shown, 0.0, 1.0) if output.clipped else shown
        declared_only = as_declared(values.astype(np.float32), shown, right & ~due)
        return PixelFit(right, ~right & is_open & finite, declared_only, _counted(sets[0], black))

    def _expected(self, reading: Reading) -> tuple[NDArray[np.float64], list[FeasibleSet]]:
        """The truth, and what each model allows, of the rays and the scene that were taken."""
        scene, rays = rendered_scene(reading, self.scene), rays_of(reading)
        key = (scene.name, rays)
        if key not in self._found:
            models = [replace(model, camera_rays=rays) for model in self.models]
            self._found[key] = judged_truth(scene, rays), [kept_feasible_set(scene, model) for model in models]
        return self._found[key]


def _counted(feasible: FeasibleSet, black: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Where something is seen that is not black; all pixels of a picture in which nothing is."""
    seen: NDArray[np.bool_] = (feasible.hit_primitives >= 0).any(axis=2) & ~black
    return seen if seen.any() else np.ones_like(seen)


def _as_written(feasible: FeasibleSet, reading: Reading, output: OutputModel) -> FeasibleSet:
    """The set of what may be read, from that of radiances: a curve that never falls takes ends to ends."""
    with np.errstate(invalid="ignore"):
        ends = written_values(reading, feasible.low), written_values(reading, feasible.high)
    low, high = output.interval_read(*ends)
    return replace(feasible, low=low, high=high)
