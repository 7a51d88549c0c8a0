"""Are the first hits of a renderer those that it may find?"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.feasible_sets.feasible_set import UNUSED
from raytruth.comparisons.judgement.exact_test import box_distances
from raytruth.comparisons.judgement.pixel_verdict import MOST_UNJUDGED, unjudged_in_words
from raytruth.comparisons.records.results import FirstHitComparison, Verdict

if TYPE_CHECKING:
    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.comparisons.records.renderings import FirstHits


def judge_first_hits(hits: FirstHits, feasible: FeasibleSet) -> FirstHitComparison:
    """Compare first hits with their feasible sets: primitive, distance, position, normal must fit one outcome."""
    with np.errstate(invalid="ignore"):
        values = np.concatenate([hits.depth[..., np.newaxis], hits.position, hits.normal], axis=2)
    places = feasible.hit_primitives != UNUSED
    same_primitive = places & (feasible.hit_primitives == hits.primitive[..., np.newaxis])
    nothing = hits.primitive < 0
    fits = box_distances(values, feasible.hit_low, feasible.hit_high) <= 1
    agrees = (same_primitive & (fits | nothing[..., np.newaxis])).any(axis=2)
    judged = places.any(axis=2)
    as_due = (same_primitive & feasible.hit_due & (fits | nothing[..., np.newaxis])).any(axis=2)
    certain = judged & (places.sum(axis=2) == 1)
    compared = certain & ~nothing & same_primitive[..., 0]
    middles = 0.5 * (feasible.hit_low + feasible.hit_high)[..., 0, :]
    differences = np.abs(values - middles)[compared]
    largest = differences.max(axis=0) if len(differences) else np.zeros(values.shape[2])
    return FirstHitComparison(
        compared=int(judged.sum()),
        unjudged=int((~judged).sum()),
        declared=int((agrees & ~as_due).sum()),
        primitive_mismatches=int((judged & ~same_primitive.any(axis=2)).sum()),
        ambiguous=int((judged & ~certain).sum()),
        largest_depth_error=float(largest[0]),
        largest_position_error=float(largest[1:4].max()),
        largest_normal_error=float(largest[4:].max()),
        failing=int((judged & ~agrees).sum()),
    )


def verdict_of_first_hits(hits: FirstHitComparison) -> tuple[Verdict, str]:
    """Pass if every judged first hit lies in its feasible set and is as due, and nearly all could be judged."""
    aside = f" ({hits.unjudged} not judged)" if hits.unjudged else ""
    if hits.failing:
        return Verdict.FAIL, f"{hits.failing} of {hits.compared} first hits lie outside their feasible sets{aside}"
    pixels = hits.compared + hits.unjudged
    if hits.unjudged > MOST_UNJUDGED * pixels:
        return Verdict.INCOMPARABLE, unjudged_in_words(hits.unjudged, pixels, "first hits")
    if hits.declared:
        return Verdict.DECLARED, f"{hits.declared} of {hits.compared} first hits are as declared, not as due{aside}"
    return Verdict.PASS, f"all {hits.compared} first hits lie in their feasible sets{aside}"
