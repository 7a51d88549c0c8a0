"""What is expected of a scene's images under an error model, from what is kept of both."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.shortcuts import shortcuts_in_words
from raytruth.comparisons.feasible_sets.kept_feasible_sets import kept_feasible_set
from raytruth.comparisons.judgement.judged_truth import judged_truth
from raytruth.comparisons.judgement.verdict import expectation_of

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.judgement.verdict import Expectation
    from raytruth.scenes.scene import Scene


def kept_expectation(scene: Scene, error_model: ErrorModel, *, with_colors: bool = True) -> Expectation:
    """Truth and feasible set from the cache, or made now; without colours where only first hits are judged."""
    feasible = kept_feasible_set(scene, error_model, with_colors=with_colors)
    rays = error_model.camera_rays
    return expectation_of(scene, judged_truth(scene, rays), feasible, shortcuts_in_words(error_model, scene), rays)
