"""`raytruth render`."""

from __future__ import annotations

import os
import time
from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from cyclopts import Parameter
from cyclopts.validators import Number

from raytruth.api import images
from raytruth.api.images import MOST_SAMPLES, ArithmeticName
from raytruth.comparisons.records.image_files import ImageError, write_image
from raytruth.errors import UsageError
from raytruth.options import AsJson, open_scene, resized
from raytruth.output import print_json, progress, say
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.pictures import tone_picture

if TYPE_CHECKING:
    from numpy.typing import NDArray

SUFFIXES = (".exr", ".png")


def render(
    scene: str,
    /,
    *,
    out: Annotated[Path, Parameter(name=["--out", "-o"])],
    arithmetic: ArithmeticName = "float64",
    size: str | None = None,
    samples: Annotated[int, Parameter(validator=Number(gte=1, lte=MOST_SAMPLES))] = 1,
    as_json: AsJson = False,
) -> None:
    """Render a scene with the reference tracer.

    Parameters
    ----------
    scene
        A scene of the library, or the path of a .json file.
    out
        The image: .exr for linear float32 RGB, .png for 8-bit sRGB (values above 1 are clipped).
    arithmetic
        The number type: interpreted Python floats (slow), or compiled float64 or float32.
    size
        WIDTHxHEIGHT in pixels; by default the scene's own.
    samples
        n×n rays a pixel on a regular grid; 1 is the ray through the centre.
    as_json
        Print one JSON document instead of text.
    """
    _check_destination(out)
    opened = resized(open_scene(scene), size)
    what = f"{opened.name} at {opened.camera.width}x{opened.camera.height} in {arithmetic}"
    start = time.perf_counter()
    with progress(f"Rendering {what}"):
        image = images.render(opened, arithmetic, samples)
    seconds = time.perf_counter() - start
    with np.errstate(over="ignore"):  # what float32 cannot hold is infinite in the file
        _write(out, image.astype(np.float32))
    if as_json:
        print_json(
            {
                "scene": opened.name,
                "file": str(out),
                "width": opened.camera.width,
                "height": opened.camera.height,
                "arithmetic": arithmetic,
                "samples": samples,
                "seconds": seconds,
            }
        )
    else:
        say(f"Wrote {out}: {what}, {seconds:.1f} s with compiling")


def _check_destination(path: Path) -> None:
    """Raise UsageError where the file could not be written, before the work rather than after it."""
    if path.suffix.lower() not in SUFFIXES:
        raise UsageError(f"--out: expected a file that ends in {' or '.join(SUFFIXES)}, found {path.name!r}.")
    if not path.parent.is_dir():
        raise UsageError(f"--out: there is no folder {path.parent}; create it first.")
    if path.is_dir():
        raise UsageError(f"--out: expected a file, but {path} is a folder.")
    if not os.access(path.parent, os.W_OK):
        raise UsageError(f"--out: the folder {path.parent} cannot be written to.")


def _write(path: Path, image: NDArray[Any]) -> None:
    """The image appears whole or not at all."""
    if path.suffix.lower() == ".exr":
        try:
            write_image(path, image)
        except ImageError as error:
            raise UsageError(f"{error}.") from error
        return
    try:
        write_whole(path, tone_picture(image))
    except OSError as error:
        raise UsageError(f"{path}: the image could not be written ({error.strerror}).") from error
