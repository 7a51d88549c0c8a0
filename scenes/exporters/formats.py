"""The formats that a scene can be written in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.scenes.exporters import gltf_limits, json_scene, mitsuba_limits, obj, pbrt_limits, povray_limits
from raytruth.scenes.exporters.gltf import export_gltf
from raytruth.scenes.exporters.mitsuba import export_mitsuba
from raytruth.scenes.exporters.pbrt import export_pbrt
from raytruth.scenes.exporters.povray import export_povray, options_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.scenes.scene import Scene

# The path integrator of Mitsuba counts edges: one to the first surface, one a bounce, one to the light.
MITSUBA_EDGES = 2


def _export_mitsuba(scene: Scene, folder: Path) -> Path:
    return export_mitsuba(scene, folder, max_depth=scene.max_depth + MITSUBA_EDGES)


def _nothing_to_note(_: Scene) -> list[str]:
    return []


@dataclass(frozen=True)
class Format:
    """What a scene can be written as."""

    purpose: str
    """Which program it is for, or what it is written as: what follows 'cannot be written' in a message."""
    refuses: Callable[[Scene], str | None]
    """Why a scene cannot be written, in one clause; None if it can."""
    notes: Callable[[Scene], list[str]]
    """What is left out, rounded or computed otherwise, in one clause each."""
    write: Callable[[Scene, Path], Path]
    """Writes all files to a folder and returns the path of the main one."""
    command: Callable[[Scene, str], str] | None = None
    """The command line that opens the file, given as a word of a shell; none where many programs do."""


FORMATS = {
    "mitsuba": Format(
        "for Mitsuba", mitsuba_limits.refuses, _nothing_to_note, _export_mitsuba, lambda _, file: f"mitsuba {file}"
    ),
    "povray": Format(
        "for POV-Ray",
        povray_limits.refuses,
        _nothing_to_note,
        export_povray,
        lambda scene, file: f"povray {file} {' '.join(options_of(scene))}",
    ),
    "pbrt": Format("for pbrt", pbrt_limits.refuses, pbrt_limits.notes, export_pbrt, lambda _, file: f"pbrt {file}"),
    "obj": Format("as OBJ", obj.refuses, obj.notes, obj.export_obj),
    "gltf": Format("as glTF", gltf_limits.refuses, gltf_limits.notes, export_gltf),
    "json": Format(
        "as JSON",
        json_scene.refuses,
        json_scene.notes,
        json_scene.export_json,
        lambda _, file: f"raytruth render {file} -o picture.png",
    ),
}
