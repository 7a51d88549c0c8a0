"""Scenes of one sphere with known images, and the rays of their cameras, for tests of renderers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.records.renderings import Rays
from raytruth.scenes.scene import Scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

WIDTH, HEIGHT = 28, 20
VIEW_HEIGHT, FIELD_OF_VIEW = 3.1, 37.0
# Not tidy, and the image's up is not the world's, so that nothing is symmetric.
POSITION, LOOK_AT, UP = np.array([1.3, 2.1, 4.7]), np.array([0.2, -0.1, 0.3]), np.array([0.1, 1.0, 0.2])


def build(projection: str = "perspective", **changes: Any) -> Scene:
    camera: dict[str, Any] = {"projection": projection, "position": tuple(POSITION), "look_at": tuple(LOOK_AT)}
    camera |= {"up": tuple(UP), "width": WIDTH, "height": HEIGHT}
    camera |= {"vertical_field_of_view": FIELD_OF_VIEW} if projection == "perspective" else {"view_height": VIEW_HEIGHT}
    base: dict[str, Any] = {
        "purpose": "A test.",
        "convention": "radiometric",
        "camera": camera,
        "materials": {"red": {"diffuse": {"reflectance": (0.8, 0.3, 0.1)}}},
        "objects": [{"shape": "sphere", "center": tuple(LOOK_AT), "radius": 1.2, "material": "red"}],
    }
    return Scene.model_validate(base | changes)


def unit(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    normalised: NDArray[np.float64] = vector / np.linalg.norm(vector, axis=-1, keepdims=True)
    return normalised


def primary_rays(projection: str = "perspective") -> Rays:
    forward = unit(LOOK_AT - POSITION)
    right = unit(np.cross(forward, UP))
    up = np.cross(right, forward)
    half = np.tan(np.radians(FIELD_OF_VIEW / 2)) if projection == "perspective" else VIEW_HEIGHT / 2
    x, y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    across = ((2 * x - WIDTH) / HEIGHT * half)[..., None] * right + ((1 - 2 * y / HEIGHT) * half)[..., None] * up
    still = np.zeros_like(across)
    if projection == "perspective":
        return Rays(POSITION + still, unit(forward + across))
    return Rays(POSITION + across, forward + still)


def sphere_depth(rays: Rays, center: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    """Distance to the nearer hit, infinite for a miss; the origin is outside."""
    along = np.sum((center - rays.origins) * rays.directions, axis=-1)
    feet = rays.origins + along[..., None] * rays.directions
    squared = radius**2 - np.sum((feet - center) ** 2, axis=-1)
    return np.where(squared > 0, along - np.sqrt(np.maximum(squared, 0)), np.inf)


def diffuse_sphere(rays: Rays, light: NDArray[np.float64], intensity: float) -> NDArray[np.float64]:
    depth = sphere_depth(rays, LOOK_AT, 1.2)
    with np.errstate(invalid="ignore"):
        points = rays.origins + depth[..., None] * rays.directions
        to_light = light - points
        cosine = np.maximum(0, np.sum(unit(points - LOOK_AT) * unit(to_light), axis=-1))
        irradiance = intensity * cosine / np.sum(to_light**2, axis=-1)
    shade: NDArray[np.float64] = np.where(np.isfinite(depth), irradiance, 0)[..., None] * [0.8, 0.3, 0.1] / np.pi
    return shade


LIGHTS = (np.array([3.0, 2.5, 2.0]), np.array([-2.0, 3.0, 3.5]))


def point_light(position: NDArray[np.float64], intensity: float) -> dict[str, Any]:
    return {
        "kind": "point",
        "position": tuple(position),
        "intensity": (intensity,) * 3,
        "falloff": "inverse_square",
    }
