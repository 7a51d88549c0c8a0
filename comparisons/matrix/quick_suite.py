"""The quick suite: the scenes that kill every fault of the catalogue in the least time, at the kill matrix's size."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.scenes.exporters.json_scene import export_json
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.scenes.scene import Scene

# Twenty columns by fifteen rows: as few as show every fault of the catalogue in some scene of the library.
MOST_PIXELS = 300
QUICK_FOLDER = "quick-suite"
QUICK_FILE = Path(__file__).with_name("quick_suite.json")


def quick_scenes() -> tuple[str, ...]:
    """The names of the quick suite's scenes, as `raytruth faults --write-quick` found them."""
    return tuple(json.loads(QUICK_FILE.read_text(encoding="utf-8")))


def write_quick_scenes(names: Sequence[str]) -> None:
    """Make this the quick suite."""
    QUICK_FILE.write_text(json.dumps(list(names), indent=1) + "\n", encoding="utf-8")


def write_quick_suite(directory: Path) -> tuple[str, ...]:
    """The scenes of the quick suite with small images, as scene files below the directory; returns their paths."""
    folder = directory / QUICK_FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    return tuple(str(export_json(small(open_scene(name)), folder)) for name in quick_scenes())


def small(scene: Scene) -> Scene:
    """The scene with both sides of its image divided by the least number that leaves no more than 300 pixels."""
    camera = scene.camera
    divisor = 1
    while (camera.width // divisor) * (camera.height // divisor) > MOST_PIXELS:
        divisor += 1
    return scene.resized(max(1, camera.width // divisor), max(1, camera.height // divisor))
