"""Faults of textures (docs/spec.md, TEX)."""

from __future__ import annotations

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit


@fault(
    "TEX-1",
    "is_even_square",
    "Which colour has the square at the board's own origin?",
    Edit("(column + row) % 2 == 0", "(column + row) % 2 != 0"),
)
def even_and_odd_exchanged() -> None:
    """The two colours of the checkerboard are exchanged."""


@fault(
    "TEX-1",
    "is_even_square",
    "What does your language do to a negative number when it makes it an integer?",
    Edit("floor", "int", times=2),
)
def truncated_toward_zero() -> None:
    """Coordinates are truncated toward zero, so the squares beside the origin are twice as wide."""


@fault(
    "TEX-1",
    "is_even_square",
    "Where does the board begin?",
    Edit("number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)", "0.0"),
    Edit("number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)", "0.0"),
)
def offset_forgotten() -> None:
    """The offset of the checkerboard is ignored."""


@fault(
    "TEX-1",
    "is_even_square",
    "Is the size that of a square, or how many there are in a unit?",
    Edit(
        "(u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size",
        "(u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) * size",
    ),
    Edit(
        "(v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size",
        "(v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) * size",
    ),
)
def size_taken_for_a_frequency() -> None:
    """Coordinates are multiplied by the size of the squares instead of divided by it."""


@fault(
    "TEX-1",
    "is_even_square",
    "In which plane does the board lie?",
    Edit("integer_of(scene, CHECKERBOARD_FIRST_AXIS, board)", "0"),
    Edit("integer_of(scene, CHECKERBOARD_SECOND_AXIS, board)", "1"),
)
def board_in_the_wrong_plane() -> None:
    """The first two coordinates are used, whatever the plane of the board."""


@fault(
    "TEX-2",
    "is_even_square",
    "To which square does a point very near to a border belong?",
    Edit(
        "(u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size",
        "(u - number_of(scene, CHECKERBOARD_FIRST_OFFSET, board)) / size + 0.02",
    ),
    Edit(
        "(v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size",
        "(v - number_of(scene, CHECKERBOARD_SECOND_OFFSET, board)) / size + 0.02",
    ),
)
def epsilon_at_the_borders() -> None:
    """Two percent of a square are added to the coordinates against noise on the borders, which moves all of them."""
