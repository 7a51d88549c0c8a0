"""Parts of scenes for tests of exporters."""

from __future__ import annotations

from typing import Any

from raytruth.scenes.scene import Scene

RED = {"diffuse": {"reflectance": (0.8, 0.1, 0.1)}}
MIRROR = {"mirror": {"reflectance": (0.9, 0.9, 0.9)}}
GLASS = {"dielectric": {"index_of_refraction": 1.5}}
LAMP = {"emission": {"radiance": (2.0, 3.0, 4.0)}}
BOARD = {"checkerboard": {"even": (2.0, 0.1, 0.1), "odd": (0.1, 0.1, 0.2), "size": 0.7, "offset": (0.2, 0.1)}}
POINT = {"kind": "point", "position": (1.0, 2.0, 3.0), "intensity": (9.0, 8.0, 7.0), "falloff": "inverse_square"}
SUN = {"kind": "directional", "direction": (0.0, -1.0, 0.0), "irradiance": (1.0, 1.0, 1.0)}
BALL = {"shape": "sphere", "center": (0.1, 0.2, 0.3), "radius": 1.1, "material": "m"}
PLANE = {"shape": "plane", "point": (0.3, -1.0, 0.2), "normal": (0.0, 2.0, 0.0), "material": "m"}
# Seen from (0, 1, 5), which is on the side of its normal, +y.
FLOOR = {"shape": "triangle", "vertices": ((-5.0, -1.0, -5.0), (0.0, -1.0, 5.0), (5.0, -1.0, -5.0)), "material": "m"}


def build(**changes: Any) -> Scene:
    base: dict[str, Any] = {
        "purpose": "A test.",
        "convention": "radiometric",
        "camera": {
            "projection": "perspective",
            "position": (0.0, 1.0, 5.0),
            "look_at": (0.0, 0.0, 0.0),
            "width": 32,
            "height": 24,
            "vertical_field_of_view": 40.0,
        },
        "materials": {"m": RED},
        "objects": [BALL],
    }
    return Scene.model_validate(base | changes)
