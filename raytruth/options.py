"""Options and arguments that several commands share."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from raytruth.api.scenes import load_scene
from raytruth.errors import UsageError
from raytruth.scenes.camera import LARGEST_SIDE
from raytruth.scenes.loading import SceneError

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from raytruth.scenes.scene import Scene

AsJson = Annotated[bool, Parameter(name="--json", negative="")]

# More digits than any pixel has; Python takes long over whole numbers of very many.
_WHOLE_NUMBER = r"\d{1,9}"


def open_scene(name_or_path: str) -> Scene:
    """A scene of the library, or a scene file. Raises UsageError with every problem that it has."""
    try:
        return load_scene(name_or_path)
    except SceneError as error:
        raise UsageError(str(error)) from error


def open_scenes(sources: Iterable[str]) -> dict[str, Scene]:
    """The scenes, each by what names it on the command line. Raises UsageError where two have the same name."""
    opened: dict[str, Scene] = {}
    for source in sources:
        scene = open_scene(source)
        if scene.name in {known.name for known in opened.values()}:
            raise UsageError(f"There are two scenes called {scene.name!r}: give each scene file a name of its own.")
        opened[source] = scene
    return opened


def expect_folder(out: Path) -> None:
    """Before any work. Raises UsageError where there is something else than a folder."""
    if out.exists() and not out.is_dir():
        raise UsageError(f"--out: expected a folder, but {out} is a file.")
    try:
        str(out).encode()
    except UnicodeEncodeError as error:
        raise UsageError(f"--out: expected a folder whose name is UTF-8, found {str(out)!a}.") from error


def parse_pixel(text: str) -> tuple[int, int]:
    """The column and the row in `X,Y`. Raises UsageError for any other text."""
    match = re.fullmatch(rf"(-?{_WHOLE_NUMBER}),(-?{_WHOLE_NUMBER})", text, re.ASCII)
    if match is None:
        raise UsageError(f"--pixel: expected X,Y as in 32,20 (column from the left, row from the top), found {text!r}.")
    return int(match[1]), int(match[2])


def parse_size(text: str) -> tuple[int, int]:
    """The width and the height in `WxH`. Raises UsageError for any other text and for absurd sizes."""
    match = re.fullmatch(rf"({_WHOLE_NUMBER})x({_WHOLE_NUMBER})", text, re.ASCII)
    if match is None or not all(1 <= int(side) <= LARGEST_SIDE for side in match.groups()):
        raise UsageError(f"--size: expected WIDTHxHEIGHT as in 320x240, both from 1 to {LARGEST_SIDE}, found {text!r}.")
    return int(match[1]), int(match[2])


def resized(scene: Scene, size: str | None) -> Scene:
    """The scene with an image of the size in `WxH`, or as it is. Raises UsageError as `parse_size` does."""
    if size is None:
        return scene
    return scene.resized(*parse_size(size))
