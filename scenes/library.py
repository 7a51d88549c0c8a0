"""The scene library that travels with raytruth: one JSON file a scene."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.scenes.loading import SceneError, load_scene
from raytruth.scenes.wording import quoted, suggestion

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

# Beside this file, so that neither the working directory nor a folder called `scenes` in it matters.
LIBRARY_FOLDER = Path(__file__).parent / "library"


def library_names() -> tuple[str, ...]:
    """The names of the library's scenes, sorted."""
    return tuple(sorted(path.stem for path in LIBRARY_FOLDER.glob("*.json")))


def open_scene(name_or_path: str) -> Scene:
    """A scene of the library by its name, or a scene file by a path that ends in .json.

    Raises SceneError for a name that the library does not have, and as load_scene does.
    """
    if name_or_path.lower().endswith(".json"):
        return load_scene(name_or_path)
    names = library_names()
    if name_or_path not in names:
        raise SceneError(
            [
                f"{quoted(name_or_path)}: expected a scene of the library or the path of a .json file, "
                f"found neither; {suggestion(name_or_path, names)}"
            ]
        )
    return load_scene(LIBRARY_FOLDER / f"{name_or_path}.json")
