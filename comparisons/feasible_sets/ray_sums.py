"""What the rays of a followed tree may bring together, in compiled code: as PixelEvaluator sums it up, box by box.

Part of the text of a kernel, as followed_rays.py is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.feasible_sets.boxes import (
    box_common,
    box_from_black,
    box_hull,
    box_is_finite,
    box_sum,
)
from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES
from raytruth.comparisons.feasible_sets.followed_rays import merge, weight_of
from raytruth.comparisons.feasible_sets.tree_memory import (
    ALL_SUMS,
    BOXES,
    CHILDREN,
    FIRST_CHILD,
    FIRST_WAY,
    NEXT_SUMS,
    NODES,
    UNDECIDABLE,
    WAYS,
)
from raytruth.reference_tracer.compiler.questions import state

if TYPE_CHECKING:
    from raytruth.comparisons.feasible_sets.boxes import Box


def sum_up() -> None:
    """The boxes of all nodes, children before their parents."""
    counts = state().tree.counts
    node = counts[NODES] - 1
    while node >= 0 and counts[UNDECIDABLE] == 0:
        if state().tree.nodes[node, WAYS] < 0:
            put_anything(node)
        else:
            put_outcomes(node)
        node = node - 1


def put_anything(node: int) -> None:
    """Of a ray that is not followed: from black to its weight times the brightest radiance."""
    if state().limits.has_bound == 0:
        state().tree.counts[UNDECIDABLE] = 1
    put_box(node, 0, box_from_black(weight_of(node), state().limits.radiance))
    state().tree.nodes[node, BOXES] = 1


def put_outcomes(node: int) -> None:
    """All that a ray and those that go on from it may contribute."""
    tree = state().tree
    first, found = tree.nodes[node, FIRST_WAY], 0
    for way in range(first, first + tree.nodes[node, WAYS]):
        count = put_sums(way)
        for place in range(count):
            put_sum(ALL_SUMS + found + place, sum_at(place))
        found = found + count
    if found > MOST_OUTCOMES:
        put_sum(ALL_SUMS, hull_of_sums(ALL_SUMS, found))
        found = 1
    for place in range(found):
        put_box(node, place, possible(node, sum_at(ALL_SUMS + place)))
    tree.nodes[node, BOXES] = found


def put_sums(way: int) -> int:
    """The sums of what a ray brings by itself, gone this way, and of what its children do; gives how many."""
    tree = state().tree
    put_sum(0, (tree.local[way, 0], tree.local[way, 1], tree.local[way, 2]))
    count = 1
    first = tree.ways[way, FIRST_CHILD]
    for child in range(first, first + tree.ways[way, CHILDREN]):
        added = tree.nodes[child, BOXES]
        if count * added > MOST_OUTCOMES:
            put_sum(0, hull_of_sums(0, count))
            put_box(child, 0, hull_of_boxes(child, added))
            count, added = 1, 1
        for place in range(count):
            for other in range(added):
                put_sum(NEXT_SUMS + place * added + other, box_sum(sum_at(place), box_at(child, other)))
        count = count * added
        for place in range(count):
            put_sum(place, sum_at(NEXT_SUMS + place))
    return count


def possible(node: int, box: Box) -> Box:
    """What of a box a ray of this weight can bring."""
    if state().limits.has_bound == 1:
        return box_common(box, box_from_black(weight_of(node), state().limits.radiance))
    if not box_is_finite(box):
        state().tree.counts[UNDECIDABLE] = 1
    return box


def hull_of_sums(first: int, count: int) -> Box:
    """The one box that holds so many sums, which are merged."""
    merge()
    hull = sum_at(first)
    for place in range(1, count):
        hull = box_hull(hull, sum_at(first + place))
    return hull


def hull_of_boxes(node: int, count: int) -> Box:
    """The same of a node's boxes."""
    merge()
    hull = box_at(node, 0)
    for place in range(1, count):
        hull = box_hull(hull, box_at(node, place))
    return hull


def sum_at(place: int) -> Box:
    """A sum."""
    sums = state().tree.sums
    return (sums[place, 0], sums[place, 1], sums[place, 2])


def put_sum(place: int, box: Box) -> None:
    """Keep a sum."""
    for channel in range(3):
        state().tree.sums[place, channel] = box[channel]


def box_at(node: int, place: int) -> Box:
    """A box of a node."""
    boxes = state().tree.boxes
    return (boxes[node, place, 0], boxes[node, place, 1], boxes[node, place, 2])


def put_box(node: int, place: int, box: Box) -> None:
    """Give a node a box."""
    for channel in range(3):
        state().tree.boxes[node, place, channel] = box[channel]
