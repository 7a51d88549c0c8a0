"""Colours that vary over a surface (docs/spec.md, TEX)."""

from __future__ import annotations

from math import floor
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.features import CHECKERBOARD
from raytruth.reference_tracer.source.scene_data import (
    CHECKERBOARD_EVEN,
    CHECKERBOARD_FIRST_AXIS,
    CHECKERBOARD_FIRST_OFFSET,
    CHECKERBOARD_ODD,
    CHECKERBOARD_SECOND_AXIS,
    CHECKERBOARD_SECOND_OFFSET,
    CHECKERBOARD_SIZE,
    integer_of,
    number_of,
    vector_of,
)

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

NO_CHECKERBOARD = -1


def is_even_square(scene: SceneData, board: int, point: Vector) -> bool:
    """Whether the point's square is even: floor((u-u0)/size) + floor((v-v0)/size) over the board's two axes."""
    size = number_of(scene, CHECKERBOARD_SIZE, board)
    u = point[integer_of(scene, CHECKERBOARD_FIRST_AXIS, board)]
    v = point[integer_of(scene, CHECKERBOARD_SECOND_AXIS, board)]
    column = floor((u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size)
    row = floor((v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size)
    return (column + row) % 2 == 0


def textured(scene: SceneData, constants: int, boards: int, material: int, point: Vector) -> Vector:
    """The colour of a material's term at a point: its checkerboard's if it has one, else the constant.

    `constants` and `boards` are the term's tables.
    """
    if CHECKERBOARD:
        board = integer_of(scene, boards, material)
        if board != NO_CHECKERBOARD:
            if is_even_square(scene, board, point):
                return vector_of(scene, CHECKERBOARD_EVEN, board)
            return vector_of(scene, CHECKERBOARD_ODD, board)
    return vector_of(scene, constants, material)
