"""From what each faulty tracer explains to what is told: single faults, pairs, or that none is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.grading.diagnosis import (
    LATER_RIGHT,
    LATER_WRONG,
    MOST_PROVED,
    MOST_SCENES,
    MOST_WRONG,
    SAMPLED,
    SAMPLED_FOR_PAIRS,
    agreements,
    proof_of,
    ranked,
)
from raytruth.comparisons.grading.faulty_tracers import with_another
from raytruth.comparisons.records.grade_results import Diagnosed

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from concurrent.futures import Executor, Future

    from raytruth.comparisons.grading.diagnosis import Evidence, Proof
    from raytruth.comparisons.grading.faulty_tracers import FaultyTracer

# Where no fault explains all, so many of the likeliest are held to the other scenes and paired with every other fault,
# which is as much work for each as all single ones: in the two simplest scenes that it leaves unexplained.
MOST_PAIRED = 2
MOST_PAIR_SCENES = 2
MOST_PAIRS_PROVED = 3
# Faulty tracers whose pixels are sampled by one task: some seconds of work, so that two processors end together.
AT_A_TIME = 50


@dataclass(frozen=True)
class Explanation:
    """What a faulty tracer explains of all pictures that it was held to."""

    tracer: FaultyTracer
    proofs: tuple[Proof, ...]

    @property
    def explained(self) -> int:
        """Wrong pixels that lie in its feasible sets."""
        return sum(proof.explained for proof in self.proofs)

    @property
    def looked_at(self) -> int:
        """Wrong pixels that it was held to."""
        return sum(proof.looked_at for proof in self.proofs)

    @property
    def contradicted(self) -> int:
        """Right pixels that it would have wrong."""
        return sum(proof.contradicted for proof in self.proofs)

    @property
    def likelihood(self) -> float:
        """The share of wrong pixels that it explains."""
        return self.explained / self.looked_at if self.looked_at else 0.0

    @property
    def share(self) -> float:
        """The same share as if every fault had been held to all of these pixels."""
        wrong = sum(proof.wrong for proof in self.proofs)
        explained = sum(proof.wrong * proof.explained / max(1, proof.looked_at) for proof in self.proofs)
        return explained / wrong if wrong else 0.0

    @property
    def is_whole(self) -> bool:
        """Whether it explains every wrong pixel, and no right one speaks against it."""
        return self.explained == self.looked_at > 0 and self.contradicted == 0

    def order(self) -> tuple[bool, float, int, int, str]:
        """Whole explanations first, then those that explain most; of equals single faults before pairs."""
        against = self.contradicted / max(1, sum(proof.wrong for proof in self.proofs))
        faults = self.tracer.faults
        return not self.is_whole, against - self.share, -self.explained, len(faults), self.tracer.name

    def diagnosed(self) -> Diagnosed:
        """The same in words."""
        faults = [all_faults()[name] for name in self.tracer.faults]
        return Diagnosed(
            fault=self.tracer.name,
            clause=", ".join(fault.clause for fault in faults),
            words=" ".join(fault.words for fault in faults),
            hint=" ".join(fault.hint for fault in faults),
            likelihood=self.likelihood,
            explained=self.explained,
            looked_at=self.looked_at,
            contradicted=self.contradicted,
            scenes=tuple(proof.scene for proof in self.proofs if proof.explained),
            left_open=sum(proof.left_open for proof in self.proofs),
            is_whole=self.is_whole,
        )


class Search:
    """The search for what explains the pictures of one submission, those of the simplest scenes first."""

    def __init__(self, evidence: Sequence[Evidence], known: Sequence[FaultyTracer], pool: Executor) -> None:
        failing = [it for it in evidence if it.wrong.any()]
        self.known, self.pool = known, pool
        self.simplest = failing[:MOST_SCENES]
        self.others = [*failing[MOST_SCENES:], *(it for it in evidence if not it.wrong.any())]

    def single(self) -> list[Explanation]:
        """The likeliest single faults, the best of them held to all pictures."""
        return self._held_to_others(
            self._proved(self.simplest, self._likeliest(self.simplest, self.known, MOST_PROVED))
        )

    def pairs(self, alone: Sequence[Explanation]) -> list[Explanation]:
        """The likeliest single faults with any other: the pairs that explain more than each of these does."""
        found: list[Explanation] = []
        likeliest = sorted(alone, key=Explanation.order)[:MOST_PAIRED]
        for place, first in enumerate(likeliest):
            # Faults that explain as much as one another may be two names of the same: the pairs of each are told.
            if any(it.is_whole for it in found) and first.order()[:-1] != likeliest[place - 1].order()[:-1]:
                break
            found += self._with_others(first)
        return found

    def _with_others(self, first: Explanation) -> list[Explanation]:
        """The faults that explain, together with the first, what it leaves."""
        unexplained = {proof.scene for proof in first.proofs if proof.explained < proof.looked_at or proof.contradicted}
        left = [it for it in (*self.simplest, *self.others) if it.scene.name in unexplained][:MOST_PAIR_SCENES]
        pairs = [with_another(first.tracer, other) for other in self.known if other != first.tracer]
        likeliest = self._likeliest(left, [pair for pair in pairs if pair is not None], MOST_PAIRS_PROVED)
        together = self._proved([*self.simplest, *(it for it in left if it not in self.simplest)], likeliest)
        return self._held_to_others([it for it in together if _explains_more(it, first)])

    def _likeliest(
        self, pictures: Sequence[Evidence], tracers: Sequence[FaultyTracer], most: int
    ) -> Sequence[FaultyTracer]:
        """Those that agree best with the pictures at sampled pixels, worked out side by side."""
        sampled = SAMPLED if tracers is self.known else SAMPLED_FOR_PAIRS
        parts = [tracers[start : start + AT_A_TIME] for start in range(0, len(tracers), AT_A_TIME)]
        jobs = [[self.pool.submit(agreements, picture, part, sampled) for part in parts] for picture in pictures]
        found = [{tracer: it for job in own for tracer, it in job.result().items()} for own in jobs]
        return ranked(found)[:most]

    def _held_to_others(self, found: Sequence[Explanation]) -> list[Explanation]:
        """Hold those to all other pictures that explain the simplest failing ones, or the best if none does."""
        ordered = sorted(found, key=Explanation.order)
        best = [it for it in ordered if it.is_whole] or ordered[:MOST_PAIRED]
        seen = {proof.scene for it in best for proof in it.proofs}
        others = [it for it in self.others if it.scene.name not in seen]
        more = self._proved(others, [it.tracer for it in best])
        held = [Explanation(one.tracer, (*one.proofs, *other.proofs)) for one, other in zip(best, more, strict=True)]
        return [*held, *(it for it in ordered if it not in best)]

    def _proved(self, pictures: Sequence[Evidence], tracers: Iterable[FaultyTracer]) -> list[Explanation]:
        """What each explains of these pictures: of the simplest failing ones by more pixels than of all others."""
        jobs = {tracer: [self._proof(picture, tracer) for picture in pictures] for tracer in tracers}
        return [Explanation(tracer, tuple(job.result() for job in own)) for tracer, own in jobs.items()]

    def _proof(self, picture: Evidence, tracer: FaultyTracer) -> Future[Proof]:
        if picture in self.simplest:
            return self.pool.submit(proof_of, picture, tracer, MOST_WRONG, picture.right.size)
        return self.pool.submit(proof_of, picture, tracer, LATER_WRONG, LATER_RIGHT)


def diagnosis(evidence: Sequence[Evidence], known: Sequence[FaultyTracer], pool: Executor) -> list[Diagnosed]:
    """The known faults that explain most of what is wrong, the likeliest first; pairs where no single one explains all.

    `evidence` holds all pictures, those of the simplest scenes first. Right ones are looked at, too: a fault that would
    have altered them is not the one.
    """
    search = Search(evidence, known, pool)
    told = search.single()
    if told and not any(it.is_whole for it in told):
        told += search.pairs(told)
    return [it.diagnosed() for it in sorted(told, key=Explanation.order) if it.explained]


def _explains_more(pair: Explanation, first: Explanation) -> bool:
    """Whether a pair explains more than its first fault does alone, of the pictures that both were held to."""
    scenes = {proof.scene for proof in pair.proofs}
    return pair.explained > sum(proof.explained for proof in first.proofs if proof.scene in scenes)
