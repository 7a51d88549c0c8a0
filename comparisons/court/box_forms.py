"""Tests of a ray against a box with sides along the axes, as they are in use; 0·∞, -0 and flat boxes part them.

Each gives whether the ray may meet the box, at its start or later, in the number type of its arguments.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

Number = np.float32 | np.float64
Triple = tuple[Number, Number, Number]


def plain_slabs(origin: Triple, direction: Triple, low: Triple, high: Triple) -> bool:
    """Kay, Kajiya, "Ray Tracing Complex Scenes", 1986, with a reciprocal, and the planes put in order by comparisons.

    Of a ray in the plane of a face, 0·∞ is NaN. What that spoils depends on how a minimum takes NaN: here as
    `x < y ? x : y` in C does, which gives the second of both.
    """
    number = type(origin[0])
    nearest, farthest = number(0.0), number(np.inf)
    for o, d, least, greatest in zip(origin, direction, low, high, strict=True):
        reciprocal = number(1.0) / d
        first, second = (least - o) * reciprocal, (greatest - o) * reciprocal
        enters = first if first < second else second
        leaves = first if first > second else second
        nearest = nearest if nearest > enters else enters
        farthest = farthest if farthest < leaves else leaves
    return bool(nearest <= farthest)


def signed_slabs(origin: Triple, direction: Triple, low: Triple, high: Triple) -> bool:
    """Williams, Barrus, Morley, Shirley, "An Efficient and Robust Ray-Box Intersection Algorithm", 2005.

    The reciprocal's sign says which plane is nearer, and so tells -0 from 0.
    """
    nearest, farthest = _stretch(origin, direction, low, high, lambda _, reciprocal: bool(reciprocal < 0))
    return bool(nearest <= farthest)


def direction_signed_slabs(origin: Triple, direction: Triple, low: Triple, high: Triple) -> bool:
    """The same, but with the planes told apart by d < 0, which is false of -0, whose reciprocal is -∞ all the same."""
    nearest, farthest = _stretch(origin, direction, low, high, lambda d, _: bool(d < 0))
    return bool(nearest <= farthest)


def strict_slabs(origin: Triple, direction: Triple, low: Triple, high: Triple) -> bool:
    """As `signed_slabs`, but the ray must be longer than 0 inside, which none is in a flat box that it crosses."""
    nearest, farthest = _stretch(origin, direction, low, high, lambda _, reciprocal: bool(reciprocal < 0))
    return bool(nearest < farthest)


def padded_slabs(origin: Triple, direction: Triple, low: Triple, high: Triple) -> bool:
    """Ize, "Robust BVH Ray Traversal", 2013: the far distance times 1 + 4u, u the unit roundoff (section 4).

    That covers what a subtraction, a reciprocal and a product round on both sides: more boxes are entered, none lost.
    """
    number = type(origin[0])
    # eps is the distance from 1 to the next number, 2u.
    padding = number(1.0) + number(2.0) * np.finfo(number).eps
    nearest, farthest = _stretch(origin, direction, low, high, lambda _, reciprocal: bool(reciprocal < 0))
    return bool(nearest <= farthest * padding)


def _stretch(
    origin: Triple, direction: Triple, low: Triple, high: Triple, is_backward: Callable[[Number, Number], bool]
) -> tuple[Number, Number]:
    """From which t to which the ray is in all three slabs, from 0 on. A slab that gives NaN alters nothing."""
    number = type(origin[0])
    nearest, farthest = number(0.0), number(np.inf)
    for o, d, least, greatest in zip(origin, direction, low, high, strict=True):
        reciprocal = number(1.0) / d
        near, far = (greatest, least) if is_backward(d, reciprocal) else (least, greatest)
        enters, leaves = (near - o) * reciprocal, (far - o) * reciprocal
        nearest = enters if enters > nearest else nearest
        farthest = leaves if leaves < farthest else farthest
    return nearest, farthest


BOX_FORMS: dict[str, Callable[[Triple, Triple, Triple, Triple], bool]] = {
    "box: plain": plain_slabs,
    "box: signed": signed_slabs,
    "box: d < 0": direction_signed_slabs,
    "box: strict": strict_slabs,
    "box: padded": padded_slabs,
}
