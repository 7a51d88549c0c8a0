"""Scenes by name or path."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.camera import LARGEST_SIDE
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene


def load_scene(name_or_path: str | Path) -> Scene:
    """A scene of the library by its name, or the scene in a file whose name ends in `.json`.

    Raises SceneError with one sentence for each mistake of the file, or if there is no such scene.
    """
    return open_scene(str(name_or_path))


def resized(scene: Scene, width: int, height: int) -> Scene:
    """The scene with an image of `width` × `height` pixels; the height of what is seen stays the same.

    Raises ValueError unless both are from 1 to 8192.
    """
    if not (1 <= width <= LARGEST_SIDE and 1 <= height <= LARGEST_SIDE):
        raise ValueError(f"expected a width and a height from 1 to {LARGEST_SIDE} pixels, found {width} x {height}.")
    return scene.resized(width, height)
