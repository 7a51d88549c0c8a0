"""The verdict on an image by one of three tests: exact values, means of camera rays, or sums of light paths."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.feasible_sets.feasible_set import UNUSED
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.judgement.declared_pixels import as_declared
from raytruth.comparisons.judgement.exact_test import UNJUDGED, judge_image, judgement_of
from raytruth.comparisons.judgement.pixel_verdict import capped_in_words, declared_in_words, verdict_of
from raytruth.comparisons.noise.light_path_means import compare_light_paths
from raytruth.comparisons.noise.lobes import find_lobes
from raytruth.comparisons.noise.mean_test import SIGNIFICANCE, StochasticOutcome, compare_means, mean_p_values
from raytruth.comparisons.noise.pixel_areas import area_means
from raytruth.comparisons.noise.splat_bound import largest_splats
from raytruth.comparisons.records.pixel_evidence import PixelEvidence, pixel_evidence
from raytruth.comparisons.records.renderings import Rays
from raytruth.comparisons.records.results import Judgement, StochasticTest, Verdict
from raytruth.reference_tracer.camera_rays import CENTRES
from raytruth.reference_tracer.rendering import primary_rays

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.comparisons.feasible_sets.radiance_bound import RadianceBound
    from raytruth.comparisons.records.renderings import Image, Rendering
    from raytruth.reference_tracer.camera_rays import CameraRays
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class Expectation:
    """What is expected of a scene's images from renderers of one error model."""

    scene: Scene
    truth: NDArray[np.float64]
    """The true colour of each pixel, shape (height, width, 3)."""
    rays: Rays
    """The ray of each pixel, through its centre unless the error model says otherwise."""
    feasible: FeasibleSet
    bound: RadianceBound | None
    """The largest radiance that any ray can bring back. None where none is known: random samples cannot be judged."""
    shortcuts: str = ""
    """How large the shortcuts of the error model are in this scene, in words; empty where there are none."""
    camera_rays: CameraRays = CENTRES
    """Through which point of each pixel its ray goes."""


def expectation_of(
    scene: Scene,
    truth: NDArray[np.float64],
    feasible: FeasibleSet,
    shortcuts: str = "",
    camera_rays: CameraRays = CENTRES,
) -> Expectation:
    """What is expected of images of a scene, from its truth, shape (height, width, 3), and its feasible set.

    Both are of these rays of the pixels.
    """
    rays = Rays(*primary_rays(scene, camera_rays))
    return Expectation(scene, truth, rays, feasible, radiance_bound(scene), shortcuts, camera_rays)


@dataclass(frozen=True)
class ImageVerdict:
    """The verdict on one image, and what it rests on."""

    judgement: Judgement
    test: StochasticTest | None
    """None for an image that was made without random numbers."""
    verdict: Verdict
    reason: str
    distances: NDArray[np.float64]
    """How far each value is from what it may be, in tolerances, shape (height, width, 3); up to 1 it is feasible."""
    pixels: PixelEvidence


def judge_exact(image: Image, expectation: Expectation) -> ImageVerdict:
    """Judge an image that was made without random numbers: each pixel must lie in its feasible set."""
    feasible = expectation.feasible
    judgement, nearest = judge_image(image, expectation.truth, feasible)
    declared = as_declared(image, expectation.truth, nearest.by_shortcut())
    pixels = pixel_evidence(feasible.low, feasible.high, nearest.places, feasible.merged, declared)
    return ImageVerdict(judgement, None, *verdict_of(judgement), nearest.distances, pixels)


