"""Does a ray miss an axis-aligned box for certain? (docs/spec.md, TRAV)"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.vector import subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def certainly_less(a: Scalar, b: Scalar) -> bool:
    """Whether a < b beyond doubt. In ball arithmetic the answer is False where the balls overlap."""
    return a < b


def certainly_zero(a: Scalar) -> bool:
    """Whether a is exactly zero."""
    return a == 0.0


def rounding_allowance() -> Scalar:
    """At least γ(10) = 10u/(1-10u): what rounding may move a corner and a face of a box, as a part of their distance.

    A ray that triangle_distance takes as a hit may pass beside the triangle, and then beside its box. It meets a
    triangle with moved corners: across the ray, along x, by γ(2)·|x| + γ(4)·|s·z| for a corner at (x, y, z) from the
    origin and a shear |s| <= 1, which is γ(6) of the corner's distance at most. A face's own distance loses γ(3) more,
    and this product one rounding. Else a hit at a shared edge would be lost whose other triangle, by the same rounding,
    is missed. Written for float32, the coarsest number type (u = 2^-24, γ(10) = 5.97e-7).
    """
    return 6e-7


def box_is_missed(origin: Vector, direction: Vector, low: Vector, high: Vector, end: Scalar) -> bool:
    """Whether the ray certainly does not touch the box for 0 <= t <= end (slabs: Kay, Kajiya 1986).

    Nor any triangle in it, as rounding sees them: the box is larger by the rounding_allowance. Along an axis that the
    ray is at a right angle to, nothing that is compared is rounded but differences, whose signs are right.
    """
    to_low = subtract(low, origin)
    to_high = subtract(high, origin)
    margin = rounding_allowance() * farthest(to_low, to_high)
    entry = 0.0
    leave = end
    for axis in range(3):
        if certainly_less(0.0, direction[axis]):
            entry, leave = clip(entry, leave, direction[axis], to_low[axis] - margin, to_high[axis] + margin)
        elif certainly_less(direction[axis], 0.0):
            entry, leave = clip(entry, leave, direction[axis], to_high[axis] + margin, to_low[axis] - margin)
        elif certainly_zero(direction[axis]):
            if certainly_less(0.0, to_low[axis]) or certainly_less(to_high[axis], 0.0):
                return True
    return certainly_less(leave, entry)


def farthest(to_low: Vector, to_high: Vector) -> Scalar:
    """The largest coordinate, without its sign, of all points between two corners."""
    farthest_yet = max(-to_low[0], to_high[0])
    for axis in range(1, 3):
        at_most = max(-to_low[axis], to_high[axis])
        farthest_yet = max(farthest_yet, at_most)
    return farthest_yet


def clip(entry: Scalar, leave: Scalar, direction: Scalar, to_near: Scalar, to_far: Scalar) -> tuple[Scalar, Scalar]:
    """The part of [entry, leave] that lies between two planes across one axis, given by how far away they are."""
    return max(entry, to_near / direction), min(leave, to_far / direction)
