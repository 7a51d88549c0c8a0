"""Which known mistake explains what is wrong: a proof that pixels lie in the feasible sets of the tracer with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.grading.allowed_models import radiance_model
from raytruth.comparisons.grading.faulty_tracers import FaultyTracer, outcomes_of, values_of
from raytruth.comparisons.grading.global_mistakes import corrected, output_of, written_values
from raytruth.comparisons.grading.scene_grading import expectations_of
from raytruth.comparisons.measures.visibility import differs_visibly
from raytruth.comparisons.processes.interruption import at_work
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.faulty_tracers import Boxes, Pixels
    from raytruth.comparisons.grading.global_mistakes import Reading
    from raytruth.comparisons.grading.scene_grading import GradedPicture
    from raytruth.scenes.scene import Scene

# The simplest failing scenes tell most, and each costs as much as all before.
MOST_SCENES = 4
# Of these so many wrong and so many right pixels are compared with what each fault computes, before anything is proved.
SAMPLED = 16
# So many faults are held to a proof, on so many wrong pixels of a scene: some seconds of work a scene.
MOST_PROVED = 6
MOST_WRONG = 48


@dataclass(frozen=True, eq=False)
class Evidence:
    """A picture that is wrong, corrected by the reading, and what it was judged by."""

    scene: Scene
    picture: NDArray[np.float64]
    """As corrected, shape (height, width, 3)."""
    right: NDArray[np.bool_]
    wrong: NDArray[np.bool_]
    reading: Reading
    declared: OutputModel
    assignment: Assignment

    def read(self, radiance: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The ends of what may be read in the file for each radiance."""
        output = output_of(self.reading, self.declared)
        assert output is not None, "readings are made of mistakes that go together"
        written = written_values(self.reading, radiance)
        return output.interval_read(written, written)


@dataclass(frozen=True)
class Agreement:
    """How what a faulty tracer computes in float64 compares with a picture, at sampled pixels."""

    alike: int
    """Wrong pixels that look as it has them."""
    unlike: int
    """Right pixels that look other than it has them."""
    sampled: int
    distance: float
    """The mean difference at the wrong pixels, each at most 1 of the larger value."""


@dataclass(frozen=True)
class Proof:
    """How many wrong pixels of a scene lie in the feasible sets of a faulty tracer, and how many right ones do not."""

    scene: str
    explained: int
    looked_at: int
    contradicted: int
    left_open: int
    """Wrong pixels of which its arithmetic leaves everything open; they are not among those looked at."""


def evidence_of(
    graded: Sequence[GradedPicture], reading: Reading, declared: OutputModel, assignment: Assignment
) -> list[Evidence]:
    """The pictures with wrong pixels, those of the simplest scenes first: of the fewest features, then bounces."""
    wrong = [it for it in graded if it.submitted.image is not None and it.counts.wrong]
    wrong.sort(key=lambda it: (len(required_features(it.scene)), it.scene.max_depth, it.scene.name))
    return [
        Evidence(it.scene, corrected(reading, it.submitted.image), it.right, it.wrong, reading, declared, assignment)
        for it in wrong
        if it.submitted.image is not None
    ]


def spread(mask: NDArray[np.bool_], most: int) -> list[tuple[int, int]]:
    """Columns and rows of at most so many pixels of a mask, spread evenly over them."""
    places = np.argwhere(mask)
    if not len(places):
        return []
    chosen = places[np.unique(np.linspace(0, len(places) - 1, min(most, len(places))).astype(int))]
    return [(int(column), int(row)) for row, column in chosen]


@at_work()
def agreements(evidence: Evidence, tracers: Sequence[FaultyTracer]) -> dict[FaultyTracer, Agreement]:
    """How each faulty tracer that differs in this scene agrees with the picture at sampled pixels."""
    wrong, right = spread(evidence.wrong, SAMPLED), spread(evidence.right, SAMPLED)
    pixels = [*wrong, *right]
    given = _at(evidence.picture, pixels)
    found = {}
    for tracer in tracers:
        if not tracer.applies_to(evidence.scene):
            continue
        values = values_of(tracer, evidence.scene, evidence.reading, pixels)
        if values is None:
            continue
        low, high = evidence.read(values)
        values = 0.5 * (low + high)
        unlike = np.asarray(differs_visibly(given, values).any(axis=1))
        scale = np.maximum(np.maximum(np.abs(given), np.abs(values)), np.finfo(np.float32).tiny)
        with np.errstate(over="ignore", invalid="ignore"):  # of what is infinite, and as far as can be
            apart = (np.abs(given - values) / scale).max(axis=1)
        found[tracer] = Agreement(
            alike=int((~unlike[: len(wrong)]).sum()),
            unlike=int(unlike[len(wrong) :].sum()),
            sampled=len(wrong),
            distance=float(np.mean(np.nan_to_num(apart[: len(wrong)], nan=1.0, posinf=1.0))),
        )
    return found


