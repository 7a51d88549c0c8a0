"""Faults of the background (docs/spec.md, BG)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.background import background_radiance
from raytruth.reference_tracer.source.features import ABSORPTION, BACKGROUND, BACKGROUND_GRADIENT
from raytruth.reference_tracer.source.ray_tree import trace_ray
from raytruth.reference_tracer.source.refraction import medium_transmittance
from raytruth.reference_tracer.source.scene_data import BACKGROUND_COLOR, MATERIAL_ABSORPTION, vector_of
from raytruth.reference_tracer.source.traversal import NOTHING, nearest_hit
from raytruth.reference_tracer.source.vector import add, multiply, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("BG-1", "background_radiance", "Which colour has the sky overhead?")
def gradient_upside_down(scene: SceneData, direction: Vector) -> Vector:
    """Top and bottom of the sky's gradient are exchanged."""
    if BACKGROUND_GRADIENT:
        height = 0.5 * (direction[1] + 1.0)
        return add(
            scale(vector_of(scene, BACKGROUND_COLOR, 0), height),
            scale(vector_of(scene, BACKGROUND_COLOR, 1), 1.0 - height),
        )
    if BACKGROUND:
        return vector_of(scene, BACKGROUND_COLOR, 0)
    return (0.0, 0.0, 0.0)


@fault("BG-1", "background_radiance", "Where does the gradient begin: at the horizon or straight below?")
def gradient_from_the_horizon(scene: SceneData, direction: Vector) -> Vector:
    """The gradient begins at the horizon instead of straight below."""
    if BACKGROUND_GRADIENT:
        height = max(direction[1], 0.0)
        return add(
            scale(vector_of(scene, BACKGROUND_COLOR, 0), 1.0 - height),
            scale(vector_of(scene, BACKGROUND_COLOR, 1), height),
        )
    if BACKGROUND:
        return vector_of(scene, BACKGROUND_COLOR, 0)
    return (0.0, 0.0, 0.0)


@fault("BG-1", "background_radiance", "What does a ray bring that meets nothing?")
def background_always_black(scene: SceneData, direction: Vector) -> Vector:
    """Rays that meet nothing are black, whatever background the scene states."""
    return (0.0, 0.0, 0.0)


@fault("BG-1", "background_radiance", "Is your mixture of two colours really linear?")
def gradient_squared(scene: SceneData, direction: Vector) -> Vector:
    """The gradient follows the square of the height, because it looks better."""
    if BACKGROUND_GRADIENT:
        height = 0.25 * (direction[1] + 1.0) * (direction[1] + 1.0)
        return add(
            scale(vector_of(scene, BACKGROUND_COLOR, 0), 1.0 - height),
            scale(vector_of(scene, BACKGROUND_COLOR, 1), height),
        )
    if BACKGROUND:
        return vector_of(scene, BACKGROUND_COLOR, 0)
    return (0.0, 0.0, 0.0)


@fault("BG-2", "radiance", "What does a mirror show that faces the sky?")
def background_for_camera_rays_only(
    scene: SceneData, origin: Vector, direction: Vector, medium: int, depth: int
) -> Vector:
    """Reflected and refracted rays that meet nothing are black, only camera rays see the background."""
    total = (0.0, 0.0, 0.0)
    waiting = [(origin, direction, (1.0, 1.0, 1.0), NOTHING, medium, depth)]
    while len(waiting) > 0:
        ray = waiting.pop()
        _, hit = nearest_hit(scene, ray[0], ray[1], ray[3])
        if hit != NOTHING or ray[3] == NOTHING:
            total = add(total, trace_ray(scene, ray, waiting))
    return total


@fault("BG-3", "radiance", "How long is the way to nothing?")
def background_absorbed(scene: SceneData, origin: Vector, direction: Vector, medium: int, depth: int) -> Vector:
    """A ray in a medium that meets nothing is weighted as if it had gone one unit through it."""
    total = (0.0, 0.0, 0.0)
    waiting = [(origin, direction, (1.0, 1.0, 1.0), NOTHING, medium, depth)]
    while len(waiting) > 0:
        ray = waiting.pop()
        _, hit = nearest_hit(scene, ray[0], ray[1], ray[3])
        if hit != NOTHING:
            total = add(total, trace_ray(scene, ray, waiting))
        else:
            weight = ray[2]
            if ABSORPTION:
                if ray[4] >= 0:
                    absorption = vector_of(scene, MATERIAL_ABSORPTION, ray[4])
                    weight = multiply(weight, medium_transmittance(absorption, 1.0))
            total = add(total, multiply(weight, background_radiance(scene, ray[1])))
    return total
