"""How far the points of a scene lie apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.scenes.shapes import Plane, Sphere

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene


def spans_of(scene: Scene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Balls that hold all objects: centres of spheres with their radii, and corners; shapes (n, 3) and (n,).

    Of an infinite plane there is its point alone: who asks has to know how far a ray may go to meet one.
    """
    balls: list[tuple[tuple[float, float, float], float]] = []
    for shape in scene.objects:
        if isinstance(shape, Sphere):
            balls.append((shape.center, shape.radius))
        elif isinstance(shape, Plane):
            balls.append((shape.point, 0.0))
        else:
            balls.extend((vertex, 0.0) for vertex in shape.vertices)
    return np.array([center for center, _ in balls]), np.array([radius for _, radius in balls])


def largest_coordinate(scene: Scene) -> float:
    """The largest absolute coordinate of any point that a ray may leave; of infinite planes, of their stated point."""
    centers, radii = spans_of(scene)
    return float((np.abs(centers) + radii[:, None]).max())


def extent_of(scene: Scene) -> float:
    """A bound on how far a ray goes between any two points of the scene, lights and camera included.

    Of an infinite plane its point alone counts (`spans_of`).
    """
    centers, radii = spans_of(scene)
    others = [scene.camera.position, *(light.position for light in scene.lights if light.kind == "point")]
    low = np.vstack([centers - radii[:, None], others]).min(axis=0)
    high = np.vstack([centers + radii[:, None], others]).max(axis=0)
    # A parallel light stands beyond all objects; an orthographic camera's rays start beside its position.
    return 4 * float(np.linalg.norm(high - low))