@at_work()
def proof_of(evidence: Evidence, tracer: FaultyTracer) -> Proof:
    """Hold the wrong pixels to the feasible sets of the faulty tracer, and the right ones to what it computes."""
    pixels = spread(evidence.wrong, MOST_WRONG)
    given = _at(evidence.picture, pixels)
    explained, known = np.zeros((2, len(pixels)), dtype=bool)
    for model in evidence.assignment.models:
        left = np.flatnonzero(~explained)
        if not len(left):
            break
        allowed = radiance_model(model).in_scene(evidence.scene)
        boxes = outcomes_of(tracer, evidence.scene, evidence.reading, allowed, [pixels[place] for place in left])
        explained[left] = _fits(evidence, given[left], boxes)
        known[left] |= np.array([bool(of_pixel) for of_pixel in boxes])
    counts = int(explained.sum()), int(known.sum()), _contradicted(evidence, tracer), int((~known).sum())
    return Proof(evidence.scene.name, *counts)


def ranked(found: Sequence[dict[FaultyTracer, Agreement]]) -> list[FaultyTracer]:
    """All faulty tracers that look like the pictures somewhere, the likeliest first."""
    totals: dict[FaultyTracer, list[Agreement]] = {}
    for of_scene in found:
        for tracer, agreement in of_scene.items():
            totals.setdefault(tracer, []).append(agreement)
    sampled = sum(max((it.sampled for it in of_scene.values()), default=0) for of_scene in found)

    def key(tracer: FaultyTracer) -> tuple[float, float, str]:
        own = totals[tracer]
        alike, unlike = sum(it.alike for it in own), sum(it.unlike for it in own)
        # Where a fault changes nothing, nothing of the picture is explained: its distance there is the largest.
        distance = sum(it.distance * it.sampled for it in own) + sampled - sum(it.sampled for it in own)
        return unlike - alike, distance, tracer.name

    return [tracer for tracer in sorted(totals, key=key) if sum(it.alike for it in totals[tracer])]


def _fits(evidence: Evidence, given: NDArray[np.float64], boxes: Boxes) -> NDArray[np.bool_]:
    """Whether each value lies in one of its pixel's boxes, as they are read from the file."""
    fits = np.zeros(len(given), dtype=bool)
    for place, of_pixel in enumerate(boxes):
        if not of_pixel:
            continue
        ends = np.array(of_pixel)
        low, _ = evidence.read(ends[..., 0])
        _, high = evidence.read(ends[..., 1])
        fits[place] = bool(((low <= given[place]) & (given[place] <= high)).all(axis=1).any())
    return fits


def _contradicted(evidence: Evidence, tracer: FaultyTracer) -> int:
    """How many right pixels would be wrong with the fault: what it computes is outside of all feasible sets there."""
    pixels = spread(evidence.right, evidence.right.size)
    if not pixels or not tracer.applies_to(evidence.scene):
        return 0
    values = values_of(tracer, evidence.scene, evidence.reading, pixels)
    if values is None:
        return len(pixels)
    low, high = evidence.read(values)
    image = evidence.picture.copy()
    rows, columns = [row for _, row in pixels], [column for column, _ in pixels]
    image[rows, columns] = 0.5 * (low + high)
    return int(_wrong_as_corrected(evidence, image)[rows, columns].sum())


def _wrong_as_corrected(evidence: Evidence, image: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which pixels of a corrected picture are wrong."""
    expectations = expectations_of(evidence.scene, evidence.assignment)
    return expectations.fit(image, evidence.declared, evidence.reading, is_corrected=True).wrong


def _at(image: NDArray[np.float64], pixels: Pixels) -> NDArray[np.float64]:
    return image[[row for _, row in pixels], [column for column, _ in pixels]]
