"""The shortcuts that a renderer may declare: deviations that are not rounding, and that nobody would ask for."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.departures import NONE
from raytruth.comparisons.error_models.error_model import RayOffset
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.scenes.scene import Scene


def without_shortcuts(error_model: ErrorModel) -> ErrorModel:
    """The error model without its shortcuts: rays start on the surface, shadow rays end at the light.

    Formulas stay, and what is flushed to zero: they are arithmetic.
    """
    offsets = {"ray_offset": RayOffset(), "shadow_offset": None, "reflected_offset": None, "refracted_offset": None}
    return replace(error_model, **offsets, shadow_aim="light", shadow_shortening=0.0, shadow_tolerance=0.0)


def without_departures(error_model: ErrorModel) -> ErrorModel:
    """The error model of a renderer that computes what the specification says."""
    return replace(error_model, departures=NONE)


def has_shortcuts(error_model: ErrorModel) -> bool:
    """Whether it declares any: a ray offset, a least distance, shadow rays that end early or overlook what is near.

    A surface that is tested as all others are, when a ray leaves it, is one, too.
    """
    return error_model != without_shortcuts(error_model)


def shortcuts_in_words(error_model: ErrorModel, scene: Scene) -> str:
    """How large the shortcuts are in a scene, beside its smallest shape, and which departures there are; a clause."""
    offsets, scale = error_model.offsets(), _largest_coordinate(scene)
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
    if error_model.departures != NONE:
        told.append(f"its departures from the specification: {error_model.departures.in_words()}")
    return ", ".join(told)


def _longest_offset(offset: RayOffset, scale: float, precision_bits: int) -> float:
    """How far a ray may start beside a surface, at the most, where no coordinate is larger than `scale`."""
    by_units = max(2.0**-16, 2.0**-15 * scale) if offset.in_units else 0.0
    # A normal's coordinates sum up to no more than the root of 3.
    by_bound = 3.0**0.5 * offset.error_bound * 2.0**-precision_bits * scale
    return offset.absolute + offset.relative * scale + by_units + by_bound


def _largest_coordinate(scene: Scene) -> float:
    """The largest absolute coordinate of any point that a ray may leave."""
    reaches = [
        np.abs(shape.center) + shape.radius if isinstance(shape, Sphere) else np.abs(shape.vertices)
        for shape in scene.objects
    ]
    return max(float(np.max(reach)) for reach in reaches)


def _smallest(scene: Scene) -> tuple[float, str]:
    """The smallest radius of a sphere or, where there are none, the shortest edge of a triangle."""
    radii = [shape.radius for shape in scene.objects if isinstance(shape, Sphere)]
    if radii:
        return min(radii), "the radius of the smallest sphere"
    edges = []
    for shape in scene.objects:
        assert not isinstance(shape, Sphere), "there are none"
        vertices = np.array(shape.vertices)
        corners = vertices[np.array(shape.faces)] if shape.shape == "mesh" else vertices[np.newaxis]
        edges.append(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).min())
    return float(min(edges)), "the shortest edge"
