"""Every value that one pixel may take in a given ball arithmetic.

The ray tree is walked ray by ray. A ray whose comparisons are undecided has several outcomes; the outcomes of a pixel
are all sums over its tree. Where there are too many, they are merged into one box that holds them all; and a ray of
which nothing can be said contributes anything between black and the brightest radiance of the scene.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from heapq import heappop, heappush
from math import inf
from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.reference_tracer.arithmetics.balls import TooManyOutcomesError, every_outcome
from raytruth.reference_tracer.source.traversal import NOTHING

if TYPE_CHECKING:
    from raytruth.comparisons.feasible_sets.radiance_bound import RadianceBound
    from raytruth.comparisons.feasible_sets.rounded_rays import Box, RoundedRays

# Four independent undecided comparisons; more than this many outcomes are merged into one box.
MOST_OUTCOMES = 16


class UndecidableError(Exception):
    """Nothing can be said of this pixel: its arithmetic breaks down, and the scene gives no bound."""


@dataclass(frozen=True)
class FirstHit:
    """One way the primary ray may go: a primitive (-1: none) and balls for distance, position and normal."""

    primitive: int
    values: tuple[Any, ...]
    """Seven: distance, position, normal; empty where nothing is hit."""


@dataclass
class FollowedRay:
    """A ray of the tree, and the rays that go on from its end."""

    ray: Any
    most: int
    """How many outcomes may still be told apart on the way from the camera: a ray with k outcomes leaves its children a
    k-th of it, so that the work for a pixel stays in proportion to the size of its tree."""
    ways: list[tuple[Box, list[FollowedRay]]] | None = None
    """For each way that it can go, what it brings by itself and its children; None for a ray that is not followed,
    which may bring anything."""

    def children(self) -> list[FollowedRay]:
        """Those of all ways."""
        return [child for _, children in self.ways or () for child in children]


class PixelEvaluator:
    """Evaluates the pixels of one scene; `bound` limits what any ray can bring, None if that is unknown."""

    def __init__(self, rays: RoundedRays, bound: RadianceBound | None, output_bits: int, most_work: int) -> None:
        self.rays = rays
        self.bound = bound
        self.most_work = most_work
        """After so much (RoundedRays.work_done), no further ray of a pixel is followed."""
        self.negligible_weight = 2.0**-output_bits
        """What is under a rounding of the brightest value does not deserve its own tree."""
        self.excess = 1.0 + 2.0 ** (10 - output_bits)
        """Rounding may lift a value above the bound: by a roundoff an operation, and a pixel has fewer than 2^10."""
        scene = rays.prepared.scene
        self.depth = scene.max_depth
        self.medium = -1 if scene.camera.inside is None else list(scene.materials).index(scene.camera.inside)
        self.merged = False
        self.may_merge = True
        self.spent = False
        """Whether the last pixel would have taken more work than it may."""
        self._primary: tuple[tuple[int, int], tuple[Any, Any]] | None = None

    def colors(self, column: int, row: int, *, may_merge: bool = True) -> tuple[list[Box], bool]:
        """The boxes of a pixel's feasible colours, and whether there were too many to tell apart.

        Raises UndecidableError, also where one box spans more than half of all that a ray of the scene may bring: such
        a pixel would pass with almost any value; and as soon as outcomes must be merged, unless they may be.
        """
        self.merged, self.may_merge, self.spent = False, may_merge, False
        with self.rays.prepared.arithmetic.in_force():
            origin, direction = self._primary_ray(column, row)
            white = (arb(1), arb(1), arb(1))
            boxes = self._outcomes(self._followed((origin, direction, white, NOTHING, self.medium, self.depth)))
        if self.bound is not None and 2 * widest(boxes) > self.bound.at_camera / 2:
            raise UndecidableError
        return boxes, self.merged

    def first_hits(self, column: int, row: int) -> list[FirstHit]:
        """What the pixel's ray may meet first. Raises UndecidableError."""
        try:
            with self.rays.prepared.arithmetic.in_force():
                origin, direction = self._primary_ray(column, row)
                hits = every_outcome(
                    lambda: self.rays.first_hit(origin, direction),
                    self.rays.decisions,
                    MOST_OUTCOMES,
                    all_or_none=True,
                )
                found = [FirstHit(*hit) for hit in hits]
        except TooManyOutcomesError as error:
            raise UndecidableError from error
        if not all(value.is_finite() for hit in found for value in hit.values):
            raise UndecidableError  # a triangle seen edge on may be met anywhere
        return found

    def _primary_ray(self, column: int, row: int) -> tuple[Any, Any]:
        """The very same for a pixel's colours and first hits, which makes it cheaper to meet."""
        if self._primary is None or self._primary[0] != (column, row):
            self._primary = (column, row), self.rays.primary_ray(column, row)
        return self._primary[1]

    def _followed(self, ray: Any) -> FollowedRay:
        """The ray tree of a camera ray, the heaviest rays first, until the pixel's work is spent.

        Two budgets follow the same rays in the same order, so that the larger one leaves less open.
        """
        order = itertools.count()
        last = self.rays.work_done() + self.most_work
        root = FollowedRay(ray, MOST_OUTCOMES)
        waiting = [(0.0, next(order), root)]
        while waiting:
            followed = heappop(waiting)[2]
            if self._is_negligible(followed.ray[2]):
                continue
            if self.rays.work_done() >= last:
                self._give_up(spent=True)
                break
            try:
                self._follow(followed)
            except TooManyOutcomesError:
                self._give_up(spent=False)
            for child in followed.children():
                heappush(waiting, (-_heaviest(child.ray[2]), next(order), child))
        return root

    def _follow(self, followed: FollowedRay) -> None:
        """Find all ways that a ray may go. Raises TooManyOutcomesError."""
        run, decisions, most = (lambda: self._step(followed.ray)), self.rays.decisions, followed.most
        steps = list(every_outcome(run, decisions, most, all_or_none=True))
        share = max(1, most // len(steps))
        followed.ways = [(local, [FollowedRay(child, share) for child in children]) for local, children in steps]

    def _is_negligible(self, weight: Box) -> bool:
        return self.bound is not None and all(channel < self.negligible_weight for channel in weight)

    def _give_up(self, *, spent: bool) -> None:
        """Leave open what a ray contributes, or all that wait: that is as good as too many outcomes."""
        self.spent = self.spent or spent
        if self.bound is None:
            raise UndecidableError
        if spent:
            self.merged = True
        else:
            self._merge()

    def _outcomes(self, followed: FollowedRay) -> list[Box]:
        """All that a ray and those that go on from it may contribute."""
        if followed.ways is None:
            return [self._anything(followed.ray[2])]
        boxes: list[Box] = []
        for local, children in followed.ways:
            sums = [local]
            for child in children:
                added = self._outcomes(child)
                if len(sums) * len(added) > MOST_OUTCOMES:
                    sums, added = self._hull(sums), self._hull(added)
                sums = [_sum(a, b) for a in sums for b in added]
            boxes.extend(sums)
        boxes = boxes if len(boxes) <= MOST_OUTCOMES else self._hull(boxes)
        if self.bound is None:
            if not all(channel.is_finite() for box in boxes for channel in box):
                raise UndecidableError
            return boxes
        possible = self._anything(followed.ray[2])
        return [_common(box, possible) for box in boxes]

    def _step(self, ray: Any) -> tuple[Box, list[Any]]:
        """The ray's own contribution, and the rays that go on from its end."""
        local, children = self.rays.trace(ray)
        if self.bound is None:
            return local, children
        # No surface of such a scene gives back more than it gets, however little the balls know of Fresnel's split.
        most = self._from_black(ray[2], self.bound.growth * self.excess)
        return local, [(*child[:2], _common(child[2], most), *child[3:]) for child in children]

    def _anything(self, weight: Box) -> Box:
        """The box of all that a ray of this weight can bring: from black to the weight times the brightest radiance."""
        if self.bound is None:
            raise UndecidableError
        return self._from_black(weight, self.bound.radiance * self.excess)

    def _merge(self) -> None:
        if not self.may_merge:
            raise UndecidableError
        self.merged = True

    def _hull(self, boxes: list[Box]) -> list[Box]:
        """The one box that holds them all."""
        self._merge()
        red, green, blue = boxes[0]
        for box in boxes[1:]:
            red, green, blue = red.union(box[0]), green.union(box[1]), blue.union(box[2])
        return [(red, green, blue)]

    @staticmethod
    def _from_black(weight: Box, factor: float) -> Box:
        """The balls from 0 to a finite weight times the factor."""
        halves = [channel.upper() * (factor / 2) for channel in weight]
        red, green, blue = (arb(half, half.upper()) for half in halves)
        return red, green, blue


def _heaviest(weight: Box) -> float:
    """The largest that a channel may be; infinite where nothing is known."""
    return max(float(channel.upper()) if channel.is_finite() else inf for channel in weight)


def _sum(a: Box, b: Box) -> Box:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _common(box: Box, possible: Box) -> Box:
    """What a box and one that surely holds the value have in common: the latter where the arithmetic broke down."""
    red, green, blue = (
        ball.intersection(limit) if ball.is_finite() and ball.overlaps(limit) else limit
        for ball, limit in zip(box, possible, strict=True)
    )
    return red, green, blue


def widest(boxes: list[Box]) -> float:
    """The largest radius of any channel of any box, a half width."""
    return max(float(channel.rad()) for box in boxes for channel in box)
