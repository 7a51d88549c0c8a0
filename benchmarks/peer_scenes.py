"""The scenes that are timed: each one shows the same picture in the tracer and in its peer."""

from __future__ import annotations

from typing import Any

from raytruth.scenes.scene import Scene

MIRROR_DEPTH = 6


def diffuse_scene(size: int) -> Scene:
    """Two diffuse spheres on a floor under one point light: primary rays, shadow rays, Lambert."""
    where = {"kind": "point", "position": [2.37, 4.19, 3.61]}
    light = {**where, "intensity": [58, 55, 49], "falloff": "inverse_square"}
    return _scene(
        "Times primary rays and shadow rays.",
        size,
        {"clay": _diffuse(0.79, 0.41, 0.27), "lime": _diffuse(0.3, 0.7, 0.2), "floor": _diffuse(0.6, 0.6, 0.6)},
        lights=[light],
    )


def mirror_scene(size: int) -> Scene:
    """Two mirrors on a shining checkerboard: with nothing diffuse, all paths are Whitted's."""
    board = {"even": [0.9, 0.8, 0.7], "odd": [0.1, 0.15, 0.2], "plane": "xz", "size": 0.73, "offset": [0.21, 0.13]}
    mirror = {"mirror": {"reflectance": [0.9, 0.85, 0.8]}}
    return _scene(
        "Times chains of mirror reflections.",
        size,
        {"clay": mirror, "lime": mirror, "floor": {"emission": {"radiance": {"checkerboard": board}}}},
        max_depth=MIRROR_DEPTH,
    )


def _scene(purpose: str, size: int, materials: dict[str, Any], **more: Any) -> Scene:
    camera = {
        "projection": "perspective",
        "vertical_field_of_view": 37,
        "position": [0.31, 1.47, 6.13],
        "look_at": [0.02, 0.3, 0.07],
        "width": size,
        "height": size,
    }
    corners = [[-6, -1.03, -6], [6, -1.03, -6], [6, -1.03, 6], [-6, -1.03, 6]]
    objects = [
        {"shape": "sphere", "center": [-0.82, 0.01, 0.07], "radius": 1.03, "material": "clay"},
        {"shape": "sphere", "center": [1.12, -0.13, -0.57], "radius": 0.87, "material": "lime"},
        {"shape": "mesh", "vertices": corners, "faces": [[0, 3, 2], [0, 2, 1]], "material": "floor"},
    ]
    scene = {"purpose": purpose, "convention": "radiometric", "camera": camera, "materials": materials}
    return Scene.model_validate({**scene, "objects": objects, **more})


def _diffuse(red: float, green: float, blue: float) -> dict[str, Any]:
    return {"diffuse": {"reflectance": [red, green, blue]}}
