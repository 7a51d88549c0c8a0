"""The ray tree of a pixel, followed in compiled code as PixelEvaluator (feasible_pixel.py) follows it.

These functions are part of the text of a kernel (pixel_program.py), whose functions they call. Numbers are those of its
arithmetic; weights and what rays bring are boxes of plain balls.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.feasible_sets.boxes import box_common, box_from_black, box_is_under, heaviest
from raytruth.comparisons.feasible_sets.plain_rays import (
    box_of,
    forget_rays,
    keep_ray,
    kept_ray,
    known_number,
    rays_kept,
    work_done,
)
from raytruth.comparisons.feasible_sets.tree_memory import (
    ALL_WAYS,
    CHILDREN,
    DEPTH,
    FIRST_CHILD,
    FIRST_WAY,
    IS_FULL,
    LEFT,
    MEDIUM,
    MERGED,
    MOST,
    MOST_NODES,
    MOST_WAYS_OF_ALL,
    NODES,
    RAY,
    SPENT,
    UNDECIDABLE,
    WAITING,
    WAYS,
)
from raytruth.reference_tracer.arithmetics.scripted_decisions import begin_decisions, next_way, ways_left
from raytruth.reference_tracer.compiler.questions import state
from raytruth.reference_tracer.source.ray_tree import trace_ray

if TYPE_CHECKING:
    from typing import Any

    from raytruth.comparisons.feasible_sets.boxes import Box
    from raytruth.reference_tracer.source.scene_data import SceneData


def follow_tree(scene: SceneData) -> None:
    """Follow the ray tree of the camera ray that waits, the heaviest rays first, until the pixel's work is spent."""
    tree, limits = state().tree, state().limits
    counts = tree.counts
    last = work_done() + limits.most_work
    while counts[WAITING] > 0:
        node = taken_heaviest()
        if not is_negligible(node):
            if work_done() >= last:
                give_up(True)
                counts[WAITING] = 0
            else:
                follow(scene, node)
        if counts[UNDECIDABLE] == 1 or counts[IS_FULL] == 1:
            counts[WAITING] = 0


def taken_heaviest() -> int:
    """The heaviest of the rays that wait, of several the one that was found first; it waits no longer."""
    tree = state().tree
    best = 0
    weight = heaviest(weight_of(tree.waiting[0]))
    for place in range(1, tree.counts[WAITING]):
        other = heaviest(weight_of(tree.waiting[place]))
        is_first = tree.waiting[place] < tree.waiting[best]
        if other > weight or (other == weight and is_first):
            best = place
            weight = other
    node: int = tree.waiting[best]
    tree.counts[WAITING] = tree.counts[WAITING] - 1
    tree.waiting[best] = tree.waiting[tree.counts[WAITING]]
    return node


def weight_of(node: int) -> Box:
    """A node's weight."""
    weights = state().tree.weights
    return (weights[node, 0], weights[node, 1], weights[node, 2])


def is_negligible(node: int) -> bool:
    """Whether a ray does not deserve its own tree."""
    if state().limits.has_bound == 0:
        return False
    return box_is_under(weight_of(node), state().limits.negligible)


def give_up(spent: bool) -> None:
    """Leave open what a ray contributes, or all that wait: that is as good as too many outcomes."""
    counts = state().tree.counts
    if spent:
        counts[SPENT] = 1
    if state().limits.has_bound == 0:
        counts[UNDECIDABLE] = 1
    elif spent:
        counts[MERGED] = 1
    else:
        merge()


def merge() -> None:
    """One box is to hold several outcomes, if they may be merged."""
    counts = state().tree.counts
    if state().limits.may_merge == 0:
        counts[UNDECIDABLE] = 1
    counts[MERGED] = 1


def follow(scene: SceneData, node: int) -> None:
    """Find all ways that a ray may go; none of them, if there are too many."""
    tree = state().tree
    most = tree.nodes[node, MOST]
    ways, nodes, rays = tree.counts[ALL_WAYS], tree.counts[NODES], rays_kept()
    begin_decisions()
    taken = 0
    is_open = True
    fits = True
    while is_open:
        add_way(scene, node)
        taken = taken + 1
        fits = taken + ways_left(0) <= most and tree.counts[IS_FULL] == 0
        is_open = fits and next_way(0)
    if fits:
        tree.nodes[node, FIRST_WAY] = ways
        tree.nodes[node, WAYS] = taken
        add_waiting(nodes, share_of(most, taken))
    else:
        tree.counts[ALL_WAYS] = ways
        tree.counts[NODES] = nodes
        forget_rays(rays)
        give_up(False)


def share_of(most: int, ways: int) -> int:
    """Most // ways, at least 1."""
    share = 1
    while (share + 1) * ways <= most:
        share = share + 1
    return share


def add_waiting(first: int, most: int) -> None:
    """All nodes from the first one on wait, each for so many outcomes."""
    tree = state().tree
    for node in range(first, tree.counts[NODES]):
        tree.nodes[node, MOST] = most
        tree.waiting[tree.counts[WAITING]] = node
        tree.counts[WAITING] = tree.counts[WAITING] + 1


def add_way(scene: SceneData, node: int) -> None:
    """The way that the decisions let a ray go: what it brings by itself, and the rays that go on from its end."""
    tree = state().tree
    way, first = tree.counts[ALL_WAYS], tree.counts[NODES]
    origin, direction = kept_ray(tree.nodes[node, RAY])
    box = weight_of(node)
    weight = (known_number(box[0]), known_number(box[1]), known_number(box[2]))
    waiting = [(origin, direction, weight, tree.nodes[node, LEFT], tree.nodes[node, MEDIUM], tree.nodes[node, DEPTH])]
    local = trace_ray(scene, waiting.pop(), waiting)
    children = len(waiting)
    if way >= MOST_WAYS_OF_ALL or first + children > MOST_NODES:
        tree.counts[IS_FULL] = 1
    else:
        for channel in range(3):
            tree.local[way, channel] = box_of(local[channel])
        tree.ways[way, FIRST_CHILD] = first
        tree.ways[way, CHILDREN] = children
        tree.counts[ALL_WAYS] = way + 1
        while len(waiting) > 0:
            put_node(first + len(waiting) - 1, waiting.pop(), node)
        tree.counts[NODES] = first + children


def put_node(node: int, ray: Any, parent: int) -> None:
    """A ray of the tree, which is not followed yet.

    No surface of a scene with a bound gives back more than it gets, however little balls know of Fresnel's split.
    """
    tree, limits = state().tree, state().limits
    origin, direction, weight, left, medium, depth = ray
    box = (box_of(weight[0]), box_of(weight[1]), box_of(weight[2]))
    if limits.has_bound == 1:
        box = box_common(box, box_from_black(weight_of(parent), limits.growth))
    tree.nodes[node, RAY] = keep_ray(origin, direction)
    tree.nodes[node, LEFT] = left
    tree.nodes[node, MEDIUM] = medium
    tree.nodes[node, DEPTH] = depth
    tree.nodes[node, WAYS] = -1
    for channel in range(3):
        tree.weights[node, channel] = box[channel]
