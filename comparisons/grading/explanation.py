"""From what each faulty tracer explains to what is told: single faults, pairs, or that none is known."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.grading.diagnosis import MOST_PROVED, MOST_SCENES, agreements, proof_of, ranked
from raytruth.comparisons.grading.faulty_tracers import FaultyTracer, single_faults
from raytruth.comparisons.records.grade_results import Diagnosed
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from concurrent.futures import Executor

    from numpy.typing import NDArray

    from raytruth.comparisons.grading.diagnosis import Evidence, Proof
    from raytruth.scenes.scene import Scene

# Of two mistakes each may be any of the likeliest ones.
MOST_PAIRED = 4


def diagnosis(evidence: Sequence[Evidence], pool: Executor) -> list[Diagnosed]:
    """The faults that explain most of what is wrong, the first explaining most; pairs where no single one explains all.

    Only the simplest failing scenes are looked at, which come first in `evidence`.
    """
    looked_at = evidence[:MOST_SCENES]
    if not looked_at:
        return []
    singles = single_faults()
    found = list(pool.map(agreements, looked_at, [singles] * len(looked_at)))
    likeliest = ranked(found)[:MOST_PROVED]
    told = _proved(looked_at, likeliest, pool)
    if not any(it.is_whole for it in told):
        of_each = [ranked([of_scene])[:MOST_PAIRED] for of_scene in found]
        likely = dict.fromkeys([*likeliest[:MOST_PAIRED], *(tracer for few in of_each for tracer in few[:1])])
        told += _proved(looked_at, _pairs(likely), pool)
    return sorted((it for it in told if it.explained), key=_order)


def unexplained(evidence: Sequence[Evidence], passing: Iterable[Scene]) -> str:
    """Where what no known mistake explains shows first: the simplest failing scene, its region, and its features."""
    first = evidence[0]
    known = frozenset[str]().union(*(required_features(scene) for scene in passing))
    own = sorted(required_features(first.scene) - known)
    columns, rows = region_of(first.wrong)
    told = (
        f"None of the known mistakes explains this. It shows first in {first.scene.name}, in {int(first.wrong.sum())} "
        f"pixels, columns {columns[0]} to {columns[1]}, rows {rows[0]} to {rows[1]}"
    )
    features = ", ".join(name.lower().replace("_", " ") for name in own)
    return f"{told}; of its features no scene that is right needs {features}." if own else f"{told}."


def region_of(wrong: NDArray[np.bool_]) -> tuple[tuple[int, int], tuple[int, int]]:
    """The first and last column, and the first and last row, of the pixels of a mask that is not empty."""
    rows, columns = np.nonzero(wrong)
    return (int(columns.min()), int(columns.max())), (int(rows.min()), int(rows.max()))


def _pairs(tracers: Iterable[FaultyTracer]) -> list[FaultyTracer]:
    """All pairs of faults in different functions, the likeliest first."""
    found = []
    for one, other in combinations(tracers, 2):
        if set(one.behaviour().functions).isdisjoint(other.behaviour().functions):
            found.append(FaultyTracer((*one.faults, *other.faults)))
    return found[:MOST_PROVED]


def _proved(evidence: Sequence[Evidence], tracers: Sequence[FaultyTracer], pool: Executor) -> list[Diagnosed]:
    """What each explains of all the pictures together."""
    jobs = {tracer: [pool.submit(proof_of, picture, tracer) for picture in evidence] for tracer in tracers}
    return [_diagnosed(tracer, [job.result() for job in of_tracer]) for tracer, of_tracer in jobs.items()]


def _diagnosed(tracer: FaultyTracer, proofs: Sequence[Proof]) -> Diagnosed:
    faults = [all_faults()[name] for name in tracer.faults]
    explained, looked_at = sum(proof.explained for proof in proofs), sum(proof.looked_at for proof in proofs)
    contradicted = sum(proof.contradicted for proof in proofs)
    return Diagnosed(
        fault=tracer.name,
        clause=", ".join(fault.clause for fault in faults),
        words=" ".join(fault.words for fault in faults),
        hint=" ".join(fault.hint for fault in faults),
        likelihood=explained / looked_at,
        explained=explained,
        looked_at=looked_at,
        contradicted=contradicted,
        scenes=tuple(proof.scene for proof in proofs if proof.explained),
        is_whole=explained == looked_at and contradicted == 0,
    )


def _order(told: Diagnosed) -> tuple[bool, float, int, str]:
    """Whole explanations first, single faults before pairs, then those that explain most."""
    return not told.is_whole, told.contradicted / told.looked_at - told.likelihood, told.fault.count("+"), told.fault
