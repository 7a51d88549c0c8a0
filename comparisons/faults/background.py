"""Faults of the background (docs/spec.md, BG)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault(
    "BG-1",
    "background_radiance",
    "Which colour has the sky overhead?",
    Edit(
        "scale(vector_of(scene, BACKGROUND_COLOR, 1), height)",
        "scale(vector_of(scene, BACKGROUND_COLOR, 1), 1.0 - height)",
    ),
    Edit(
        "scale(vector_of(scene, BACKGROUND_COLOR, 0), 1.0 - height)",
        "scale(vector_of(scene, BACKGROUND_COLOR, 0), height)",
    ),
)
def gradient_upside_down() -> None:
    """Top and bottom of the sky's gradient are exchanged."""


@fault(
    "BG-1",
    "background_radiance",
    "Where does the gradient begin: at the horizon or straight below?",
    Edit("0.5 * (direction[1] + 1.0)", "max(direction[1], 0.0)"),
)
def gradient_from_the_horizon() -> None:
    """The gradient begins at the horizon instead of straight below."""


@fault("BG-1", "background_radiance", "What does a ray bring that meets nothing?")
def background_always_black(scene: SceneData, direction: Vector) -> Vector:
    """Rays that meet nothing are black, whatever background the scene states."""
    return (0.0, 0.0, 0.0)


@fault(
    "BG-1",
    "background_radiance",
    "Which colour has the sky halfway between bottom and top?",
    Edit("0.5 * (direction[1] + 1.0)", "0.25 * (direction[1] + 1.0) * (direction[1] + 1.0)"),
)
def gradient_squared() -> None:
    """The gradient follows the square of the height, because it looks better."""


@fault(
    "BG-2",
    "radiance",
    "What does a mirror show that faces the sky?",
    Edit(
        "total = add(total, trace_ray(scene, waiting.pop(), waiting))",
        """
        ray = waiting.pop()
        _, hit = nearest_hit(scene, ray[0], ray[1], ray[3])
        if hit != NOTHING or ray[3] == NOTHING:
            total = add(total, trace_ray(scene, ray, waiting))
        """,
    ),
)
def background_for_camera_rays_only() -> None:
    """Reflected and refracted rays that meet nothing are black, only camera rays see the background."""


@fault(
    "BG-3",
    "radiance",
    "How long is the way to nothing?",
    Edit(
        "total = add(total, trace_ray(scene, waiting.pop(), waiting))",
        """
        ray = waiting.pop()
        if ABSORPTION:
            _, hit = nearest_hit(scene, ray[0], ray[1], ray[3])
            if hit == NOTHING and ray[4] >= 0:
                transmittance = medium_transmittance(vector_of(scene, MATERIAL_ABSORPTION, ray[4]), 1.0)
                ray = (ray[0], ray[1], multiply(ray[2], transmittance), ray[3], ray[4], ray[5])
        total = add(total, trace_ray(scene, ray, waiting))
        """,
    ),
)
def background_absorbed() -> None:
    """A ray in a medium that meets nothing is weighted as if it had gone one unit through it."""
