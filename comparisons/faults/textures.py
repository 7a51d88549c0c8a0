"""Faults of textures (docs/spec.md, TEX)."""

from __future__ import annotations

from math import floor
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.scene_data import (
    CHECKERBOARD_FIRST_AXIS,
    CHECKERBOARD_FIRST_OFFSET,
    CHECKERBOARD_SECOND_AXIS,
    CHECKERBOARD_SECOND_OFFSET,
    CHECKERBOARD_SIZE,
    integer_of,
    number_of,
)

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("TEX-1", "is_even_square", "Which colour has the square at the board's own origin?")
def even_and_odd_exchanged(scene: SceneData, board: int, point: Vector) -> bool:
    """The two colours of the checkerboard are exchanged."""
    size = number_of(scene, CHECKERBOARD_SIZE, board)
    u = point[integer_of(scene, CHECKERBOARD_FIRST_AXIS, board)]
    v = point[integer_of(scene, CHECKERBOARD_SECOND_AXIS, board)]
    column = floor((u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size)
    line = floor((v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size)
    return (column + line) % 2 != 0


@fault("TEX-1", "is_even_square", "What does your language do to a negative number when it makes it an integer?")
def truncated_toward_zero(scene: SceneData, board: int, point: Vector) -> bool:
    """Coordinates are truncated toward zero, so the squares beside the origin are twice as wide."""
    size = number_of(scene, CHECKERBOARD_SIZE, board)
    u = point[integer_of(scene, CHECKERBOARD_FIRST_AXIS, board)]
    v = point[integer_of(scene, CHECKERBOARD_SECOND_AXIS, board)]
    column = int((u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size)
    line = int((v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size)
    return (column + line) % 2 == 0


@fault("TEX-1", "is_even_square", "Where does the board begin?")
def offset_forgotten(scene: SceneData, board: int, point: Vector) -> bool:
    """The offset of the checkerboard is ignored."""
    size = number_of(scene, CHECKERBOARD_SIZE, board)
    u = point[integer_of(scene, CHECKERBOARD_FIRST_AXIS, board)]
    v = point[integer_of(scene, CHECKERBOARD_SECOND_AXIS, board)]
    return (floor(u / size) + floor(v / size)) % 2 == 0


@fault("TEX-1", "is_even_square", "Is the size that of a square, or how many there are in a unit?")
def size_taken_for_a_frequency(scene: SceneData, board: int, point: Vector) -> bool:
    """Coordinates are multiplied by the size of the squares instead of divided by it."""
    size = number_of(scene, CHECKERBOARD_SIZE, board)
    u = point[integer_of(scene, CHECKERBOARD_FIRST_AXIS, board)]
    v = point[integer_of(scene, CHECKERBOARD_SECOND_AXIS, board)]
    column = floor((u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) * size)
    line = floor((v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) * size)
    return (column + line) % 2 == 0


@fault("TEX-1", "is_even_square", "In which plane does the board lie?")
def board_in_the_wrong_plane(scene: SceneData, board: int, point: Vector) -> bool:
    """The first two coordinates are used, whatever the plane of the board."""
    size = number_of(scene, CHECKERBOARD_SIZE, board)
    column = floor((point[0] - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size)
    line = floor((point[1] - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size)
    return (column + line) % 2 == 0


@fault("TEX-2", "is_even_square", "To which square does a point very near to a border belong?")
def epsilon_at_the_borders(scene: SceneData, board: int, point: Vector) -> bool:
    """Two percent of a square are added to the coordinates against noise on the borders, which moves all of them."""
    size = number_of(scene, CHECKERBOARD_SIZE, board)
    u = point[integer_of(scene, CHECKERBOARD_FIRST_AXIS, board)]
    v = point[integer_of(scene, CHECKERBOARD_SECOND_AXIS, board)]
    column = floor((u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size + 0.02)
    line = floor((v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size + 0.02)
    return (column + line) % 2 == 0
