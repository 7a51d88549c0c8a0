"""In which order the tracer's tables hold a scene's primitives and lights (tables.py fills them so)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.lights import PointLight
from raytruth.scenes.shapes import Mesh, Plane, Sphere

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene


def objects_of_primitives(scene: Scene) -> list[int]:
    """For each primitive which of the scene's objects it belongs to: spheres first, then triangles, then planes."""
    spheres = [index for index, shape in enumerate(scene.objects) if isinstance(shape, Sphere)]
    triangles = [
        index
        for index, shape in enumerate(scene.objects)
        if not isinstance(shape, Sphere | Plane)
        for _ in range(len(shape.faces) if isinstance(shape, Mesh) else 1)
    ]
    planes = [index for index, shape in enumerate(scene.objects) if isinstance(shape, Plane)]
    return spheres + triangles + planes


def lights_as_traced(scene: Scene) -> list[int]:
    """Which of the scene's lights the tracer adds first, second, …: point lights come first, then directional ones."""
    return sorted(range(len(scene.lights)), key=lambda number: not isinstance(scene.lights[number], PointLight))
