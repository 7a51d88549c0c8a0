from __future__ import annotations

import numpy as np
import pytest

from raytruth.reference_tracer.bounding_volume_tree import TRIANGLES_IN_A_LEAF, build_tree

pytestmark = pytest.mark.clause("ARI-8")


@pytest.mark.parametrize("count", [1, TRIANGLES_IN_A_LEAF, TRIANGLES_IN_A_LEAF + 1, 17, 300])
def test_every_triangle_is_in_one_leaf_within_all_boxes_above_it(count: int) -> None:
    corners = np.random.default_rng(count).uniform(-1, 1, (count, 3, 3))
    tree = build_tree(corners)
    assert sorted(tree.order.tolist()) == list(range(count))
    placed = []
    for node in range(len(tree.end)):
        assert tree.count[node] <= TRIANGLES_IN_A_LEAF
        is_leaf = tree.end[node] == node + 1
        assert (tree.count[node] > 0) == is_leaf
        leaves = [leaf for leaf in range(node, tree.end[node]) if tree.count[leaf]]
        places = [place for leaf in leaves for place in range(tree.first[leaf], tree.first[leaf] + tree.count[leaf])]
        if is_leaf:
            placed += places
        below = corners[tree.order[places]]
        # Exactly, so that a box that is missed holds no hit.
        assert (below.min(axis=(0, 1)) == tree.low[node]).all()
        assert (below.max(axis=(0, 1)) == tree.high[node]).all()
    assert placed == list(range(count))
    assert tree.end[0] == len(tree.end)


def test_triangles_in_one_place_are_split_all_the_same() -> None:
    corners = np.ones((100, 3, 3))
    tree = build_tree(corners)
    assert sorted(tree.order.tolist()) == list(range(100))
    assert tree.count.max() <= TRIANGLES_IN_A_LEAF


def test_the_tree_halves_so_its_depth_is_logarithmic() -> None:
    tree = build_tree(np.random.default_rng(0).uniform(-1, 1, (1024, 3, 3)))
    depth = max(sum(start <= node < tree.end[start] for start in range(node + 1)) for node in range(len(tree.end)))
    assert depth <= 1 + 10 - 2  # 1024 = 2^10 triangles, four in a leaf
