"""What a scene may require of a renderer, and the sentence about a renderer that does not have all of it."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Set as AbstractSet


class Feature(StrEnum):
    """What a renderer must have to render a scene."""

    PERSPECTIVE = "PERSPECTIVE"
    SPHERES = "SPHERES"
    TRIANGLES = "TRIANGLES"
    BOUNDING_VOLUMES = "BOUNDING_VOLUMES"
    PLANES = "PLANES"
    BACKGROUND = "BACKGROUND"
    BACKGROUND_GRADIENT = "BACKGROUND_GRADIENT"
    CHECKERBOARD = "CHECKERBOARD"
    EMISSION = "EMISSION"
    AMBIENT = "AMBIENT"
    DIFFUSE = "DIFFUSE"
    PHONG = "PHONG"
    BLINN = "BLINN"
    POINT_LIGHTS = "POINT_LIGHTS"
    DIRECTIONAL_LIGHTS = "DIRECTIONAL_LIGHTS"
    INVERSE_SQUARE_FALLOFF = "INVERSE_SQUARE_FALLOFF"
    POLYNOMIAL_FALLOFF = "POLYNOMIAL_FALLOFF"
    MIRRORS = "MIRRORS"
    DIELECTRICS = "DIELECTRICS"
    CONSTANT_SPLIT = "CONSTANT_SPLIT"
    ABSORPTION = "ABSORPTION"
    RADIOMETRIC = "RADIOMETRIC"


# Sets that several renderers express as a whole. A new feature belongs into one of them only if all of these have it.
TRIANGLE_GEOMETRY = frozenset({Feature.PERSPECTIVE, Feature.TRIANGLES, Feature.BOUNDING_VOLUMES})
GEOMETRY = TRIANGLE_GEOMETRY | {Feature.SPHERES}
RADIOMETRIC_LIGHTS = frozenset(
    {Feature.POINT_LIGHTS, Feature.DIRECTIONAL_LIGHTS, Feature.INVERSE_SQUARE_FALLOFF, Feature.RADIOMETRIC}
)
LIGHTS = RADIOMETRIC_LIGHTS | {Feature.POLYNOMIAL_FALLOFF}
BACKGROUNDS = frozenset({Feature.BACKGROUND, Feature.BACKGROUND_GRADIENT})
FURTHER_RAYS = frozenset({Feature.MIRRORS, Feature.DIELECTRICS, Feature.CONSTANT_SPLIT, Feature.ABSORPTION})
LOCAL_TERMS = frozenset(
    {Feature.EMISSION, Feature.AMBIENT, Feature.DIFFUSE, Feature.PHONG, Feature.BLINN, Feature.CHECKERBOARD}
)


def missing_features(program: str, expresses: AbstractSet[Feature], required: AbstractSet[Feature]) -> str | None:
    """Why a program cannot express what is required, in one clause that follows 'because'; None if it can.

    A renderer asks this after it has looked for what it knows not to have, for which it has clauses of its own. So
    this one is about what the renderer has never heard of: a new feature is refused until somebody looks at it.
    """
    missing = sorted(feature.lower().replace("_", " ") for feature in required - expresses)
    return f"{program} is not known to have what the scene requires: {', '.join(missing)}" if missing else None
