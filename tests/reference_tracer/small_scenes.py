"""Scenes of few pixels and few objects, in numbers that floats hold exactly."""

from __future__ import annotations

from typing import Any

from raytruth.scenes.library import open_scene
from raytruth.scenes.scene import Scene


def small_scene(
    *, projection: str = "orthographic", width: int = 1, height: int = 1, extent: float = 1.0, **changes: Any
) -> Scene:
    """A camera at (0, 0, 5) that looks along -z, at a white sphere of radius 1 around the origin."""
    camera: dict[str, Any] = {"projection": projection, "position": (0.0, 0.0, 5.0), "look_at": (0.0, 0.0, 0.0)}
    camera |= {"width": width, "height": height, **changes.pop("camera", {})}
    camera["vertical_field_of_view" if projection == "perspective" else "view_height"] = extent
    base: dict[str, Any] = {
        "purpose": "A test.",
        "convention": "whitted",
        "camera": camera,
        "materials": {"white": {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}}},
        "objects": [sphere("white")],
    }
    return Scene.model_validate(base | changes)


def sphere(material: str, center: tuple[float, float, float] = (0.0, 0.0, 0.0), radius: float = 1.0) -> dict[str, Any]:
    return {"shape": "sphere", "center": center, "radius": radius, "material": material}


def square(material: str, z: float, half: float = 100.0) -> dict[str, Any]:
    """In the plane of the given z, seen from +z."""
    corners = ((-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z))
    return {"shape": "mesh", "vertices": corners, "faces": ((0, 1, 2), (0, 2, 3)), "material": material}


def plane(material: str, z: float, length: float = 1.0) -> dict[str, Any]:
    """Without end, at the given z, with a normal of this length along +z."""
    return {"shape": "plane", "point": (3.0, -2.0, z), "normal": (0.0, 0.0, length), "material": material}


def lamp(position: tuple[float, float, float], intensity: float = 1.0, falloff: Any = "none") -> dict[str, Any]:
    return {"kind": "point", "position": position, "intensity": (intensity,) * 3, "falloff": falloff}


def library_scene(name: str, width: int = 12, height: int = 9) -> Scene:
    """A scene of the library with a smaller image."""
    scene = open_scene(name)
    return scene.resized(width, height)
