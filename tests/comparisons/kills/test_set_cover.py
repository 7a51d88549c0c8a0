from __future__ import annotations

from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.kills.set_cover import smallest_cover

pytestmark = pytest.mark.clause("VER-12")

NAMES = "abcde"


@given(
    st.lists(st.sets(st.sampled_from(NAMES), min_size=1), max_size=8),
    st.lists(st.integers(1, 9), min_size=5, max_size=5),
)
def test_the_cover_covers_and_none_is_cheaper(killers: list[set[str]], costs: list[int]) -> None:
    cost = dict(zip(NAMES, map(float, costs), strict=True))
    found = smallest_cover(killers, cost)
    assert all(scenes & set(found) for scenes in killers)
    subsets = [set(some) for size in range(6) for some in combinations(NAMES, size)]
    covering = [some for some in subsets if all(scenes & some for scenes in killers)]
    assert sum(cost[name] for name in found) == min(sum(cost[name] for name in some) for some in covering)
