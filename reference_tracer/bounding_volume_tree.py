"""A tree of boxes around triangles, so that a ray need not be tested against all of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Two box tests cost about as much as four triangle tests in compiled code, so smaller leaves do not pay.
TRIANGLES_IN_A_LEAF = 4


@dataclass(frozen=True)
class Tree:
    """Nodes in depth-first order: the first child follows its parent, `end` follows a node's whole subtree."""

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    end: NDArray[np.int64]
    first: NDArray[np.int64]
    count: NDArray[np.int64]
    order: NDArray[np.int64]


@dataclass
class _Growing:
    low: list[NDArray[np.float64]] = field(default_factory=list)
    high: list[NDArray[np.float64]] = field(default_factory=list)
    end: list[int] = field(default_factory=list)
    first: list[int] = field(default_factory=list)
    count: list[int] = field(default_factory=list)
    order: list[int] = field(default_factory=list)


def build_tree(corners: NDArray[np.float64]) -> Tree:
    """A tree of boxes around triangles, split at the median along the longest side; `corners`: (n, 3, 3), n > 0.

    The boxes hold the corners exactly, without rounding, so a box that is missed holds no hit.
    """
    growing = _Growing()
    _grow(growing, corners, np.arange(len(corners)))
    return Tree(
        low=np.array(growing.low),
        high=np.array(growing.high),
        end=np.array(growing.end),
        first=np.array(growing.first),
        count=np.array(growing.count),
        order=np.array(growing.order),
    )


def _grow(tree: _Growing, corners: NDArray[np.float64], triangles: NDArray[np.int64]) -> None:
    node = len(tree.end)
    boxed = corners[triangles]
    tree.low.append(boxed.min(axis=(0, 1)))
    tree.high.append(boxed.max(axis=(0, 1)))
    tree.first.append(len(tree.order))
    tree.count.append(0)
    tree.end.append(0)
    if len(triangles) <= TRIANGLES_IN_A_LEAF:
        tree.count[node] = len(triangles)
        tree.order.extend(triangles.tolist())
    else:
        axis = int(np.argmax(tree.high[node] - tree.low[node]))
        ranked = triangles[np.argsort(boxed[:, :, axis].sum(axis=1), kind="stable")]
        _grow(tree, corners, ranked[: len(ranked) // 2])
        _grow(tree, corners, ranked[len(ranked) // 2 :])
    tree.end[node] = len(tree.end)
