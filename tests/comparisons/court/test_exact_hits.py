from __future__ import annotations

from fractions import Fraction
from itertools import permutations
from math import isinf, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.court.exact_hits import truth_of
from raytruth.comparisons.court.questions import Question
from raytruth.reference_tracer.source.triangle import triangle_distance
from tests.comparisons.court.made_questions import above, fans, on_grid, ray_to, rays_at_boxes, rays_through_corners

pytestmark = pytest.mark.clause("CRT-1")

A, B, C = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
D = (1.0, -1.0, 0.0)


@given(st.tuples(on_grid, on_grid, on_grid), st.tuples(on_grid, on_grid, above), fans())
def test_a_triangle_is_met_where_the_tracer_in_fractions_meets_it(target, origin, fan) -> None:  # type: ignore[no-untyped-def]
    for triangle in fan[1]:
        question = ray_to(target, origin, [triangle])
        points = (question.origin, question.direction, *triangle)
        exactly = triangle_distance(*(tuple(map(Fraction, point)) for point in points))  # type: ignore[arg-type]
        truth = truth_of(question)
        assert (truth.hit is False) == isinf(exactly)
        assert truth.distance is None or truth.distance == pytest.approx(float(exactly), rel=1e-15)


@given(rays_through_corners())
def test_a_corner_that_triangles_surround_is_hit_whichever_way_they_run(question: Question) -> None:
    for order in ((0, 1, 2), (2, 1, 0), (1, 2, 0)):
        turned = tuple((t[order[0]], t[order[1]], t[order[2]]) for t in question.triangles)
        truth = truth_of(question.model_copy(update={"triangles": turned}))
        assert truth.hit is True
        assert truth.primitives == {0, 1, 2, 3}
        assert truth.distance == 1.0


@given(rays_through_corners(), st.integers(0, 3))
def test_a_corner_with_a_gap_beside_it_is_only_touched(question: Question, gap: int) -> None:
    some = question.triangles[:gap] + question.triangles[gap + 1 :]
    assert truth_of(question.model_copy(update={"triangles": some})).hit is None


@pytest.mark.parametrize("axes", list(permutations(range(3))))
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_an_edge_is_hit_where_triangles_lie_on_both_sides(axes: tuple[int, int, int], side: float) -> None:
    def turned(point: tuple[float, float, float]) -> tuple[float, float, float]:
        return point[axes[0]], point[axes[1]], point[axes[2]]

    def truth(*triangles: tuple[tuple[float, float, float], ...]) -> bool | None:
        corners = [tuple(turned(corner) for corner in triangle) for triangle in triangles]
        ray = {"origin": turned((0.5, 0.0, side)), "direction": turned((0.0, 0.0, -side))}
        return truth_of(Question.model_validate({**ray, "triangles": corners})).hit

    assert truth((A, B, C)) is None
    assert truth((A, B, C), (A, B, (0.5, 2.0, 0.5))) is None
    assert truth((A, B, C), (A, B, D)) is True


def test_behind_a_touched_edge_the_surface_behind_it_may_be_answered_too() -> None:
    wall = ((-9.0, -9.0, -1.0), (9.0, -9.0, -1.0), (0.0, 9.0, -1.0))
    truth = truth_of(Question(origin=(0.5, 0.0, 1.0), direction=(0.0, 0.0, -1.0), triangles=((A, B, C), wall, wall)))
    assert truth.hit is True
    assert truth.primitives == {0, 1, 2}
    nearer = truth_of(Question(origin=(0.25, 0.25, 1.0), direction=(0.0, 0.0, -1.0), triangles=((A, B, C), wall)))
    assert nearer.primitives == {0}


@pytest.mark.parametrize(
    ("origin", "direction", "hit", "distance"),
    [
        ((-3.0, 1.0, 0.0), (1.0, 0.0, 0.0), None, 3.0),
        ((-3.0, 1.0 - 2.0**-24, 0.0), (1.0, 0.0, 0.0), True, 3.0 - sqrt(2.0**-23 - 2.0**-48)),
        ((-3.0, 1.0 + 2.0**-23, 0.0), (1.0, 0.0, 0.0), False, None),
        ((-3.0, 0.0, 0.0), (2.0, 0.0, 0.0), True, 1.0),
        ((0.5, 0.0, 0.0), (1.0, 0.0, 0.0), True, 0.5),
        ((3.0, 0.0, 0.0), (1.0, 0.0, 0.0), False, None),
        ((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), True, 2.0),
        ((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), False, None),
    ],
)
def test_a_sphere_is_hit_touched_or_missed(
    origin: tuple[float, float, float],
    direction: tuple[float, float, float],
    hit: bool | None,
    distance: float | None,
) -> None:
    truth = truth_of(Question(origin=origin, direction=direction, sphere=((0.0, 0.0, 0.0), 1.0)))
    assert (truth.hit, truth.distance) == (hit, distance)


@given(rays_at_boxes(), st.integers(0, 36))
def test_a_box_holds_its_faces_and_nothing_beyond(question: Question, steps: int) -> None:
    truth = truth_of(question)
    assert question.box is not None
    low, high = question.box

    def holds(t: Fraction) -> bool:
        point = [Fraction(o) + t * Fraction(d) for o, d in zip(question.origin, question.direction, strict=True)]
        return all(least <= part <= most for least, part, most in zip(low, point, high, strict=True))

    # Whole numbers up to 3 make each t at which a face is met a fraction of 6 at most, with a denominator of 3 at most.
    if truth.hit:
        assert truth.distance is not None
        assert holds(Fraction(truth.distance).limit_denominator(3))
    else:
        assert not holds(Fraction(steps, 6))
