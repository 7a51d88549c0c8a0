"""A scene file of few pixels: a ball in the light of one lamp, seen along parallel rays."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path

LAMP = {"kind": "point", "position": [1, 2, 3], "intensity": [1, 1, 1], "falloff": "none"}


def scene_file(folder: Path, name: str = "small", *, width: int = 4, height: int = 3, **changes: Any) -> str:
    """Write the scene, with `changes` of its keys, and return its path."""
    scene: dict[str, Any] = {
        "purpose": "Small.",
        "convention": "whitted",
        "camera": {
            "projection": "orthographic",
            "position": [0.1, 0.2, 5],
            "look_at": [0, 0, 0],
            "width": width,
            "height": height,
            "view_height": 3,
        },
        "lights": [LAMP],
        "materials": {"m": {"diffuse": {"reflectance": [1, 0.5, 0.25]}}},
        "objects": [{"shape": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"}],
    }
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.json"
    path.write_text(json.dumps(scene | changes), encoding="utf-8")
    return str(path)
