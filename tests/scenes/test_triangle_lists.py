from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raytruth.scenes.triangle_lists import (
    LARGEST_FACE_COUNT,
    MeshFileError,
    check_coordinate,
    check_face_count,
    check_polygon,
    fan,
)

pytestmark = pytest.mark.clause("SCN-3")


@settings(deadline=None)  # the machine may be busy
@given(st.lists(st.integers(0, 99), min_size=3, max_size=9, unique=True))
def test_a_fan_runs_around_the_polygon_once(polygon: list[int]) -> None:
    triangles = fan(tuple(polygon))
    edges = [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]
    outline = set(zip(polygon, polygon[1:] + polygon[:1], strict=True))
    inner = [edge for edge in edges if edge not in outline]
    assert outline <= set(edges)
    assert sorted(inner) == sorted((b, a) for a, b in inner)
    assert len(triangles) == len(polygon) - 2


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1.1e12])
def test_a_coordinate_that_is_not_finite_or_absurd_is_refused(value: float) -> None:
    with pytest.raises(MeshFileError, match="expected a finite coordinate"):
        check_coordinate(value)


@pytest.mark.parametrize(
    ("corners", "sentence"),
    [
        ((), "expected a face with at least three vertices, found 0."),
        ((0, 1), "expected a face with at least three vertices, found 2."),
        ((0, 1, 0), "expected a face with each vertex once, found one again; remove the corner or the face."),
        ((0, 1, 2, 3, 0), "expected a face with each vertex once, found one again; remove the corner or the face."),
    ],
)
def test_a_face_needs_three_different_corners(corners: tuple[int, ...], sentence: str) -> None:
    with pytest.raises(MeshFileError) as caught:
        check_polygon(corners)
    assert str(caught.value) == sentence


def test_the_limit_on_faces_is_inclusive() -> None:
    check_face_count(LARGEST_FACE_COUNT)
    with pytest.raises(MeshFileError, match="too many faces"):
        check_face_count(LARGEST_FACE_COUNT + 1)
