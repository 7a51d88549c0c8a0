"""Small programs that stand for those of users: they read nothing of a scene but its size, and write one grey."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
from raytruth.comparisons.renderers.program.declaration_file import checked_declaration
from tests.reference_tracer.small_scenes import small_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

GREY = (0.5, 0.25, 0.125)
WIDTH, HEIGHT = 6, 4

# What every program begins with: a last word, and a way to write the right picture, and any other. The second line is a
# command to a shell and nothing to Python: an interpreter's path after #! cannot have a space.
BEGINNING = """#!/bin/sh
"exec" "{python}" "-ES" "$0" "$@"
import ctypes, os, signal, struct, sys, time
width, height, output = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
print("last words", flush=True)
def write(width=width, height=height, color={color}, path=output):
    with open(path, "wb") as file:
        file.write(b"PF %d %d -1.0\\n" % (width, height))
        file.write(struct.pack("<3f", *color) * (width * height))
"""


def grey_scene(**changes: Any) -> Scene:
    """All of it shines in the same grey."""
    emission = {"white": {"emission": {"radiance": GREY}}}
    background = {"color": GREY}
    return small_scene(name="small", width=WIDTH, height=HEIGHT, materials=emission, background=background, **changes)


def write_script(folder: Path, code: str, name: str = "tracer") -> Path:
    """An executable script in the folder."""
    path = folder / name
    path.write_text(BEGINNING.format(python=sys.executable, color=GREY) + code, encoding="utf-8")
    path.chmod(0o755)
    return path


def program(folder: Path, code: str = "write()", **declared: Any) -> ProgramRenderer:
    """A script as a renderer that writes a PFM."""
    write_script(folder, code)
    command = ["./tracer", "{width}", "{height}", "{output}", "{scene}"]
    data = {"name": "mine", "command": command, "writes": "pfm"} | declared
    return ProgramRenderer(checked_declaration(data, "mine.toml"), folder, "--renderer-file mine.toml")
