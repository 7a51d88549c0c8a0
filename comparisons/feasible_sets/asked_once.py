"""Functions of a kernel that are looked at as a whole: what they found before, or whether all their ways agree."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.reference_tracer.arithmetics.balls import TooManyOutcomesError, every_outcome
from raytruth.reference_tracer.source.traversal import NOTHING

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reference_tracer.arithmetics.balls import Decisions
    from raytruth.reference_tracer.arithmetics.kernel import Kernel

# Ways that are followed through the comparisons of one shadow ray. It only bounds the work: beyond, both light and
# shadow are possible. Where six triangles of a box meet, ways to a shadow and past it are found within some dozens.
MOST_WAYS = 64


class RememberedHit:
    """A kernel's nearest hit, which need not be found twice for a pixel's colour and for its first hit."""

    def __init__(self, find: Callable[..., tuple[Any, int]], decisions: Decisions) -> None:
        self.find = find
        self.decisions = decisions
        self.ray: tuple[Any, Any] = (None, None)
        self.hit: tuple[Any, int] = (None, NOTHING)

    def __call__(self, data: Any, origin: Any, direction: Any, left: int) -> tuple[Any, int]:
        """The nearest hit: the last camera ray's, if it is asked for again and no comparison was undecided."""
        if origin is self.ray[0] and direction is self.ray[1]:
            return self.hit
        before = self.decisions.position
        hit = self.find(data, origin, direction, left)
        if left == NOTHING and self.decisions.position == before:
            self.ray, self.hit = (origin, direction), hit
        return hit


class OneDecision:
    """A kernel's function that is true or false, as one decision, however many comparisons it rests on.

    A shadow ray to a corner leaves open, of each triangle there, by which of its edges it may pass: all these ways end
    in light or in shadow. Where they do not all agree, or are too many, both are possible.
    """

    def __init__(self, function: Callable[..., bool], decisions: Decisions) -> None:
        self.function = function
        self.decisions = decisions

    def __call__(self, *arguments: Any) -> bool:
        """What all ways agree on, or else what the decisions say."""
        answers, position = self.decisions.answers, self.decisions.position
        try:
            agreed = self._agreed(arguments)
        finally:
            self.decisions.answers, self.decisions.position = answers, position
        return self.decisions.next() if agreed is None else agreed

    def _agreed(self, arguments: tuple[Any, ...]) -> bool | None:
        found: set[bool] = set()
        try:
            for outcome in every_outcome(lambda: bool(self.function(*arguments)), self.decisions, MOST_WAYS):
                found.add(outcome)
                if len(found) > 1:
                    return None
        except TooManyOutcomesError:
            return None
        return found.pop()


def decide_shadows_once(kernel: Kernel, decisions: Decisions) -> None:
    """Make whether anything stands in a shadow ray's way one decision, in the kernel of a scene that has lights."""
    if hasattr(kernel, "is_occluded"):
        kernel.is_occluded = OneDecision(kernel.is_occluded, decisions)
