"""A small assignment, and submissions that are quick to grade."""

from __future__ import annotations

import sys
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.matrix.quick_suite import small
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from pathlib import Path

ASSIGNMENT = """
name = "one-sphere"
title = "One sphere"
feedback = "topics"
models = [{ arithmetic = { precision = "float64", slack_bits = 14 } }]

[[topics]]
id = "sphere"
title = "A sphere"
scenes = ["single-sphere"]
"""
# Hands out a right picture, or does what stands before that.
PROGRAM = """
import os, pathlib, shutil, sys, time
{misdeed}
shutil.copy(pathlib.Path(__file__).with_name("right.pfm"), sys.argv[2])
"""
DECLARATION = f'name = "mine"\ncommand = ["{sys.executable}", "tracer.py", "{{scene}}", "{{output}}"]\nwrites = "pfm"\n'


def written_assignment(folder: Path) -> Path:
    """The assignment's file."""
    path = folder / "one.toml"
    path.write_text(ASSIGNMENT)
    return path


def written_submission(folder: Path, misdeed: str = "") -> Path:
    """A submission as a folder."""
    folder.mkdir(parents=True)
    (folder / "tracer.py").write_text(PROGRAM.format(misdeed=misdeed))
    (folder / "tracer.toml").write_text(DECLARATION)
    (folder / "right.pfm").write_bytes(right_picture())
    return folder


@cache
def right_picture() -> bytes:
    """Of the one scene, as a PFM file."""
    image = np.asarray(render(small(open_scene("single-sphere")), FLOAT), dtype="<f4")
    return f"PF\n{image.shape[1]} {image.shape[0]}\n-1.0\n".encode() + image[::-1].tobytes()
