"""Scenes by name or path."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene


def load_scene(name_or_path: str | Path) -> Scene:
    """A scene of the library by its name, or the scene in a file whose name ends in `.json`.

    Raises SceneError with one sentence for each mistake of the file, or if there is no such scene.
    """
    return open_scene(str(name_or_path))
