"""Where the compiled evaluator keeps the ray tree of one pixel: arrays in the state of the program, made once.

Nodes are rays, numbered as they are found, so that a ray's children come behind it. A node that is followed has a row
of `ways` for each way that it may go, in order.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple

if TYPE_CHECKING:
    from raytruth.reference_tracer.compiler.types import Type
    from raytruth.reference_tracer.source.numbers import Table

# A kilobyte each. Where a tree needs more of them, Arb evaluates the pixel: none of the library's does.
MOST_NODES = 2**12
MOST_WAYS_OF_ALL = 2**12

# Columns of `nodes`.
RAY, LEFT, MEDIUM, DEPTH, MOST, FIRST_WAY, WAYS, BOXES = range(8)
# Columns of `ways`.
FIRST_CHILD, CHILDREN = range(2)
# Places of `counts`.
NODES, ALL_WAYS, WAITING, MERGED, SPENT, UNDECIDABLE, IS_FULL, RAYS, IS_REMEMBERED, REMEMBERED = range(10)
NUMBER_OF_COUNTS = 10


class Tree(NamedTuple):
    """The rays of a pixel, and what they bring."""

    nodes: Table
    """For each: where its origin and direction are kept; what it left; its medium; the depth left; how many outcomes
    may still be told apart; its first way; how many ways, or -1 where it is not followed; how many boxes."""
    weights: Table
    """A box for each node."""
    boxes: Table
    """For each node, all that it and those that go on from it may bring."""
    ways: Table
    """For each: the first child, and how many."""
    local: Table
    """A box for each way: what the ray brings by itself."""
    waiting: Table
    """Nodes that are not followed yet."""
    sums: Table
    """Boxes on the way to those of one node."""
    counts: Table


class Limits(NamedTuple):
    """What is known of all rays of a scene, and how long a pixel may take."""

    has_bound: int
    """1 where the others are known; else they are 0."""
    negligible: float
    """What is lighter in all channels is not followed."""
    radiance: float
    """What a ray of weight 1 can bring."""
    growth: float
    """How much heavier than its parent a ray can be."""
    at_camera: float
    may_merge: int
    most_work: int
    image_radius: float


LIMITS_TYPE = Tuple(
    (Integer(), Float(64), Float(64), Float(64), Float(64), Integer(), Integer(), Float(64)),
    Limits._fields,
    Limits.__name__,
)
# Of one node: the sums of a way, the next sums, and all ways' sums one after the other.
NEXT_SUMS = MOST_OUTCOMES
ALL_SUMS = 2 * MOST_OUTCOMES
MOST_SUMS = ALL_SUMS + MOST_OUTCOMES * MOST_OUTCOMES


def tree_type(ball: Type) -> Tuple:
    """The type of a tree whose boxes are made of such balls."""
    wholes, boxes = Array(Integer(), 2), Array(ball, 2)
    kinds = (wholes, boxes, Array(ball, 3), wholes, boxes, Array(Integer()), boxes, Array(Integer()))
    return Tuple(kinds, Tree._fields, Tree.__name__)


def tree_memory(parts: int) -> Tree:
    """Room for a pixel's tree, whose balls are so many floats each."""
    return Tree(
        nodes=_wholes(MOST_NODES, 8),
        weights=np.zeros((MOST_NODES, 3, parts)),
        boxes=np.zeros((MOST_NODES, MOST_OUTCOMES, 3, parts)),
        ways=_wholes(MOST_WAYS_OF_ALL, 2),
        local=np.zeros((MOST_WAYS_OF_ALL, 3, parts)),
        waiting=_wholes(MOST_NODES),
        sums=np.zeros((MOST_SUMS, 3, parts)),
        counts=_wholes(NUMBER_OF_COUNTS),
    )


def _wholes(*shape: int) -> Any:
    return np.zeros(shape, dtype=np.int64)
