from __future__ import annotations

from math import floor

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.source.texture import is_even_square, textured
from tests.reference_tracer.kernels import scene_data

EVEN, ODD, PLAIN = (1.0, 0.5, 0.25), (0.0, 0.25, 0.5), (0.7, 0.7, 0.7)


def board(size: float, offset: tuple[float, float], axes: tuple[int, int]) -> layout.SceneData:
    return scene_data(
        {
            layout.CHECKERBOARD_EVEN: [EVEN],
            layout.CHECKERBOARD_ODD: [ODD],
            layout.CHECKERBOARD_SIZE: [size],
            layout.CHECKERBOARD_FIRST_OFFSET: [offset[0]],
            layout.CHECKERBOARD_SECOND_OFFSET: [offset[1]],
            layout.CHECKERBOARD_FIRST_AXIS: [axes[0]],
            layout.CHECKERBOARD_SECOND_AXIS: [axes[1]],
            layout.MATERIAL_DIFFUSE: [PLAIN, PLAIN],
            layout.MATERIAL_DIFFUSE_BOARD: [-1, 0],
        }
    )


@pytest.mark.clause("TEX-1", "TEX-2")
@given(
    st.tuples(*[st.integers(-20, 20).map(lambda n: n / 4)] * 3),
    st.sampled_from([0.25, 1.0, 2.0]),
    st.tuples(*[st.sampled_from([0.0, 0.5, -0.25])] * 2),
    st.sampled_from([(0, 1), (0, 2), (1, 2)]),
)
def test_squares_alternate_and_belong_to_their_lower_left_borders(
    point: tuple[float, float, float], size: float, offset: tuple[float, float], axes: tuple[int, int]
) -> None:
    u, v = ((point[axis] - start) / size for axis, start in zip(axes, offset, strict=True))
    scene = board(size, offset, axes)
    even = (floor(u) + floor(v)) % 2 == 0
    assert is_even_square(scene, 0, point) == even
    color = textured(scene, layout.MATERIAL_DIFFUSE, layout.MATERIAL_DIFFUSE_BOARD, 1, point)
    assert color == (EVEN if even else ODD)
    beside = tuple(part + size * (axis == axes[0]) for axis, part in enumerate(point))
    assert is_even_square(scene, 0, beside) != even  # type: ignore[arg-type] # a tuple of three, as point is


@pytest.mark.clause("TEX-1")
def test_a_material_without_a_checkerboard_has_one_colour() -> None:
    scene = board(1.0, (0.0, 0.0), (0, 2))
    assert textured(scene, layout.MATERIAL_DIFFUSE, layout.MATERIAL_DIFFUSE_BOARD, 0, (0.5, 0.5, 0.5)) == PLAIN
