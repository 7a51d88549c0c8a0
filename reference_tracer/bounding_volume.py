"""Does a ray miss an axis-aligned box for certain? (docs/spec.md, TRAV)"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reference_tracer.numbers import Scalar, Vector


def certainly_less(a: Scalar, b: Scalar) -> bool:
    """Whether a < b beyond doubt. In ball arithmetic the answer is False where the balls overlap."""
    return a < b


def certainly_zero(a: Scalar) -> bool:
    """Whether a is exactly zero."""
    return a == 0.0


def rounding_allowance() -> Scalar:
    """At least 1 + 2·γ(3): what three roundings may take from the far end of a slab.

    Ize, "Robust BVH Ray Traversal", 2013, section 4.2; γ(3) = 3u/(1-3u). Written for float32, the coarsest number type
    (u = 2^-24, 2·γ(3) = 3.6e-7), and so that it is above 1 there; a wider box never loses a hit.
    """
    return 1.0000004


def box_is_missed(origin: Vector, direction: Vector, low: Vector, high: Vector, end: Scalar) -> bool:
    """Whether the ray certainly does not touch the box for 0 <= t <= end (slabs: Kay, Kajiya 1986)."""
    entry = 0.0
    leave = end
    for axis in range(3):
        if certainly_less(0.0, direction[axis]):
            entry, leave = clip(entry, leave, origin[axis], direction[axis], low[axis], high[axis])
        elif certainly_less(direction[axis], 0.0):
            entry, leave = clip(entry, leave, origin[axis], direction[axis], high[axis], low[axis])
        elif certainly_zero(direction[axis]):
            if certainly_less(origin[axis], low[axis]) or certainly_less(high[axis], origin[axis]):
                return True
    return certainly_less(leave * rounding_allowance(), entry)


def clip(
    entry: Scalar, leave: Scalar, origin: Scalar, direction: Scalar, near: Scalar, far: Scalar
) -> tuple[Scalar, Scalar]:
    """The part of [entry, leave] that lies between the planes `near` and `far` of one axis."""
    return max(entry, (near - origin) / direction), min(leave, (far - origin) / direction)
