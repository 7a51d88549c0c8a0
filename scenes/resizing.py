"""Scenes at another size of their image."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.camera import LARGEST_SIDE

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene


def resized(scene: Scene, width: int, height: int) -> Scene:
    """The scene with an image of `width` × `height` pixels; the height of what is seen stays the same.

    Raises ValueError unless both are from 1 to LARGEST_SIDE.
    """
    if not (1 <= width <= LARGEST_SIDE and 1 <= height <= LARGEST_SIDE):
        raise ValueError(f"expected a width and a height from 1 to {LARGEST_SIDE} pixels, found {width} x {height}.")
    return scene.model_copy(update={"camera": scene.camera.model_copy(update={"width": width, "height": height})})