def judge_noisy(rendering: Rendering, expectation: Expectation) -> ImageVerdict:
    """Judge means of random samples: each pixel's expected value must lie in the hull of its feasible set."""
    assert rendering.image is not None
    assert rendering.batch_means is not None
    bound = expectation.bound
    assert bound is not None, "comparability.py lets no stochastic scene through without a bound"
    unjudged = expectation.feasible.outcomes == 0
    # A sample is rounded as all numbers are; one part in 2^20 is far above a float32 rounding of the largest.
    # In the dark every sample is 0, which any bound holds.
    most = (bound.at_camera or 1.0) * (1 + 2.0**-20)
    low, high = expectation.feasible.hull()
    low = np.where(unjudged[..., np.newaxis], 0.0, np.clip(low, 0.0, most))
    high = np.where(unjudged[..., np.newaxis], most, np.clip(high, 0.0, most))
    lobes = find_lobes(expectation.scene)
    first_hit_is_certain = (expectation.feasible.hit_primitives != UNUSED).sum(axis=2) == 1
    is_random = ~(lobes.sees_directly() & first_hit_is_certain)
    outcome = compare_means(low, high, rendering.batch_means, rendering.samples, most, lobes, is_random)
    distances = _distances(outcome)
    within_range = unjudged & (outcome.p_values >= SIGNIFICANCE).all(axis=2)
    distances = np.where(within_range[..., np.newaxis], UNJUDGED, distances)
    by_shortcut: NDArray[np.bool_] = (
        ~unjudged & (distances.max(axis=2) <= 1) & _is_not_due(rendering, expectation.feasible, most)
    )
    declared = as_declared(rendering.image, expectation.truth, by_shortcut)
    judgement = judgement_of(distances.max(axis=2), rendering.image, expectation.truth, expectation.feasible, declared)
    one_box = np.zeros(unjudged.shape, dtype=np.int64)
    pixels = pixel_evidence(
        low[:, :, np.newaxis], high[:, :, np.newaxis], one_box, expectation.feasible.merged, declared
    )
    without_test, reason = verdict_of(judgement)
    if without_test == Verdict.INCOMPARABLE and outcome.passes:
        return ImageVerdict(judgement, outcome.test, without_test, reason, distances, pixels)
    aside = f"with {rendering.samples} samples a pixel{capped_in_words(judgement)}"
    return ImageVerdict(judgement, outcome.test, *_verdict(outcome, aside, judgement), distances, pixels)


def _is_not_due(rendering: Rendering, feasible: FeasibleSet, most: float) -> NDArray[np.bool_]:
    """Which means cannot come from what is due at their pixel, tested each by itself; shape (height, width).

    A shortcut's outcomes are no part of what is due. Bonferroni's correction counts all pixels and channels.
    """
    low, high = feasible.hull(due_only=True)
    nothing_due = np.isnan(low).any(axis=2)
    low, high = (np.clip(np.nan_to_num(end), 0.0, most) / most for end in (low, high))
    mean = np.clip(np.asarray(rendering.image, dtype=np.float64) / most, 0.0, 1.0)
    p_values = mean_p_values(mean, low, high, np.array(rendering.samples)) * mean.size
    return np.asarray((p_values < SIGNIFICANCE).any(axis=2) | nothing_due)


def of_pixel_areas(expectation: Expectation) -> Expectation:
    """What is expected of each pixel's mean over its whole area, from what is expected at its centre."""
    low, high = area_means(expectation.scene)
    merged = np.zeros(low.shape[:2], dtype=bool)
    low, high, due = low[:, :, np.newaxis], high[:, :, np.newaxis], np.ones((*merged.shape, 1), dtype=bool)
    one_outcome = replace(expectation.feasible, low=low, high=high, due=due, merged=merged)
    return replace(expectation, truth=(low + high)[:, :, 0] / 2, feasible=one_outcome)


def judge_light_paths(rendering: Rendering, areas: Expectation) -> ImageVerdict:
    """Judge sums of random light paths, which give means over whole pixels: `areas` comes from `of_pixel_areas`."""
    assert rendering.image is not None
    assert rendering.batch_means is not None
    low, high = areas.feasible.low, areas.feasible.high
    splats = largest_splats(areas.scene)
    outcome = compare_light_paths(low[:, :, 0], high[:, :, 0], rendering.batch_means, rendering.samples, splats)
    distances = _distances(outcome)
    nowhere = np.zeros(distances.shape[:2], dtype=bool)
    judgement = judgement_of(distances.max(axis=2), rendering.image, areas.truth, areas.feasible, nowhere)
    one_box = np.zeros(distances.shape[:2], dtype=np.int64)
    pixels = pixel_evidence(low, high, one_box, areas.feasible.merged, nowhere)
    aside = f"with {rendering.samples} light paths"
    return ImageVerdict(judgement, outcome.test, *_verdict(outcome, aside, judgement), distances, pixels)


def _distances(outcome: StochasticOutcome) -> NDArray[np.float64]:
    """Distances in tolerances from probabilities.

    The exponent of a tail probability grows with the square of the distance: SIGNIFICANCE itself is at distance 1.
    """
    with np.errstate(divide="ignore"):
        distances: NDArray[np.float64] = np.sqrt(np.log(outcome.p_values) / np.log(SIGNIFICANCE))
    return distances


def _verdict(outcome: StochasticOutcome, aside: str, judgement: Judgement) -> tuple[Verdict, str]:
    if outcome.passes and judgement.declared:
        return Verdict.DECLARED, f"{declared_in_words(judgement.declared, judgement.pixels, 'pixels')}, {aside}"
    probability = f"the least likely mean has p = {outcome.test.smallest_p_value:.2g} after correction"
    verdict = Verdict.PASS if outcome.passes else Verdict.FAIL
    return verdict, f"{probability}, against a significance of {SIGNIFICANCE:g}, {aside}"
