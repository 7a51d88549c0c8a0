"""The shortcuts that a renderer may declare: deviations that are not rounding, and that nobody would ask for."""

from __future__ import annotations

from dataclasses import replace
from math import inf, isfinite, sqrt
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.departures import NONE
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.scenes.extent import largest_coordinate
from raytruth.scenes.planes import has_planes
from raytruth.scenes.shapes import Plane, Sphere

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.scenes.scene import Scene


def without_shortcuts(error_model: ErrorModel) -> ErrorModel:
    """The error model without its shortcuts: rays start on the surface and go any way, shadow rays end at the light.

    Formulas stay, and what is flushed to zero: they are arithmetic.
    """
    return replace(
        error_model,
        ray_offset=RayOffset(),
        shadow_offset=None,
        reflected_offset=None,
        refracted_offset=None,
        least_determinant=0.0,
        shadow_aim="light",
        shadow_shortening=0.0,
        shadow_tolerance=0.0,
        farthest=inf,
    )


def without_departures(error_model: ErrorModel) -> ErrorModel:
    """The error model of a renderer that computes what the specification says."""
    return replace(error_model, departures=NONE)


def has_shortcuts(error_model: ErrorModel) -> bool:
    """Whether it declares any: a ray offset, a least distance, shadow rays that end early or overlook what is near, a
    farthest distance, a least determinant.

    A surface that is tested as all others are, when a ray leaves it, is one, too.
    """
    return error_model != without_shortcuts(error_model)


def shortcuts_in_words(error_model: ErrorModel, scene: Scene) -> str:
    """How large the shortcuts are in a scene, beside its smallest shape, and which departures there are; a clause."""
    offsets, scale = error_model.offsets(), largest_coordinate(scene)
    lengths = {
        "ray offset": max(_longest_offset(offset, scale, error_model.precision_bits) for offset in offsets),
        "least distance": max(o.minimum_distance + o.relative_minimum_distance * scale for o in offsets),
        "shadow tolerance": error_model.shadow_tolerance,
    }
    size, what = _smallest(scene)
    told = [
        f"its {name} is up to {length:.2g}, {length / size:.2g} times {what}"
        for name, length in lengths.items()
        if length > 0.0
    ]
    if error_model.shadow_shortening > 0.0:
        told.append(f"its shadow rays end {error_model.shadow_shortening:.2g} of the distance before the light")
    if error_model.least_determinant > 0.0:
        told.append(f"it misses triangles with a determinant under {error_model.least_determinant:.2g}")
    if isfinite(error_model.farthest) and has_planes(scene):
        told.append(f"it may miss what is farther than {error_model.farthest:.2g}, and planes are infinite")
    if error_model.departures != NONE:
        told.append(f"its departures from the specification: {error_model.departures.in_words()}")
    return ", ".join(told)


def _longest_offset(offset: RayOffset, scale: float, precision_bits: int) -> float:
    """How far a ray may start beside a surface, at the most, where no coordinate is larger than `scale`."""
    by_units = max(2.0**-16, 2.0**-15 * scale) if offset.in_units else 0.0
    # A normal's coordinates sum up to no more than the root of 3.
    by_bound = sqrt(3.0) * offset.error_bound * 2.0**-precision_bits * scale
    return offset.absolute + offset.relative * scale + by_units + by_bound


def _smallest(scene: Scene) -> tuple[float, str]:
    """The smallest radius of a sphere or, where there are none, the shortest edge of a triangle; else a unit."""
    radii = [shape.radius for shape in scene.objects if isinstance(shape, Sphere)]
    if radii:
        return min(radii), "the radius of the smallest sphere"
    edges = []
    for shape in scene.objects:
        if isinstance(shape, Sphere | Plane):
            continue
        vertices = np.array(shape.vertices)
        corners = vertices[np.array(shape.faces)] if shape.shape == "mesh" else vertices[np.newaxis]
        edges.append(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).min())
    return (float(min(edges)), "the shortest edge") if edges else (1.0, "a unit of length")
