"""What bounds the start of rays whose renderer derives their offset from the numbers of each point."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb

from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.scene import Scene

# Wächter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems 2019, chapter 6,
# listing 1: float_scale = 1/65536 for coordinates under 1/32, else int_scale = 256 units in the last place times the
# normal's coordinate, cut to a whole number. A unit of float32 is between 2^-24 and 2^-23 of a number.
ULP_STEPS: dict[str, Any] = {
    "units_small": arb(2.0**-16),
    "units_large": arb(2.0**-16).union(arb(2.0**-15)),
    "unit_lost": arb(0, 2.0**-23),
}


def largest_terms(scene: Scene) -> list[float]:
    """For each primitive (docs/spec.md, TRAV-2) the largest that Σ |nᵢ|·Eᵢ may be.

    n is the unit normal at a point and Eᵢ the largest absolute coordinate of the primitive along axis i: a point's
    coordinate is computed from numbers of that size, and its rounding shows along the normal.
    """
    spheres = [shape for shape in scene.objects if isinstance(shape, Sphere)]
    of_spheres = [float(np.linalg.norm(np.abs(shape.center) + shape.radius)) for shape in spheres]
    return [*of_spheres, *(_of_triangle(corners) for corners in _triangles(scene))]


def scale_of(scene: Scene, precision_bits: int) -> Any:
    """The largest absolute coordinate of any point of a scene's shapes, as a program may have it: rounded twice."""
    reaches = [
        np.abs(shape.center) + shape.radius if isinstance(shape, Sphere) else np.abs(shape.vertices)
        for shape in scene.objects
    ]
    # Once in |c| + r, and once in its product with what is declared.
    return arb(max(float(np.max(reach)) for reach in reaches)) * arb(1, 2 * 2.0**-precision_bits)


def _triangles(scene: Scene) -> Iterator[Any]:
    for shape in scene.objects:
        if isinstance(shape, Sphere):
            continue
        vertices = np.array(shape.vertices)
        yield from vertices[np.array(shape.faces)] if shape.shape == "mesh" else vertices[np.newaxis]


def _of_triangle(corners: Any) -> float:
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    return float(np.abs(normal) @ np.abs(corners).max(axis=0) / np.linalg.norm(normal))
