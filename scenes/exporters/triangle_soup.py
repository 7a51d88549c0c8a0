"""A scene of triangles as arrays, in the scene's numbering of primitives."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.scenes.shapes import Mesh, Plane, Sphere, Triangle

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape
    from raytruth.scenes.triangle_lists import TriangleLists


def triangles_of_scene(scene: Scene) -> NDArray[np.float64]:
    """The corners of all triangles, shape (n, 3, 3). Spheres and planes are left out."""
    of_objects = [triangles_of(shape) for shape in scene.objects if not isinstance(shape, Sphere | Plane)]
    return np.concatenate([np.empty((0, 3, 3)), *of_objects])


def material_of_each_triangle(scene: Scene) -> list[str]:
    """The name of each triangle's material, in the order of `triangles_of_scene`."""
    return [
        shape.material
        for shape in scene.objects
        if not isinstance(shape, Sphere | Plane)
        for _ in range(len(triangles_of(shape)))
    ]


def triangles_of(shape: Shape) -> NDArray[np.float64]:
    """The corners of the triangles of a mesh or triangle, in the order of faces; shape (faces, 3, 3)."""
    assert isinstance(shape, Triangle | Mesh), "it has triangles"
    if isinstance(shape, Triangle):
        return np.array([shape.vertices], dtype=np.float64)
    return np.array(shape.vertices, dtype=np.float64)[np.array(shape.faces, dtype=np.int64)]


def triangle_lists(shape: Shape) -> TriangleLists:
    """The vertices and the faces of a mesh; a triangle has its three vertices and one face."""
    assert isinstance(shape, Triangle | Mesh), "it has triangles"
    return (shape.vertices, shape.faces) if isinstance(shape, Mesh) else (shape.vertices, ((0, 1, 2),))
