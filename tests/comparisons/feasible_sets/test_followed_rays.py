"""What needs no compiled tree is tested here; how trees are followed, in test_compiled_pixels.py."""

from __future__ import annotations

import pytest

from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES
from raytruth.comparisons.feasible_sets.followed_rays import share_of

pytestmark = pytest.mark.clause("VER-2")


def test_the_ways_of_a_ray_share_what_may_be_told_apart_but_each_leaves_one() -> None:
    for most in range(1, MOST_OUTCOMES + 1):
        for ways in range(1, MOST_OUTCOMES + 1):
            assert share_of(most, ways) == max(1, most // ways)
