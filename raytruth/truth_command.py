"""`raytruth truth`."""

from __future__ import annotations

import json
import os
import time
from concurrent.futures.process import BrokenProcessPool
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from cyclopts import Parameter
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from raytruth.api import images
from raytruth.comparisons.records.certified_files import write_certified_image
from raytruth.comparisons.records.image_files import ImageError
from raytruth.errors import UsageError
from raytruth.options import AsJson, expect_folder, open_scene, resized
from raytruth.output import print_json, say, tell
from raytruth.reference_tracer.certified_image import largest_value
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.scenes.library import library_names

if TYPE_CHECKING:
    from raytruth.reference_tracer.certified_image import CertifiedImage
    from raytruth.scenes.scene import Scene


def truth(
    *scenes: str,
    out: Path = Path("truth"),
    size: str | None = None,
    jobs: int | None = None,
    fresh: Annotated[bool, Parameter(negative="")] = False,
    as_json: AsJson = False,
) -> None:
    """Prove the value of each pixel: the tracer in ball arithmetic, with as many bits as each pixel needs.

    Writes SCENE.exr, with the channels R, G, B (the values), residual.* (what float32 loses of them), radius.* (how far
    the true value can be from the sum of the two) and precision_bits; and SCENE.json, with the undecided pixels: their
    rays (in hexadecimal, which loses nothing), all values that they may have, and why.

    Parameters
    ----------
    scenes
        Names of library scenes, or paths of scene files; the whole library by default.
    out
        The folder for the files; it is made if need be.
    size
        WIDTHxHEIGHT in pixels; by default each scene's own.
    jobs
        How many threads or processes work side by side; one a processor by default.
    fresh
        Evaluate every pixel again, instead of using what was kept from an earlier run.
    as_json
        Print one JSON document instead of text: the scene's, or a list of all scenes' under "scenes". There,
        `largest_radius` is relative to the image's largest value, and `largest_absolute_radius` is not.
    """
    if jobs is not None and jobs < 1:
        raise UsageError(f"--jobs: expected 1 or more, found {jobs}.")
    opened = [resized(open_scene(source), size) for source in scenes or library_names()]
    _check_names(opened)
    expect_folder(out)
    _make_folder(out)
    summaries = []
    for scene in opened:
        summary = _certify(scene, out, jobs or os.cpu_count() or 1, fresh=fresh)
        summaries.append(summary)
        if not as_json:
            say(_sentence(summary))
    if as_json:
        print_json(summaries[0] if len(summaries) == 1 else {"scenes": summaries})


def _check_names(opened: list[Scene]) -> None:
    """Files are called by the names of the scenes."""
    names = [scene.name for scene in opened]
    for name in names:
        if names.count(name) > 1:
            raise UsageError(f"There are two scenes called {name!r}: give each scene file a name of its own.")


def _make_folder(out: Path) -> None:
    out.mkdir(parents=True, exist_ok=True)
    if not os.access(out, os.W_OK):
        raise UsageError(f"--out: the folder {out} cannot be written to.")


def _certify(scene: Scene, out: Path, jobs: int, *, fresh: bool) -> dict[str, Any]:
    """Write the scene's two files; returns what `--json` says of it."""
    start = time.perf_counter()
    try:
        image = _with_progress(scene, jobs, fresh=fresh)
    except BrokenProcessPool as error:
        reason = "a process was ended from outside; what was finished is kept, so start the command again"
        raise UsageError(f"{scene.name}: {reason}.") from error
    seconds = time.perf_counter() - start
    summary = _summary(scene, image, seconds)
    try:
        write_certified_image(out / f"{scene.name}.exr", image)
    except ImageError as error:
        raise UsageError(f"{error}.") from error
    undecided = [
        {
            "pixel": pixel,
            **asdict(reason),
            "origin": [part.hex() for part in reason.origin],
            "direction": [part.hex() for part in reason.direction],
        }
        for pixel, reason in sorted(image.undecided.items())
    ]
    text = json.dumps({**summary, "undecided_pixels": undecided}, indent=1, allow_nan=False)
    write_whole(out / f"{scene.name}.json", text)
    return summary


def _with_progress(scene: Scene, jobs: int, *, fresh: bool) -> CertifiedImage:
    console = Console(stderr=True)
    what = f"Certifying {scene.name} at {scene.camera.width}x{scene.camera.height}"
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task(what, total=None)
        if not console.is_terminal:
            tell(f"{what} …")
        return images.truth(
            scene, jobs=jobs, fresh=fresh, progress=lambda done, total: bar.update(task, completed=done, total=total)
        )


def _summary(scene: Scene, image: CertifiedImage, seconds: float) -> dict[str, Any]:
    largest = largest_value([image])
    radius = float(np.max(image.radius[image.decided], initial=0.0))
    return {
        "scene": scene.name,
        "pixels": image.precision_bits.size,
        "undecided": len(image.undecided),
        "largest_radius": radius / largest if largest > 0.0 else radius,
        "largest_precision_bits": int(image.precision_bits.max()),
        "seconds": seconds,
        "width": scene.camera.width,
        "height": scene.camera.height,
        "largest_value": largest,
        "largest_absolute_radius": radius,
    }


def _sentence(summary: dict[str, Any]) -> str:
    size = f"{summary['width']}x{summary['height']}"
    return (
        f"{summary['scene']} at {size}: {summary['pixels']} pixels, {summary['undecided']} undecided, radius at most "
        f"{summary['largest_radius']:.1e} of the largest value {summary['largest_value']:.3g}, "
        f"at most {summary['largest_precision_bits']} bits, {summary['seconds']:.1f} s"
    )
