from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from raytruth.reference_tracer.source.bounding_volume import box_is_missed, rounding_allowance
from tests.properties.exact import exact
from tests.properties.strategies import BOX_PARTS, Fan, Ray, Vector, directions, rays_at_fans, vectors
from tests.reference_tracer.kernels import numpy_kernel
from tests.reproduction import note_case

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("TRAV-4")

Box = tuple[Vector, Vector]


INSIDE = st.one_of(st.sampled_from([0.5, 0.0, 1.0]), st.floats(0.0, 1.0))


@st.composite
def rays_near_boxes(draw: st.DrawFn, parts: st.SearchStrategy[float] = BOX_PARTS) -> tuple[Ray, Box]:
    """Aimed at a point inside, on a face, an edge or a corner of the box, or beside it; boxes may be flat."""
    scale = draw(st.sampled_from([1.0, 1e-6, 1e6]))
    one, other = draw(vectors(scale)), draw(vectors(scale))
    low, high = tuple(map(min, one, other)), tuple(map(max, one, other))
    x, y, z = (low[axis] + draw(parts) * (high[axis] - low[axis]) for axis in range(3))
    direction = draw(st.one_of(directions(), vectors().filter(any)))
    back = draw(st.sampled_from([0.0, 1.0, 20.0, -1.0])) * scale
    return Ray((x - back * direction[0], y - back * direction[1], z - back * direction[2]), direction), (low, high)  # type: ignore[return-value]


def touches(ray: Ray, box: Box, end: float) -> bool:
    """Whether o + t·d is in the closed box for some 0 <= t <= end, exactly."""
    entry, leave = Fraction(0), None if end == inf else Fraction(end)
    for origin, direction, low, high in zip(*map(exact, (*ray, *box)), strict=True):
        if direction == 0:
            if not low <= origin <= high:
                return False
            continue
        near, far = sorted(((low - origin) / direction, (high - origin) / direction))
        entry, leave = max(entry, near), far if leave is None else min(leave, far)
    return leave is None or entry <= leave


@given(rays_near_boxes(INSIDE), st.sampled_from([inf, 1.0, 20.0, 1e8]))
def test_no_box_that_the_ray_touches_is_taken_as_missed(case: tuple[Ray, Box], end: float) -> None:
    ray, box = case
    note_case(ray=ray, box=box, end=end)
    assume(touches(ray, box, end))
    assert not box_is_missed(*ray, *box, end)


@given(rays_near_boxes(), st.sampled_from([inf, 1.0, 20.0, 1e-7]))
def test_boxes_that_are_missed_by_more_than_rounding_are_taken_as_missed(case: tuple[Ray, Box], end: float) -> None:
    ray, (low, high) = case
    note_case(ray=ray, low=low, high=high, end=end)
    # The allowance is a part of the distance to the box, which is twice the largest coordinate at most; and as much
    # again is more than float64 rounds.
    size = max(*map(abs, low), *map(abs, high), *map(abs, ray.origin)) * 4 * rounding_allowance()
    wider = (tuple(x - size for x in low), tuple(x + size for x in high))
    assume(not touches(ray, wider, end))  # type: ignore[arg-type]
    assert box_is_missed(*ray, low, high, end)


@pytest.mark.parametrize("number", [np.float64, np.float32])
@given(case=rays_at_fans())
def test_no_box_of_a_triangle_is_missed_that_rounding_makes_the_ray_hit(
    number: Callable[[float], Any], case: tuple[Ray, Fan]
) -> None:
    note_case(ray=case[0], fan=case[1])
    origin, direction, hub, *rim = (tuple(map(number, vector)) for vector in (*case[0], *case[1]))
    kernel = numpy_kernel(number)
    for one, other in pairwise(rim):
        if kernel.triangle_distance(origin, direction, hub, one, other) < inf:
            low, high = (tuple(map(choose, hub, one, other)) for choose in (min, max))
            assert not kernel.box_is_missed(origin, direction, low, high, number(inf))
