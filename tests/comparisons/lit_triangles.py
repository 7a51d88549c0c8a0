"""Scenes of triangles in light that VTK has, without shadows."""

from __future__ import annotations

from typing import Any

from tests.comparisons.drawn_triangles import triangle_scene
from tests.scenes.exporter_scenes import build

POINT = {"kind": "point", "position": (0.4, 1.7, 3.1), "intensity": (1.9, 0.7, 0.4), "falloff": "none"}
BEHIND = {"kind": "point", "position": (-0.3, 1.1, -2.3), "intensity": (0.2, 0.6, 1.7), "falloff": "none"}
SUN = {"kind": "directional", "direction": (0.3, -0.7, -0.9), "irradiance": (0.3, 0.5, 0.2)}
FADING = POINT | {"falloff": {"constant": 1.03, "linear": 0.21, "quadratic": 0.07}}
NEAR = POINT | {"falloff": "inverse_square", "intensity": (19.0, 23.0, 31.0)}
SHINY = {
    "ambient": {"reflectance": (0.31, 0.17, 0.11)},
    "diffuse": {"reflectance": (0.43, 0.61, 0.29)},
    "specular": {"reflectance": (0.67, 0.37, 0.59), "exponent": 7.0, "model": "phong"},
    "emission": {"radiance": (0.07, 0.0, 0.19)},
}
DULL = {"diffuse": {"reflectance": (0.43, 0.61, 0.29)}}
# The left one is seen from its back, the right one from its front; none of both is before the other.
LEFT = {"shape": "triangle", "vertices": ((-1.9, -0.8, 0.2), (-1.1, 1.3, -0.6), (-0.1, -0.9, -0.3)), "material": "m"}
RIGHT = {"shape": "triangle", "vertices": ((0.1, -0.9, 0.1), (1.7, -0.7, -0.5), (0.6, 1.2, -0.2)), "material": "n"}
CAMERA = {
    "projection": "perspective",
    "vertical_field_of_view": 41.0,
    "position": (0.3, 0.4, 5.3),
    "look_at": (0.0, 0.1, 0.0),
    "width": 32,
    "height": 24,
}
PARALLEL = {name: value for name, value in CAMERA.items() if name != "vertical_field_of_view"} | {
    "projection": "orthographic",
    "view_height": 3.3,
}


def plates(**changes: Any) -> Any:
    """Two triangles, seen from both sides, in three lights, over a colour; `changes` of the scene."""
    scene = {
        "convention": "whitted",
        "camera": CAMERA,
        "materials": {"m": SHINY, "n": DULL},
        "objects": [LEFT, RIGHT],
        "lights": [FADING, BEHIND, SUN],
        "ambient_light": (0.7, 0.9, 1.3),
        "background": {"color": (0.11, 1.2, 0.05)},
    }
    return build(**(scene | changes))


def radiometric_plates(camera: dict[str, Any]) -> Any:
    """The same shapes in physical light."""
    dull = {"m": DULL, "n": {"diffuse": {"reflectance": (0.11, 0.83, 0.47)}}}
    return plates(
        convention="radiometric", camera=camera, materials=dull, lights=[NEAR, SUN], ambient_light=(0.0, 0.0, 0.0)
    )


def head_lit(seed: int, projection: dict[str, Any]) -> Any:
    """Random triangles, many behind others, with a light where the camera is, so that nothing seen is in shadow."""
    scene = triangle_scene(seed, projection).model_dump()
    light = NEAR | {"position": scene["camera"]["position"]}
    return build(**(scene | {"lights": [light]}))
