"""What a ray sees that meets nothing (docs/spec.md, BG)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.features import BACKGROUND, BACKGROUND_GRADIENT
from raytruth.reference_tracer.source.scene_data import BACKGROUND_COLOR, SceneData, vector_of
from raytruth.reference_tracer.source.vector import add, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector


def background_radiance(scene: SceneData, direction: Vector) -> Vector:
    """The radiance of the background: constant, or linear in the y of the unit direction; black unless it is stated."""
    if BACKGROUND_GRADIENT:
        height = 0.5 * (direction[1] + 1.0)
        return add(
            scale(vector_of(scene, BACKGROUND_COLOR, 0), 1.0 - height),
            scale(vector_of(scene, BACKGROUND_COLOR, 1), height),
        )
    if BACKGROUND:
        return vector_of(scene, BACKGROUND_COLOR, 0)
    return (0.0, 0.0, 0.0)
