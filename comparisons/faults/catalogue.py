"""All faults by name."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from raytruth.comparisons.faults import (
    absorption,
    attenuation,
    background,
    camera,
    depth,
    exactness,
    fresnel,
    highlights,
    lights,
    mirror,
    normals,
    numerics,
    output,
    pixels,
    plane,
    refraction,
    shading,
    shadows,
    sphere,
    textures,
    traversal,
    triangle,
)
from raytruth.comparisons.faults.fault import subjects_in

if TYPE_CHECKING:
    from raytruth.comparisons.faults.fault import Fault

TOPICS = (
    camera,
    pixels,
    sphere,
    triangle,
    plane,
    normals,
    shading,
    highlights,
    lights,
    attenuation,
    shadows,
    mirror,
    refraction,
    fresnel,
    absorption,
    depth,
    textures,
    background,
    traversal,
    output,
    numerics,
    exactness,
)


@cache
def all_faults() -> dict[str, Fault]:
    """Every fault of the catalogue, by name, in the order of the topics."""
    return subjects_in(TOPICS)
