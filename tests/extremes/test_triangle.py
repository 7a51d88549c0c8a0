"""Rays through shared edges that fall between the two triangles in the textbook's forms, in float64.

Of 16,319 random rays that were aimed at a point of an edge with a triangle on either side, Cramer's rule missed both
for 1,697, Möller's and Trumbore's code for 1,093, the watertight form for none. The first of each is pinned here.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import pytest

from raytruth.reference_tracer.arithmetics.textbook_forms import cramer_triangle_distance, moeller_trumbore
from raytruth.reference_tracer.source.triangle import longest_axis, triangle_distance
from raytruth.reference_tracer.source.vector import cross, dot, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.properties.strategies import Vector

# Origin, direction, both ends of the edge, and the other corners.
MISSED_BY_CRAMERS_RULE = """
-0x1.55069ed43cdb8p-3 0x1.71570862489e8p-2 0x1.241edadc8cd06p-1
-0x1.7eeecf521fe88p-2 -0x1.fd416728d5251p-1 -0x1.3663768f0762cp+0
0x1.9419174e53cfcp-2 -0x1.fa2673de59802p-1 -0x1.d7ff34710fd92p-1
-0x1.67628044c8d6cp-1 -0x1.253cd4d2c61fap-1 -0x1.2fe88291d6862p-1
-0x1.cddbf76ef7432p-1 -0x1.2193558c13592p-1 0x1.9d7afd2310690p-3
0x1.8b57498090adap-1 -0x1.34375901bde20p-2 -0x1.119a5c5ccc0bcp-2
"""
MISSED_BY_MOELLER_TRUMBORE = """
-0x1.f993e74ec08fep-1 -0x1.333f953bd58b6p-1 0x1.d477f1263ad12p-1
0x1.4cd3b8cdefebep+0 0x1.aa2b7af7c4ff2p-1 -0x1.556431855bc2ep+0
0x1.5fcbdb656c5c2p-1 0x1.1974802461868p-1 0x1.9dbf1214b8f20p-3
0x1.5fd339eff3110p-4 0x1.47f572d25f1c0p-5 -0x1.96bb58a1e5878p-1
0x1.1a6420dbae7f8p-3 0x1.f4c4a155e65a4p-1 0x1.d545dba9fe588p-2
-0x1.11d1e49a6b3d0p-4 -0x1.d480eb03961e0p-4 0x1.7aa842ddba46ep-1
"""


def vectors(text: str) -> list[Vector]:
    rows = [list(map(float.fromhex, line.split())) for line in text.split("\n") if line]
    return [(x, y, z) for x, y, z in rows]


@pytest.mark.clause("TRI-1")
@pytest.mark.parametrize(
    ("variant", "text"),
    [(cramer_triangle_distance, MISSED_BY_CRAMERS_RULE), (moeller_trumbore, MISSED_BY_MOELLER_TRUMBORE)],
)
def test_a_ray_that_a_textbook_form_loses_between_two_triangles_hits_one(
    variant: Callable[..., float], text: str
) -> None:
    origin, direction, one, other, left, right = vectors(text)
    pair = ((one, other, left), (other, one, right))
    assert [variant(origin, direction, *corners) for corners in pair] == [inf, inf]
    # It was aimed at the edge, at t = 1.
    assert min(triangle_distance(origin, direction, *corners) for corners in pair) == pytest.approx(1, abs=1e-14)


@pytest.mark.clause("TRAV-5")
@pytest.mark.parametrize("scale", [1e-4, 1e-12, 1e-30])
def test_small_triangles_are_lost_by_a_fixed_epsilon_only(scale: float) -> None:
    corners = ((0.0, 0.0, 0.0), (scale, 0.0, 0.0), (0.0, scale, 0.0))
    ray = ((scale / 4, scale / 4, scale), (0.0, 0.0, -1.0))
    assert moeller_trumbore(*ray, *corners) == inf
    assert triangle_distance(*ray, *corners) == pytest.approx(scale, rel=1e-15)


# Origin, direction and corners of the first of 5,461 in 400,000 random triangles in which a ray nearly lies: the scalar
# product of its direction and the rounded normal is exactly 0, and yet it passes inside.
EDGE_ON = """
-0x1.5478f75337f58p-2 0x1.558b381cbb1e0p-1 -0x1.f8601cc2ccf80p-4
0x1.95a3d718d6758p-2 -0x1.97b6cfb31b78cp-1 -0x1.6c9d190d04914p-2
0x1.204d18c2002e0p+0 -0x1.ac8a7e20024eep+0 -0x1.3193b8642e0c7p+0
0x1.eb40f86d4a080p-6 -0x1.ef8afdd5286edp-2 -0x1.3de05501af13cp-1
0x1.9cd35a22eed77p-3 -0x1.71ad32c3acc59p-2 -0x1.2b59c09a80710p-1
"""


@pytest.mark.clause("TRI-1")
def test_a_triangle_seen_edge_on_is_met_between_its_corners() -> None:
    origin, direction, a, b, c = vectors(EDGE_ON)
    assert dot(direction, cross(subtract(b, a), subtract(c, a))) == 0.0
    axis = longest_axis(direction)
    depths = [(corner[axis] - origin[axis]) / direction[axis] for corner in (a, b, c)]
    assert min(depths) <= triangle_distance(origin, direction, a, b, c) <= max(depths)
