"""Infinite planes for those who have none."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.shapes import Plane

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene


def has_planes(scene: Scene) -> bool:
    """Whether any object is an infinite plane."""
    return any(isinstance(shape, Plane) for shape in scene.objects)


def refuses_planes(program: str, scene: Scene) -> str | None:
    """Why a program without infinite planes cannot express a scene, in one clause; None if the scene has none either.

    A program asks this before it looks at any shape: of planes it knows nothing.
    """
    if has_planes(scene):
        return f"{program} has no infinite planes, and polygons in their place would end before the horizon"
    return None
