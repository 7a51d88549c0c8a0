"""Mirror reflection (docs/spec.md, REFL)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.vector import along, dot

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector


def mirror_direction(direction: Vector, normal: Vector) -> Vector:
    """The mirrored direction d - 2(d·n)n for a unit normal n; the length of d is kept (Whitted 1980, section 2)."""
    return along(direction, normal, -2.0 * dot(direction, normal))
