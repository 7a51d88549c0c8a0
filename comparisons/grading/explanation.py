"""From what each faulty tracer explains to what is told: single faults, pairs, or that none is known."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.grading.diagnosis import MOST_PROVED, MOST_SCENES, agreements, proof_of, ranked
from raytruth.comparisons.grading.faulty_tracers import FaultyTracer
from raytruth.comparisons.records.grade_results import Diagnosed
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from concurrent.futures import Executor

    from numpy.typing import NDArray

    from raytruth.comparisons.grading.diagnosis import Evidence, Proof
    from raytruth.scenes.scene import Scene

# Of two mistakes one is the one that explains most by itself; with any other they are as much work as all single ones,
# so that they are looked for in the two simplest failing scenes, and half as many are held to a proof.
MOST_PAIR_SCENES = 2
MOST_PAIRS_PROVED = 3


def diagnosis(evidence: Sequence[Evidence], known: Sequence[FaultyTracer], pool: Executor) -> list[Diagnosed]:
    """The known faults that explain most of what is wrong, the likeliest first; pairs where no single one explains all.

    Only the simplest failing scenes are looked at, which come first in `evidence`.
    """
    looked_at = evidence[:MOST_SCENES]
    if not looked_at:
        return []
    found = list(pool.map(agreements, looked_at, [known] * len(looked_at)))
    likeliest = ranked(found)[:MOST_PROVED]
    told = _proved(looked_at, likeliest, pool)
    if not any(it.explained == it.looked_at for it in told):
        told += _in_pairs(looked_at, told, known, pool)
    return sorted((it for it in told if it.explained), key=_order)


def unexplained(evidence: Sequence[Evidence], passing: Iterable[Scene], *, in_part: bool = False) -> str:
    """Where what no known mistake explains shows first: the simplest failing scene, its region, and its features.

    `in_part`: some of it is explained.
    """
    none = "No known mistake explains all of this." if in_part else "None of the known mistakes explains this."
    first = evidence[0]
    known = frozenset[str]().union(*(required_features(scene) for scene in passing))
    own = sorted(required_features(first.scene) - known)
    columns, rows = region_of(first.wrong)
    told = (
        f"{none} It shows first in {first.scene.name}, in {int(first.wrong.sum())} pixels, "
        f"columns {columns[0]} to {columns[1]}, rows {rows[0]} to {rows[1]}"
    )
    features = ", ".join(name.lower().replace("_", " ") for name in own)
    return f"{told}; of its features no scene that is right needs {features}." if own else f"{told}."


def region_of(wrong: NDArray[np.bool_]) -> tuple[tuple[int, int], tuple[int, int]]:
    """The first and last column, and the first and last row, of the pixels of a mask that is not empty."""
    rows, columns = np.nonzero(wrong)
    return (int(columns.min()), int(columns.max())), (int(rows.min()), int(rows.max()))


def _in_pairs(
    evidence: Sequence[Evidence], alone: Sequence[Diagnosed], known: Sequence[FaultyTracer], pool: Executor
) -> list[Diagnosed]:
    """The pairs that explain more than each of their faults does: the likeliest with any other."""
    explained = {it.fault: it.explained for it in alone if it.explained}
    if not explained:
        return []
    first = min((it for it in alone if it.explained), key=_order).fault
    functions = all_faults()[first].overrides.keys()
    others = [other for other in known if functions.isdisjoint(other.behaviour().functions)]
    pairs = [FaultyTracer((first, *other.faults)) for other in others]
    simplest = evidence[:MOST_PAIR_SCENES]
    found = list(pool.map(agreements, simplest, [pairs] * len(simplest)))
    proved = _proved(evidence, ranked(found)[:MOST_PAIRS_PROVED], pool)
    return [it for it in proved if it.explained > max(explained.get(fault, 0) for fault in it.fault.split(" + "))]


def _proved(evidence: Sequence[Evidence], tracers: Sequence[FaultyTracer], pool: Executor) -> list[Diagnosed]:
    """What each explains of all the pictures together."""
    jobs = {tracer: [pool.submit(proof_of, picture, tracer) for picture in evidence] for tracer in tracers}
    return [_diagnosed(tracer, [job.result() for job in of_tracer]) for tracer, of_tracer in jobs.items()]


def _diagnosed(tracer: FaultyTracer, proofs: Sequence[Proof]) -> Diagnosed:
    faults = [all_faults()[name] for name in tracer.faults]
    explained, looked_at = sum(proof.explained for proof in proofs), sum(proof.looked_at for proof in proofs)
    contradicted, left_open = sum(proof.contradicted for proof in proofs), sum(proof.left_open for proof in proofs)
    return Diagnosed(
        fault=tracer.name,
        clause=", ".join(fault.clause for fault in faults),
        words=" ".join(fault.words for fault in faults),
        hint=" ".join(fault.hint for fault in faults),
        likelihood=explained / looked_at if looked_at else 0.0,
        explained=explained,
        looked_at=looked_at,
        contradicted=contradicted,
        scenes=tuple(proof.scene for proof in proofs if proof.explained),
        left_open=left_open,
        is_whole=explained == looked_at > 0 and contradicted == 0,
    )


def _order(told: Diagnosed) -> tuple[bool, float, int, int, str]:
    """Whole explanations first, then those that explain most; of equals single faults before pairs."""
    against = told.contradicted / max(1, told.looked_at)
    return not told.is_whole, against - told.likelihood, -told.explained, told.fault.count("+"), told.fault
